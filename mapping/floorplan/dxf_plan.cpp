// SPDX-License-Identifier: Apache-2.0
// ASCII DXF: pairs of lines, a group code and its value. Of the section ENTITIES: LINE, LWPOLYLINE, POLYLINE with its VERTEXes, ARC and
// CIRCLE (Autodesk, DXF Reference). Blocks are not expanded.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/number_text.h"
#include "mapping/floorplan/plan_readers.h"

namespace oikos::mapping {

namespace {

struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.back() == '\r' || text.back() == ' ' || text.back() == '\t')) {
    text.remove_suffix(1);
  }
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
    text.remove_prefix(1);
  }
  return text;
}

/// What stands between one group 0 and the next.
struct Entity {
  std::string_view kind;
  int line = 0;
  std::vector<Group> groups;
};

/// A corner of a polyline, and how far the side after it bulges: the tangent of a quarter of its arc's angle.
struct Corner {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  double bulge = 0.0;
};

class DxfReader {
 public:
  DxfReader(std::string_view text, const std::filesystem::path& file, const std::string& layer) : rest_(text), file_(file), layer_(layer) {}

  Drawing read() {
    if (rest_.starts_with("AutoCAD Binary DXF")) {
      refusePlan({file_, 1}, "is a binary DXF; save it as ASCII");
    }
    for (Entity entity = next(); entity.kind != "EOF"; entity = next()) {
      if (entity.kind == "SECTION") {
        section_ = textOf(entity, 2);
        noteUnits(entity);
      } else if (entity.kind == "ENDSEC") {
        section_ = {};
      } else if (section_ == "ENTITIES") {
        draw(entity);
      }
    }
    if (in_polyline_) {
      refusePlan({file_, line_}, "the POLYLINE has no SEQEND");
    }
    return std::move(drawing_);
  }

 private:
  std::string_view nextLine() {
    const std::size_t end = rest_.find('\n');
    const std::string_view line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    return line;
  }

  Group nextGroup() {
    if (rest_.empty()) {
      refusePlan({file_, line_}, "ends without EOF: it is cut off, or no DXF");
    }
    const std::string_view code = nextLine();
    const auto number = base::findNumber(code);
    if (!number || *number != std::floor(*number) || std::abs(*number) > 5000.0) {
      refusePlan({file_, line_}, "\"" + std::string(code.substr(0, 20)) + "\": must be a group code, a whole number");
    }
    if (rest_.empty()) {
      refusePlan({file_, line_}, "ends within a group");
    }
    Group group;
    group.code = static_cast<int>(*number);
    group.value = nextLine();
    group.line = line_;
    return group;
  }

  Entity next() {
    if (!pending_) {
      do {
        pending_ = nextGroup();
      } while (pending_->code == 999);  // a comment
      if (pending_->code != 0) {
        refusePlan({file_, pending_->line},
                   "begins with group " + base::toText(std::int64_t{pending_->code}) + "; a DXF begins with 0 SECTION");
      }
    }
    Entity entity{pending_->value, pending_->line, {}};
    pending_.reset();
    if (entity.kind == "EOF") {
      return entity;
    }
    for (Group group = nextGroup();; group = nextGroup()) {
      if (group.code == 0) {
        pending_ = group;
        return entity;
      }
      entity.groups.push_back(group);
    }
  }

  static std::string_view textOf(const Entity& entity, int code) {
    const auto found = std::find_if(entity.groups.begin(), entity.groups.end(), [&](const Group& g) { return g.code == code; });
    return found == entity.groups.end() ? std::string_view() : found->value;
  }

  [[nodiscard]] double value(const Group& group) const {
    const auto number = base::findNumber(group.value);
    if (!number || !std::isfinite(*number)) {
      refusePlan({file_, group.line},
                 "group " + base::toText(std::int64_t{group.code}) + " = \"" + std::string(group.value) + "\": must be a number");
    }
    return *number;
  }

  [[nodiscard]] double number(const Entity& entity, int code, std::optional<double> otherwise = std::nullopt) const {
    const auto found = std::find_if(entity.groups.begin(), entity.groups.end(), [&](const Group& g) { return g.code == code; });
    if (found != entity.groups.end()) {
      return value(*found);
    }
    if (!otherwise) {
      refusePlan({file_, entity.line}, std::string(entity.kind) + " has no group " + base::toText(std::int64_t{code}));
    }
    return *otherwise;
  }

  void noteUnits(const Entity& header) {
    for (std::size_t i = 0; i + 1 < header.groups.size(); ++i) {
      if (header.groups[i].code == 9 && header.groups[i].value == "$INSUNITS") {
        const double unit = value(header.groups[i + 1]);
        drawing_.metres_per_unit = unit == 1.0   ? std::optional(0.0254)
                                   : unit == 2.0 ? std::optional(0.3048)
                                   : unit == 4.0 ? std::optional(0.001)
                                   : unit == 5.0 ? std::optional(0.01)
                                   : unit == 6.0 ? std::optional(1.0)
                                                 : std::nullopt;
      }
    }
  }

