// SPDX-License-Identifier: Apache-2.0
// Path data of SVG 1.1 (https://www.w3.org/TR/SVG11/paths.html), curves as chords. Arcs by the conversion of its appendix F.6.
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/base/number_text.h"
#include "mapping/floorplan/plan_readers.h"

namespace oikos::mapping {

namespace {

constexpr int kChordsOfBezier = 16;

struct EllipticArc {
  Eigen::Vector2d radii;
  double turn_rad;
  bool large;
  bool sweep;
};

double angleBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

void addArc(const EllipticArc& arc, const Eigen::Vector2d& to, Polyline& line) {
  const Eigen::Vector2d from = line.back();
  Eigen::Vector2d radii = arc.radii.cwiseAbs();
  if (radii.minCoeff() == 0.0 || from == to) {
    line.push_back(to);
    return;
  }
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(arc.turn_rad).toRotationMatrix();
  const Eigen::Vector2d half = R.transpose() * (from - to) / 2.0;
  const double spread = half.cwiseQuotient(radii).squaredNorm();
  radii *= std::max(1.0, std::sqrt(spread));
  const Eigen::Vector2d unit = half.cwiseQuotient(radii);
  const double lift = std::sqrt(std::max(0.0, 1.0 / unit.squaredNorm() - 1.0));
  const Eigen::Vector2d centre_unit = (arc.large == arc.sweep ? -lift : lift) * Eigen::Vector2d(unit.y(), -unit.x());
  const Eigen::Vector2d start = unit - centre_unit;
  double sweep_rad = angleBetween(start, -unit - centre_unit);
  if (arc.sweep && sweep_rad < 0.0) {
    sweep_rad += 2.0 * std::numbers::pi;
  } else if (!arc.sweep && sweep_rad > 0.0) {
    sweep_rad -= 2.0 * std::numbers::pi;
  }
  const double from_rad = std::atan2(start.y(), start.x());
  const Eigen::Vector2d centre = R * radii.cwiseProduct(centre_unit) + (from + to) / 2.0;
  const Polyline points = arcPoints(Eigen::Vector2d::Zero(), radii, from_rad, from_rad + sweep_rad);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    line.push_back(centre + R * points[i]);
  }
  line.push_back(to);
}

class PathParser {
 public:
  PathParser(std::string_view text, const PlanSource& source) : text_(text), source_(source) {}

  std::vector<Polyline> parse() {
    for (skip(); at_ < text_.size(); skip()) {
      if (std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) {
        command_ = text_[at_++];
        if (lines_.empty() && command_ != 'M' && command_ != 'm') {
          refusePlan(source_, "path: begins with \"" + std::string(1, command_) + "\"; must begin with M");
        }
        if (command_ == 'Z' || command_ == 'z') {
          close();
          continue;
        }
      } else if (command_ == 0 || command_ == 'Z' || command_ == 'z') {
        refusePlan(source_, "path: \"" + std::string(1, text_[at_]) + "\" where a command is expected");
      }
      draw();
    }
    return std::move(lines_);
  }

 private:
  void skip() {
    while (at_ < text_.size() && (std::isspace(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == ',')) {
      ++at_;
    }
  }

  double number() {
    skip();
    const std::size_t begin = at_;
    const auto digits = [&] {
      const std::size_t first = at_;
      while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0) {
        ++at_;
      }
      return at_ > first;
    };
    const auto take = [&](std::string_view any) {
      const bool there = at_ < text_.size() && any.find(text_[at_]) != std::string_view::npos;
      at_ += there ? 1 : 0;
      return there;
    };
    take("+-");
    const bool whole = digits();
    const bool fraction = take(".") && digits();
    const std::size_t mantissa = at_;
    if ((whole || fraction) && take("eE")) {
      take("+-");
      at_ = digits() ? at_ : mantissa;
    }
    std::string word(text_.substr(begin, at_ - begin));
    word = word.starts_with('+') ? word.substr(1) : word;
    const auto value = base::findNumber(word.ends_with('.') ? word + "0" : word);
    if (!value || !std::isfinite(*value)) {
      const std::string found = begin < text_.size() ? "\"" + std::string(text_.substr(begin, 12)) + "\"" : "its end";
      refusePlan(source_, "path: " + found + " where a number of " + std::string(1, command_) + " is expected");
    }
    return *value;
  }

