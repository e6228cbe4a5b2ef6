// SPDX-License-Identifier: Apache-2.0
// Depth readings as a beam that may end at the surface, before it, behind it or anywhere (Thrun, Burgard & Fox, "Probabilistic Robotics",
// 2005, 6.3), with one component more: what lies inside an opened cupboard or drawer, which no model has.
#include "registration/articulated/pixel_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/config_rules.h"

namespace oikos::registration {

namespace {

constexpr double kTurnedAway = 0.1;  // of a reading whose normal is another: noise, or an edge
constexpr double kNearest_m = 0.3;

}  // namespace

std::vector<std::string> MixtureConfig::validate() const {
  base::ConfigRules rules;
  rules
      .require(as_modelled > contents && as_modelled + nearer + behind < 1.0, "as_modelled", as_modelled,
               "must be > contents, and with nearer and behind < 1")
      .greater("nearer", nearer, 0.0)
      .greater("behind", behind, 0.0)
      .atLeast("contents", contents, 0.0)
      .atLeast("min_room_m", min_room_m, 0.0)
      .require(max_normal_deg > 0.0 && max_normal_deg <= 90.0, "max_normal_deg", max_normal_deg, "must be > 0 and <= 90")
      .greater("range_m", range_m, 0.5);
  return rules.messages();
}

PixelMixture::PixelMixture(const MixtureConfig& config)
    : config_(config),
      log_of_nothing_(-std::log(config.range_m - kNearest_m)),
      min_normal_cos_(std::cos(config.max_normal_deg * std::numbers::pi / 180.0)) {}

PixelMixture::Densities PixelMixture::densities(double reading_m, const ModelledPixel& surface) const {
  const bool has_room = surface.room_m > config_.min_room_m;
  const double nowhere = 1.0 - config_.as_modelled - config_.nearer - config_.behind;
  const double deviations = (reading_m - surface.depth_m) / surface.sigma_m;
  Densities found;
  found.rest = nowhere / (config_.range_m - kNearest_m);
  if (reading_m < surface.depth_m) {
    found.rest += config_.nearer / std::max(0.1, surface.depth_m - kNearest_m);
    if (has_room && reading_m > surface.depth_m - surface.room_m) {
      found.rest += config_.contents / surface.room_m;
    }
  } else {
    found.rest += config_.behind / std::max(0.1, config_.range_m - surface.depth_m);
  }
  if (std::abs(deviations) < 6.0) {
    const double share = (has_room ? config_.as_modelled - config_.contents : config_.as_modelled) * (surface.faces ? 1.0 : kTurnedAway);
    found.surface = share * std::exp(-0.5 * deviations * deviations) / (surface.sigma_m * std::sqrt(2.0 * std::numbers::pi));
  }
  return found;
}

double PixelMixture::logOfSurface(double reading_m, const ModelledPixel& surface) const {
  const Densities found = densities(reading_m, surface);
  return std::log(found.surface + found.rest);
}

double PixelMixture::shareOfSurface(double reading_m, const ModelledPixel& surface) const {
  const Densities found = densities(reading_m, surface);
  return found.surface / (found.surface + found.rest);
}

double distanceToBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& start, const Eigen::Vector3d& ray) {
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (ray[axis] == 0.0) {
      if (start[axis] < box.min()[axis] || start[axis] > box.max()[axis]) {
        return std::numeric_limits<double>::infinity();
      }
      continue;
    }
    const double a = (box.min()[axis] - start[axis]) / ray[axis];
    const double b = (box.max()[axis] - start[axis]) / ray[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace oikos::registration