  void draw(const Entity& entity) {
    if (entity.kind == "VERTEX" && in_polyline_) {
      corners_.push_back({{number(entity, 10), number(entity, 20)}, number(entity, 42, 0.0)});
      return;
    }
    if (entity.kind == "SEQEND" && in_polyline_) {
      in_polyline_ = false;
      addPolyline(corners_, polyline_closed_, polyline_chosen_);
      return;
    }
    const bool chosen = layer_.empty() || textOf(entity, 8) == layer_;
    if (entity.kind == "POLYLINE") {
      in_polyline_ = true;
      corners_.clear();
      polyline_chosen_ = chosen;
      polyline_closed_ = isClosed(entity);
    } else if (chosen && entity.kind == "LINE") {
      drawing_.lines.push_back({{number(entity, 10), number(entity, 20)}, {number(entity, 11), number(entity, 21)}});
    } else if (chosen && entity.kind == "LWPOLYLINE") {
      addPolyline(lightCorners(entity), isClosed(entity), true);
    } else if (chosen && (entity.kind == "ARC" || entity.kind == "CIRCLE")) {
      addArc(entity);
    }
  }

  [[nodiscard]] bool isClosed(const Entity& entity) const { return (static_cast<int>(number(entity, 70, 0.0)) & 1) != 0; }

  [[nodiscard]] std::vector<Corner> lightCorners(const Entity& entity) const {
    std::vector<Corner> corners;
    const auto refuse = [&](int line) { refusePlan({file_, line}, "LWPOLYLINE: a corner has no group 20"); };
    bool has_y = true;
    for (const Group& group : entity.groups) {
      if (group.code == 10) {
        if (!has_y) {
          refuse(group.line);
        }
        corners.push_back({{value(group), 0.0}, 0.0});
        has_y = false;
      } else if (group.code == 20 && !corners.empty()) {
        corners.back().point.y() = value(group);
        has_y = true;
      } else if (group.code == 42 && !corners.empty()) {
        corners.back().bulge = value(group);
      }
    }
    if (!has_y) {
      refuse(entity.line);
    }
    return corners;
  }

  void addPolyline(const std::vector<Corner>& corners, bool closed, bool chosen) {
    if (!chosen || corners.size() < 2) {
      return;
    }
    Polyline line = {corners.front().point};
    for (std::size_t i = 0; i + (closed ? 0 : 1) < corners.size(); ++i) {
      addSide(corners[i], corners[(i + 1) % corners.size()].point, line);
    }
    drawing_.lines.push_back(std::move(line));
  }

  static void addSide(const Corner& from, const Eigen::Vector2d& to, Polyline& line) {
    const Eigen::Vector2d chord = to - from.point;
    if (from.bulge != 0.0 && chord.norm() > 0.0) {
      const double angle_rad = 4.0 * std::atan(from.bulge);
      const double lift = (1.0 - from.bulge * from.bulge) / (4.0 * from.bulge);
      const Eigen::Vector2d centre = from.point + 0.5 * chord + lift * Eigen::Vector2d(-chord.y(), chord.x());
      const Eigen::Vector2d arm = from.point - centre;
      const double from_rad = std::atan2(arm.y(), arm.x());
      const Polyline points = arcPoints(centre, Eigen::Vector2d::Constant(arm.norm()), from_rad, from_rad + angle_rad);
      line.insert(line.end(), points.begin() + 1, points.end() - 1);
    }
    line.push_back(to);
  }

  void addArc(const Entity& entity) {
    const bool whole = entity.kind == "CIRCLE";
    const double from_deg = whole ? 0.0 : number(entity, 50);
    double to_deg = whole ? 360.0 : number(entity, 51);
    to_deg += to_deg <= from_deg ? 360.0 : 0.0;
    constexpr double kRadPerDeg = std::numbers::pi / 180.0;
    drawing_.lines.push_back(arcPoints({number(entity, 10), number(entity, 20)}, Eigen::Vector2d::Constant(number(entity, 40)),
                                       from_deg * kRadPerDeg, to_deg * kRadPerDeg));
  }

  std::string_view rest_;
  const std::filesystem::path& file_;
  const std::string& layer_;
  int line_ = 0;
  std::optional<Group> pending_;
  std::string_view section_;
  bool in_polyline_ = false;
  bool polyline_closed_ = false;
  bool polyline_chosen_ = false;
  std::vector<Corner> corners_;
  Drawing drawing_;
};

}  // namespace

Drawing readDxf(const std::string& text, const std::filesystem::path& file, const std::string& layer) {
  return DxfReader(text, file, layer).read();
}

}  // namespace oikos::mapping