  bool flag() {
    skip();
    if (at_ >= text_.size() || (text_[at_] != '0' && text_[at_] != '1')) {
      refusePlan(source_, "path: a flag of " + std::string(1, command_) + " must be 0 or 1");
    }
    return text_[at_++] == '1';
  }

  [[nodiscard]] bool isRelative() const { return std::islower(static_cast<unsigned char>(command_)) != 0; }

  Eigen::Vector2d point() {
    const double x = number();
    const double y = number();
    return Eigen::Vector2d(x, y) + (isRelative() ? here_ : Eigen::Vector2d(Eigen::Vector2d::Zero()));
  }

  /// One set of a command's arguments.
  void draw() {
    const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command_)));
    if (kind == 'M') {
      here_ = point();
      lines_.push_back({here_});
      command_ = isRelative() ? 'l' : 'L';  // what follows without a command of its own
      last_control_.reset();
      return;
    }
    if (lines_.back().size() > 1 && closed_) {  // goes on after a Z
      lines_.push_back({here_});
    }
    closed_ = false;
    const std::optional<Eigen::Vector2d> control = drawTo(kind);
    here_ = lines_.back().back();
    last_control_ = control;
    last_kind_ = kind;
  }

  /// The last control point of a curve, which S and T go on from.
  std::optional<Eigen::Vector2d> drawTo(char kind) {
    Polyline& line = lines_.back();
    switch (kind) {
      case 'L':
        line.push_back(point());
        return std::nullopt;
      case 'H': {
        const double x = number() + (isRelative() ? here_.x() : 0.0);
        line.emplace_back(x, here_.y());
        return std::nullopt;
      }
      case 'V': {
        const double y = number() + (isRelative() ? here_.y() : 0.0);
        line.emplace_back(here_.x(), y);
        return std::nullopt;
      }
      case 'C':
      case 'S': {
        const Eigen::Vector2d first = kind == 'C' ? point() : mirrored("CS");
        Eigen::Vector2d second = point();
        addBezier(first, second, point(), line);
        return second;
      }
      case 'Q':
      case 'T': {
        Eigen::Vector2d middle = kind == 'Q' ? point() : mirrored("QT");
        const Eigen::Vector2d end = point();
        addBezier(here_ + 2.0 / 3.0 * (middle - here_), end + 2.0 / 3.0 * (middle - end), end, line);
        return middle;
      }
      case 'A': {
        const double rx = number();
        const double ry = number();
        const double turn_rad = number() * std::numbers::pi / 180.0;
        const bool large = flag();
        const bool sweep = flag();
        addArc({{rx, ry}, turn_rad, large, sweep}, point(), line);
        return std::nullopt;
      }
      default:
        refusePlan(source_, "path: there is no command \"" + std::string(1, command_) + "\"");
    }
  }

  [[nodiscard]] Eigen::Vector2d mirrored(std::string_view kinds) const {
    return last_control_ && kinds.find(last_kind_) != std::string_view::npos ? Eigen::Vector2d(2.0 * here_ - *last_control_) : here_;
  }

  void addBezier(const Eigen::Vector2d& first, const Eigen::Vector2d& second, const Eigen::Vector2d& end, Polyline& line) const {
    for (int i = 1; i <= kChordsOfBezier; ++i) {
      const double t = static_cast<double>(i) / kChordsOfBezier;
      const double s = 1.0 - t;
      line.push_back(s * s * s * here_ + 3.0 * s * s * t * first + 3.0 * s * t * t * second + t * t * t * end);
    }
  }

  void close() {
    here_ = lines_.back().front();
    lines_.back().push_back(here_);
    closed_ = true;
    last_control_.reset();
  }

  std::string_view text_;
  const PlanSource& source_;
  std::size_t at_ = 0;
  char command_ = 0;
  char last_kind_ = 0;
  bool closed_ = false;
  Eigen::Vector2d here_ = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> last_control_;
  std::vector<Polyline> lines_;
};

}  // namespace

std::vector<Polyline> parseSvgPath(std::string_view text, const PlanSource& source) {
  return PathParser(text, source).parse();
}

}  // namespace oikos::mapping
