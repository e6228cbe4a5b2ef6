// SPDX-License-Identifier: Apache-2.0
#include "registration/handles/bar_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHeightSigma_m = 0.01;  // wide: how much of its height a sensor shows is not known
constexpr double kLeastBlur = 0.75;      // of the readings' spacing: an edge between two of them could not be moved
constexpr double kMostHigher_m = 0.015;  // than believed: a hair that stands out by a hand looks much like a bar
constexpr double kHuber = 2.5;
constexpr int kRounds = 12;

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

}  // namespace

Bar believedBar(const GripBelief& belief) {
  Bar bar;
  bar.height_m = belief.is_knob ? 2.0 * belief.height_m() : belief.height_m() + kSeenOfBar * belief.half_width_m;
  bar.half_length_m = belief.half_length_m;
  bar.half_width_m = belief.half_width_m;
  return bar;
}

GripPlace fitBar(const GripBelief& belief, const Bar& start, const GripReadings& readings, const GripConfig& config) {
  return BarFit(belief, start, readings, config).refine(start);
}

}  // namespace oikos::registration
