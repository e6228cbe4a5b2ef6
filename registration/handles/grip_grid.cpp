// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/grip_grid.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace oikos::registration {

namespace {

constexpr int kMostInGrid = 900;  // readings; they repeat each other

std::vector<GripReading> everyNth(const std::vector<GripReading>& readings, std::size_t n) {
  std::vector<GripReading> fewer;
  for (std::size_t i = 0; i < readings.size(); i += n) {
    fewer.push_back(readings[i]);
  }
  return fewer;
}

constexpr double kStepAlong_m = 0.006;
constexpr double kStepAcross_m = 0.004;

/// From -n to n times a step, as far as `reach_m`.
std::vector<double> stepsOf(double reach_m, double step_m) {
  const int n = static_cast<int>(std::floor(reach_m / step_m));
  std::vector<double> steps;
  for (int i = -n; i <= n; ++i) {
    steps.push_back(i * step_m);
  }
  return steps;
}

/// Weighted least squares over the height of the grip and the offset of its front, at each place of a grid.
class Grid {
 public:
  Grid(const GripReadings& grip, const Bar& believed, const GripConfig& config)
      : believed_(believed),
        config_(config),
        steps_along_m_(stepsOf(config.search_m, kStepAlong_m)),
        steps_across_m_(stepsOf(config.search_m, kStepAcross_m)) {
    const std::size_t n = 1 + grip.readings.size() / kMostInGrid;
    const std::vector<GripReading> readings = everyNth(grip.readings, n);
    const double share = std::min(1.0, grip.share * static_cast<double>(n));
    weight_ = share / (grip.sigma_m * grip.sigma_m);
    const auto count = static_cast<Eigen::Index>(readings.size());
    along_m_.resize(count);
    across_m_.resize(count);
    height_m_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const GripReading& reading = readings[static_cast<std::size_t>(i)];
      along_m_[i] = reading.along_m;
      across_m_[i] = reading.across_m;
      height_m_[i] = reading.height_m;
    }
    readings_ = static_cast<double>(count) + 1.0 / (weight_ * config.offset_sigma_m * config.offset_sigma_m);
  }

  /// Row by row: along, then across. A reading is covered as far along the bar as across it, so that both are only worked out once.
  [[nodiscard]] std::vector<PlaceEvidence> evidence(double blur_m) const {
    const Eigen::ArrayXXd along = coversOf(along_m_, steps_along_m_, believed_.half_length_m, blur_m);
    const Eigen::ArrayXXd across = coversOf(across_m_, steps_across_m_, believed_.half_width_m, blur_m);
    const double sum_m = height_m_.sum();
    std::vector<PlaceEvidence> places;
    for (Eigen::Index i = 0; i < along.cols(); ++i) {
      for (Eigen::Index j = 0; j < across.cols(); ++j) {
        const Eigen::ArrayXd cover = along.col(i) * across.col(j);
        const double covers = cover.sum();
        const double seen = cover.square().sum() - covers * covers / readings_;
        const double standing_out = (cover * height_m_).sum() - covers * sum_m / readings_;
        places.push_back({steps_along_m_[static_cast<std::size_t>(i)], steps_across_m_[static_cast<std::size_t>(j)], weight_ * standing_out,
                          weight_ * std::max(0.0, seen)});
      }
    }
    return places;
  }

  [[nodiscard]] GridPlace placeOf(const PlaceEvidence& evidence, double blur_m) const {
    GridPlace place{evidence.along_m, evidence.across_m, blur_m, 0.0, 0.0};
    if (evidence.seen > 1e-9 * weight_ && evidence.standing_out > 0.0) {
      const double height_m = std::min(evidence.standing_out / evidence.seen, config_.max_reach_m);
      place.gain = height_m * (evidence.standing_out - 0.5 * height_m * evidence.seen);
    }
    place.score = place.gain -
                  0.5 * (place.along_m * place.along_m + place.across_m * place.across_m) / (config_.place_sigma_m * config_.place_sigma_m);
    return place;
  }

 private:
  /// A column for each step.
  [[nodiscard]] static Eigen::ArrayXXd coversOf(const Eigen::ArrayXd& places_m, const std::vector<double>& steps_m, double half_m,
                                                double blur_m) {
    Eigen::ArrayXXd covers(places_m.size(), static_cast<Eigen::Index>(steps_m.size()));
    for (Eigen::Index i = 0; i < covers.cols(); ++i) {
      for (Eigen::Index r = 0; r < covers.rows(); ++r) {
        covers(r, i) = covered(places_m[r] - steps_m[static_cast<std::size_t>(i)], half_m, blur_m);
      }
    }
    return covers;
  }

  const Bar& believed_;
  const GripConfig& config_;
  std::vector<double> steps_along_m_;
  std::vector<double> steps_across_m_;
  Eigen::ArrayXd along_m_;
  Eigen::ArrayXd across_m_;
  Eigen::ArrayXd height_m_;
  double weight_ = 0.0;
  double readings_ = 0.0;  ///< with the prior of the front's offset, in readings
};

}  // namespace

std::vector<GridPlace> bestOfGrid(const GripReadings& grip, const Bar& believed, const GripConfig& config) {
  const Grid grid(grip, believed, config);
  std::vector<GridPlace> places;
  for (const double blur_px : {config.sharp_blur_px, config.wide_blur_px}) {
    const double blur_m = blur_px * grip.pixel_m;
    for (const PlaceEvidence& evidence : grid.evidence(blur_m)) {
      const GridPlace place = grid.placeOf(evidence, blur_m);
      if (place.gain > 0.5 * config.min_gain) {
        places.push_back(place);
      }
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const GridPlace& a, const GridPlace& b) { return a.score > b.score; });
  std::vector<GridPlace> best;
  for (const GridPlace& place : places) {
    const bool is_apart = std::all_of(best.begin(), best.end(), [&](const GridPlace& other) {
      return std::hypot(place.along_m - other.along_m, place.across_m - other.across_m) >= config.apart_m;
    });
    if (is_apart && static_cast<int>(best.size()) < config.most_places) {
      best.push_back(place);
    }
  }
  return best;
}

std::vector<PlaceEvidence> evidenceOverGrid(const GripReadings& grip, const Bar& believed, const GripConfig& config) {
  return Grid(grip, believed, config).evidence(config.wide_blur_px * grip.pixel_m);
}

}  // namespace oikos::registration
