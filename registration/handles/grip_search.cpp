// SPDX-License-Identifier: Apache-2.0
// After 5.2.1.1 of paper 003 (S238, S239): what stands out within the front's hull is the handle. Differs in that no single reading has to
// stand out by a centimetre: at two metres a bar is three pixels wide, a first Kinect takes the mean over nine, and its noise is as high as
// what is left of the bar. All readings around the handle are compared with the whole of it.
#include "registration/handles/grip_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/config_rules.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSeenOfBar = 0.785;     // of a round bar's radius, what its visible side stands out in the mean
constexpr double kHeightSigma_m = 0.01;  // wide: how much of its height a sensor shows is not known
constexpr int kMostInGrid = 900;         // readings; they repeat each other
constexpr double kLeastBlur = 0.75;      // of the readings' spacing: an edge between two of them could not be moved
constexpr double kMostHigher_m = 0.015;  // than believed: a hair that stands out by a hand looks much like a bar
constexpr double kHuber = 2.5;
constexpr int kRounds = 12;

/// A place of the grid.
struct GridPlace {
  double along_m = 0.0;
  double across_m = 0.0;
  double blur_m = 0.0;
  double gain = 0.0;
  double score = 0.0;
};

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

/// Best places of the grid, apart from each other.
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

/// What is believed of a bar, as a mean and deviations.
struct BarPrior {
  BarVector mean = BarVector::Zero();
  BarVector information = BarVector::Zero();
};

BarPrior priorOf(const GripBelief& belief, double pixel_m, const GripConfig& config) {
  const double length = belief.is_knob ? 0.25 : 0.5;
  BarVector sigmas;
  sigmas << config.place_sigma_m, config.place_sigma_m, config.roll_sigma_deg * kDegree, kHeightSigma_m, config.offset_sigma_m,
      length * config.length_sigma_m, config.radius_sigma_m, 0.5 * (config.wide_blur_px - config.sharp_blur_px) * pixel_m;
  Bar bar = believedBar(belief);
  bar.blur_m = 0.5 * (config.sharp_blur_px + config.wide_blur_px) * pixel_m;
  return {bar.vector(), sigmas.cwiseAbs2().cwiseInverse()};
}

/// What tells where the bar ends, and how high its front is there.
std::vector<GripReading> readingsAround(const Bar& bar, const GripReadings& grip) {
  constexpr double kRim_m = 0.025;
  std::vector<GripReading> around;
  for (const GripReading& reading : grip.readings) {
    if (std::abs(reading.along_m - bar.along_m) < bar.half_length_m + kRim_m + bar.blur_m &&
        std::abs(reading.across_m - bar.across_m) < bar.half_width_m + kRim_m + bar.blur_m) {
      around.push_back(reading);
    }
  }
  return around;
}

/// Gauss-Newton from one place, with steps that are halved until they help.
class BarFit {
 public:
  BarFit(const GripBelief& belief, const Bar& start, const GripReadings& grip, const GripConfig& config)
      : grip_(grip),
        readings_near_(readingsAround(start, grip)),
        prior_(priorOf(belief, grip.pixel_m, config)),
        is_square_(belief.is_knob) {}

  [[nodiscard]] GripPlace refine(const Bar& start) {
    BarVector bar = start.vector();
    Sums sums = sumUp(bar);
    double damping = 1e-6;
    for (int round = 0; round < kRounds; ++round) {
      BarMatrix H = sums.H;
      H.diagonal() *= 1.0 + damping;
      const BarVector step = H.ldlt().solve(sums.g);
      BarVector moved = bar + step;
      moved[3] = std::min(moved[3], prior_.mean[3] + kMostHigher_m);
      moved[5] = std::max(moved[5], 0.003);
      moved[6] = is_square_ ? moved[5] : std::max(moved[6], 0.002);
      moved[7] = std::max(moved[7], kLeastBlur * grip_.spacing_m);
      const Sums there = sumUp(moved);
      if (there.cost < sums.cost) {
        const bool is_done = sums.cost - there.cost < 1e-4;
        bar = moved;
        sums = there;
        damping *= 0.1;
        if (is_done) {
          break;
        }
      } else {
        damping = std::max(10.0 * damping, 1e-3);
      }
    }
    information_ = sums.H;
    cost_ = sums.data_cost;
    readings_ = sums.readings;
    return placeAt(bar);
  }

