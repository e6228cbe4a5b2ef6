// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/plan_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/base/config_rules.h"

namespace oikos::mapping {

namespace {

constexpr int kBins = 180;           ///< a degree each: lines have no sense of direction
constexpr int kChannels = 4;         ///< of direction: 45° each
constexpr double kSpread_rad = 0.6;  ///< a line belongs to the channels within 34° of it
constexpr int kMostCells = 1500;     ///< a side of the plan's picture

using Histogram = std::array<double, kBins>;

double angleOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

void addTo(Histogram& histogram, double angle_rad, double weight) {
  const auto centre = static_cast<int>(std::lround(angle_rad * kBins / std::numbers::pi));
  constexpr int kReach = 6;
  for (int d = -kReach; d <= kReach; ++d) {
    histogram[static_cast<std::size_t>(((centre + d) % kBins + kBins) % kBins)] += weight * std::exp(-0.125 * d * d);
  }
}

/// Turns that bring the walls' directions onto the lines', half a turn left open.
std::vector<double> turnsOf(const WallSketch& sketch, const FloorPlan& plan, double least_share) {
  Histogram walls{};
  Histogram lines{};
  for (const WallPoint& wall : sketch.walls) {
    addTo(walls, angleOf(wall.normal_level) + 0.5 * std::numbers::pi, 1.0);
  }
  for (const PlanLine& line : plan.lines) {
    addTo(lines, angleOf(line.to_plan - line.from_plan), line.lengthM());
  }
  Histogram agreement{};
  for (std::size_t turn = 0; turn < kBins; ++turn) {
    for (std::size_t i = 0; i < kBins; ++i) {
      agreement[turn] += walls[i] * lines[(i + turn) % kBins];
    }
  }
  const double best = *std::max_element(agreement.begin(), agreement.end());
  std::vector<double> turns_rad;
  for (std::size_t i = 0; i < kBins; ++i) {
    const double before = agreement[(i + kBins - 1) % kBins];
    const double after = agreement[(i + 1) % kBins];
    if (agreement[i] >= least_share * best && agreement[i] > before && agreement[i] >= after) {
      const double curve = before - 2.0 * agreement[i] + after;
      const double shift = curve < 0.0 ? 0.5 * (before - after) / curve : 0.0;
      turns_rad.push_back((static_cast<double>(i) + shift) * std::numbers::pi / kBins);
    }
  }
  return turns_rad;
}

double channelDistance(double angle_rad, double channel_rad) {
  return std::abs(std::remainder(angle_rad - channel_rad, std::numbers::pi));
}

/// The plan's lines as blurred pictures, one a channel of direction.
class LinePictures {
 public:
  LinePictures(const FloorPlan& plan, const PlanSearchConfig& config) : blur_m_(config.blur_m) {
    Eigen::AlignedBox2d box;
    Histogram lines{};
    for (const PlanLine& line : plan.lines) {
      box.extend(line.from_plan);
      box.extend(line.to_plan);
      addTo(lines, angleOf(line.to_plan - line.from_plan), line.lengthM());
    }
    main_rad_ = static_cast<double>(std::max_element(lines.begin(), lines.end()) - lines.begin()) * std::numbers::pi / kBins;
    cell_m_ = std::max(config.cell_m, box.sizes().maxCoeff() / kMostCells);
    const double margin_m = 4.0 * blur_m_;
    corner_plan_ = box.min() - Eigen::Vector2d::Constant(margin_m);
    size_ = ((box.sizes().array() + 2.0 * margin_m) / cell_m_).ceil().cast<int>() + 1;
    for (int channel = 0; channel < kChannels; ++channel) {
      pictures_.push_back(blurred(drawn(plan, channelAngle(channel))));
    }
  }

  [[nodiscard]] double channelAngle(int channel) const { return main_rad_ + channel * std::numbers::pi / kChannels; }
  [[nodiscard]] int channelOf(double angle_rad) const {
    int nearest = 0;
    for (int channel = 1; channel < kChannels; ++channel) {
      nearest = channelDistance(angle_rad, channelAngle(channel)) < channelDistance(angle_rad, channelAngle(nearest)) ? channel : nearest;
    }
    return nearest;
  }
  [[nodiscard]] const cv::Mat& picture(int channel) const { return pictures_[static_cast<std::size_t>(channel)]; }
  [[nodiscard]] double cellM() const { return cell_m_; }
  [[nodiscard]] const Eigen::Vector2d& cornerPlan() const { return corner_plan_; }

 private:
  /// 0 on lines, 255 elsewhere.
  [[nodiscard]] cv::Mat drawn(const FloorPlan& plan, double channel_rad) const {
    cv::Mat picture(size_.y(), size_.x(), CV_8UC1, cv::Scalar(255));
    const auto pixel = [&](const Eigen::Vector2d& point_plan) {
      const Eigen::Vector2d place = (point_plan - corner_plan_) / cell_m_;
      return cv::Point(static_cast<int>(place.x()), static_cast<int>(place.y()));
    };
    for (const PlanLine& line : plan.lines) {
      if (channelDistance(angleOf(line.to_plan - line.from_plan), channel_rad) < kSpread_rad) {
        cv::line(picture, pixel(line.from_plan), pixel(line.to_plan), cv::Scalar(0), 1, cv::LINE_8);
      }
    }
    return picture;
  }

  [[nodiscard]] cv::Mat blurred(const cv::Mat& drawing) const {
    cv::Mat worth = cv::Mat::zeros(drawing.size(), CV_32FC1);
    if (cv::countNonZero(drawing) == static_cast<int>(drawing.total())) {
      return worth;
    }
    cv::Mat distance_px;
    cv::distanceTransform(drawing, distance_px, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    for (int row = 0; row < worth.rows; ++row) {
      for (int column = 0; column < worth.cols; ++column) {
        const double off = static_cast<double>(distance_px.at<float>(row, column)) * cell_m_ / blur_m_;
        worth.at<float>(row, column) = static_cast<float>(std::exp(-0.5 * off * off));
      }
    }
    return worth;
  }

  double blur_m_;
  double cell_m_ = 0.1;
  double main_rad_ = 0.0;
  Eigen::Vector2d corner_plan_ = Eigen::Vector2d::Zero();
  Eigen::Array2i size_ = Eigen::Array2i::Zero();
  std::vector<cv::Mat> pictures_;
};

/// Sum of worth over the walls, for every offset at which the turned walls' box meets the plan's picture.
class OffsetSearch {
 public:
  OffsetSearch(const WallSketch& sketch, const LinePictures& lines, double turn_rad)
      : lines_(lines), R_plan_level_(Eigen::Rotation2Dd(turn_rad)) {
    Eigen::AlignedBox2d box;
    for (const WallPoint& wall : sketch.walls) {
      box.extend(R_plan_level_ * wall.point_level);
    }
    corner_ = box.min();
    const Eigen::Array2i size = (box.sizes().array() / lines.cellM()).floor().cast<int>() + 1;
    std::vector<cv::Mat> walls(kChannels);
    for (cv::Mat& picture : walls) {
      picture = cv::Mat::zeros(size.y(), size.x(), CV_32FC1);
    }
    for (const WallPoint& wall : sketch.walls) {
      const Eigen::Array2i cell = ((R_plan_level_ * wall.point_level - corner_) / lines.cellM()).array().floor().cast<int>();
      const int channel = lines.channelOf(angleOf(R_plan_level_ * wall.normal_level) + 0.5 * std::numbers::pi);
      walls[static_cast<std::size_t>(channel)].at<float>(cell.y(), cell.x()) = 1.0F;
    }
    correlate(walls, size);
  }

  void collect(const PlanSearchConfig& config, std::vector<PlanCandidate>& candidates) {
    const int apart_px = std::max(1, static_cast<int>(config.apart_m / lines_.cellM()));
    for (int i = 0; i < config.candidates_a_turn; ++i) {
      double score = 0.0;
      cv::Point place;
      cv::minMaxLoc(scores_, nullptr, &score, nullptr, &place);
      if (!(score > 0.0)) {
        return;
      }
      PlanCandidate candidate;
      candidate.score = score;
      candidate.T_plan_level.linear() = R_plan_level_;
      const Eigen::Vector2d offset_px(place.x - pad_.x(), place.y - pad_.y());
      candidate.T_plan_level.translation() = lines_.cornerPlan() + lines_.cellM() * offset_px - corner_;
      candidates.push_back(candidate);
      cv::rectangle(scores_, place - cv::Point(apart_px, apart_px), place + cv::Point(apart_px, apart_px), cv::Scalar(0.0), cv::FILLED);
    }
  }

 private:
  void correlate(const std::vector<cv::Mat>& walls, const Eigen::Array2i& size) {
    pad_ = size;
    for (int channel = 0; channel < kChannels; ++channel) {
      const cv::Mat& of_channel = walls[static_cast<std::size_t>(channel)];
      if (cv::countNonZero(of_channel) == 0) {
        continue;
      }
      cv::Mat padded;
      cv::copyMakeBorder(lines_.picture(channel), padded, size.y(), size.y(), size.x(), size.x(), cv::BORDER_CONSTANT, cv::Scalar(0.0));
      cv::Mat score;
      cv::matchTemplate(padded, of_channel, score, cv::TM_CCORR);
      scores_ = scores_.empty() ? score : scores_ + score;
    }
  }

  const LinePictures& lines_;
  Eigen::Matrix2d R_plan_level_;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  ///< of the turned walls' box
  Eigen::Array2i pad_ = Eigen::Array2i::Zero();
  cv::Mat scores_;
};

}  // namespace

std::vector<std::string> PlanSearchConfig::validate() const {
  base::ConfigRules rules;
  rules.between("cell_m", cell_m, 0.02, 0.5).between("blur_m", blur_m, 0.02, 1.0).between("least_turn", least_turn, 0.0, 1.0);
  rules.between("candidates_a_turn", candidates_a_turn, 1, 100).between("candidates", candidates, 1, 1000);
  rules.greater("apart_m", apart_m, 0.0);
  return rules.messages();
}

std::vector<PlanCandidate> searchPlan(const WallSketch& sketch, const FloorPlan& plan, const PlanSearchConfig& config) {
  std::vector<PlanCandidate> candidates;
  if (sketch.walls.empty() || plan.lines.empty()) {
    return candidates;
  }
  const LinePictures lines(plan, config);
  for (const double turn_rad : turnsOf(sketch, plan, config.least_turn)) {
    for (const double half_turn_rad : {0.0, std::numbers::pi}) {
      OffsetSearch(sketch, lines, turn_rad + half_turn_rad).collect(config, candidates);
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const PlanCandidate& a, const PlanCandidate& b) { return a.score > b.score; });
  candidates.resize(std::min(candidates.size(), static_cast<std::size_t>(config.candidates)));
  return candidates;
}

}  // namespace oikos::mapping