 private:
  [[nodiscard]] GripPlace placeAt(const BarVector& bar) const {
    GripPlace place;
    place.bar = Bar::from(bar);
    place.covariance = information_.ldlt().solve(BarMatrix::Identity());
    place.gain = bareCost(bar[4]) - cost_;
    place.score = place.gain - 0.5 * offOf(bar).cwiseAbs2().dot(prior_.information);
    place.readings = readings_;
    return place;
  }

  struct Sums {
    BarMatrix H = BarMatrix::Zero();
    BarVector g = BarVector::Zero();
    double cost = 0.0;
    double data_cost = 0.0;
    int readings = 0;
  };

  [[nodiscard]] static double huber(double ratio) {
    const double size = std::abs(ratio);
    return size < kHuber ? 0.5 * size * size : kHuber * (size - 0.5 * kHuber);
  }

  [[nodiscard]] Sums sumUp(const BarVector& vector) const {
    Sums sums;
    const BlurredBar bar(Bar::from(vector));
    const double weight = grip_.share / (grip_.sigma_m * grip_.sigma_m);
    for (const GripReading& reading : readings_near_) {
      BarReading expected = bar.at(reading.along_m, reading.across_m);
      const double residual_m = reading.height_m - expected.height_m;
      const double ratio = residual_m / grip_.sigma_m;
      sums.data_cost += grip_.share * huber(ratio);
      const double robust = std::abs(ratio) < kHuber ? weight : weight * kHuber / std::abs(ratio);
      if (expected.cover <= 0.0) {
        sums.H(4, 4) += robust;
        sums.g[4] += robust * residual_m;
        continue;
      }
      if (is_square_) {
        expected.derivative[5] += expected.derivative[6];
        expected.derivative[6] = 0.0;
      }
      sums.readings += expected.cover >= 0.5 ? 1 : 0;
      const BarVector weighted = robust * expected.derivative;
      sums.H.noalias() += weighted * expected.derivative.transpose();
      sums.g += residual_m * weighted;
    }
    const BarVector off = offOf(vector);
    sums.H.diagonal() += prior_.information;
    sums.g -= prior_.information.cwiseProduct(off);
    sums.cost = sums.data_cost + 0.5 * off.cwiseAbs2().dot(prior_.information);
    return sums;
  }

  /// From what is believed. A square's width is its length.
  [[nodiscard]] BarVector offOf(const BarVector& vector) const {
    BarVector off = vector - prior_.mean;
    off[6] = is_square_ ? 0.0 : off[6];
    return off;
  }

  [[nodiscard]] double bareCost(double offset_m) const {
    double cost = 0.0;
    for (const GripReading& reading : readings_near_) {
      cost += grip_.share * huber((reading.height_m - offset_m) / grip_.sigma_m);
    }
    return cost;
  }

  const GripReadings& grip_;
  std::vector<GripReading> readings_near_;
  BarPrior prior_;
  bool is_square_;
  BarMatrix information_ = BarMatrix::Zero();
  double cost_ = 0.0;
  int readings_ = 0;
};

/// From a sharp and from a blurred start: a thin bar that stands out far, blurred, looks much like a thicker one that is not.
GripPlace refined(const GripBelief& belief, const GridPlace& start, const GripReadings& readings, const GripConfig& config) {
  GripPlace best;
  for (const double blur_px : {config.sharp_blur_px, config.wide_blur_px}) {
    Bar bar = believedBar(belief);
    bar.along_m = start.along_m;
    bar.across_m = start.across_m;
    bar.blur_m = blur_px * readings.pixel_m;
    const GripPlace place = BarFit(belief, bar, readings, config).refine(bar);
    if (best.gain <= 0.0 || place.score > best.score) {
      best = place;
    }
  }
  return best;
}

/// Heights in a rectangle beside a bar.
struct Flank {
  double sum_m = 0.0;
  int readings = 0;
  [[nodiscard]] double mean_m() const { return readings > 0 ? sum_m / readings : 0.0; }
};

/// A grip has the front on both of its sides, and where it ends; the edge of a worktop has not, and goes on.
bool standsFree(const Bar& bar, const GripReadings& grip) {
  constexpr double kBeside_m = 0.02;
  constexpr double kNoFront = 0.5;  // of its height
  constexpr double kSure = 2.0;     // deviations
  std::array<Flank, 2> sides;
  std::array<Flank, 2> ends;
  const double c = std::cos(bar.roll_rad);
  const double s = std::sin(bar.roll_rad);
  for (const GripReading& reading : grip.readings) {
    const double dz = reading.along_m - bar.along_m;
    const double dy = reading.across_m - bar.across_m;
    const double z = std::abs(c * dz - s * dy) - bar.half_length_m;
    const double y = std::abs(s * dz + c * dy) - bar.half_width_m;
    const auto isBeside = [&](double way_m) { return way_m > bar.blur_m && way_m < bar.blur_m + kBeside_m; };
    if (z < 0.0 && isBeside(y)) {
      Flank& side = sides[s * dz + c * dy > 0.0 ? 1 : 0];
      side.sum_m += reading.height_m - bar.offset_m;
      ++side.readings;
    } else if (y < 0.0 && isBeside(z)) {
      Flank& end = ends[c * dz - s * dy > 0.0 ? 1 : 0];
      end.sum_m += reading.height_m - bar.offset_m;
      ++end.readings;
    }
  }
  const auto isFront = [&](const Flank& flank) {  // or may be
    const double noise_m = kSure * grip.sigma_m / std::sqrt(std::max(1.0, grip.share * flank.readings));
    return flank.mean_m() - noise_m < kNoFront * bar.height_m;
  };
  return std::all_of(sides.begin(), sides.end(), [&](const Flank& side) { return side.readings > 0 && isFront(side); }) &&
         std::all_of(ends.begin(), ends.end(), isFront);
}

}  // namespace

std::vector<std::string> GripConfig::validate() const {
  return base::ConfigRules()
      .greater("place_sigma_m", place_sigma_m, 0.0)
      .greater("height_sigma_m", height_sigma_m, 0.0)
      .greater("roll_sigma_deg", roll_sigma_deg, 0.0)
      .greater("length_sigma_m", length_sigma_m, 0.0)
      .atLeast("mixture_sigma_m", mixture_sigma_m, 0.0)
      .greater("bar_radius_m", bar_radius_m, 0.0)
      .greater("radius_sigma_m", radius_sigma_m, 0.0)
      .greater("bar_length_m", bar_length_m, 0.0)
      .greater("knob_width_m", knob_width_m, 0.0)
      .greater("search_m", search_m, 0.0)
      .atLeast("min_reach_m", min_reach_m, 0.0)
      .greater("max_reach_m", max_reach_m, min_reach_m)
      .greater("offset_sigma_m", offset_sigma_m, 0.0)
      .greater("sharp_blur_px", sharp_blur_px, 0.0)
      .greater("wide_blur_px", wide_blur_px, 0.0)
      .greater("correlation_px", correlation_px, 0.0)
      .atLeast("floor_m", floor_m, 0.0)
      .greater("noise_floor_m", noise_floor_m, 0.0)
      .atLeast("most_readings", most_readings, 100)
      .atLeast("min_readings", min_readings, 1)
      .between("max_hidden", max_hidden, 0.0, 1.0)
      .greater("min_gain", min_gain, 0.0)
      .greater("apart_m", apart_m, 0.0)
      .atLeast("most_places", most_places, 1)
      .messages();
}

Bar believedBar(const GripBelief& belief) {
  Bar bar;
  bar.height_m = belief.is_knob ? 2.0 * belief.height_m() : belief.height_m() + kSeenOfBar * belief.half_width_m;
  bar.half_length_m = belief.half_length_m;
  bar.half_width_m = belief.half_width_m;
  return bar;
}

std::vector<GripPlace> searchGrip(const GripBelief& belief, const GripReadings& readings, const GripConfig& config) {
  std::vector<GripPlace> places;
  for (const GridPlace& start : bestOfGrid(readings, believedBar(belief), config)) {
    const GripPlace place = refined(belief, start, readings, config);
    if (place.gain >= config.min_gain && place.bar.height_m >= config.min_reach_m && standsFree(place.bar, readings)) {
      places.push_back(place);
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const GripPlace& a, const GripPlace& b) { return a.score > b.score; });
  return places;
}

std::vector<PlaceEvidence> evidenceOf(const GripBelief& belief, const GripReadings& readings, const GripConfig& config) {
  const Bar believed = believedBar(belief);
  return Grid(readings, believed, config).evidence(config.wide_blur_px * readings.pixel_m);
}

}  // namespace oikos::registration
