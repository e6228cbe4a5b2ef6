// SPDX-License-Identifier: Apache-2.0
#include "bench/handles/handle_trial.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <opencv2/core.hpp>

#include "bench/articulated/trial.h"

namespace oikos::bench {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr double kVisible = 0.5;
constexpr double kMostSlant_deg = 60.0;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double normal(Random& random) {
  return std::normal_distribution<double>()(random);
}

/// The model's handles are not where the real ones are.
void displaceHandles(const HandleTrialSettings& settings, Random& random, model::ArticulatedModel& believed) {
  for (model::ModelHandle& handle : believed.handles) {
    const double way_m = uniform(random, settings.least_displaced_m, settings.most_displaced_m);
    const double direction_rad = uniform(random, -std::numbers::pi, std::numbers::pi);
    const Eigen::Vector3d way(settings.height_m * normal(random), way_m * std::cos(direction_rad), way_m * std::sin(direction_rad));
    handle.T_part_handle.translate(way);
    handle.T_part_handle.rotate(Eigen::AngleAxisd(settings.roll_deg * kDegree * normal(random), Eigen::Vector3d::UnitX()));
    handle.length_m = handle.length_m.value_or(0.0) + (handle.kind == model::HandleKind::kBar ? settings.length_m * normal(random) : 0.0);
  }
}

/// Share of what would be seen of the grip, were nothing before it, that the perfect camera sees: readings of the part that lie around the
/// grip and clear of the front.
double visibleShare(const model::ModelHandle& handle, const Eigen::Isometry3d& T_map_handle, const World& world, const Picture& picture) {
  const bool is_knob = handle.kind == model::HandleKind::kKnob;
  const double half_length_m = 0.5 * handle.length_m.value_or(0.0);
  const double half_width_m = is_knob ? half_length_m : 0.006;
  const double half_height_m = is_knob ? 0.008 : 0.007;
  const Eigen::Isometry3d T_handle_camera = T_map_handle.inverse() * world.T_map_camera;
  int seen = 0;
  for (int v = 0; v < picture.view.part.rows; ++v) {
    for (int u = 0; u < picture.view.part.cols; ++u) {
      const int shown = picture.view.part.at<int>(v, u);
      if (shown < 0 || picture.part_of_scene[static_cast<std::size_t>(shown)] != handle.part) {
        continue;
      }
      const auto z_m = static_cast<double>(picture.view.depth_m.at<float>(v, u));
      const Eigen::Vector3d at_handle = T_handle_camera * (z_m * picture.camera.ray(u, v));
      const Eigen::Vector3d size = at_handle.cwiseAbs();
      seen += (is_knob ? at_handle.x() > -half_height_m : size.x() < half_height_m) && at_handle.x() < 0.02 &&
                      size.y() < half_width_m + 0.001 && size.z() < half_length_m + 0.001
                  ? 1
                  : 0;
    }
  }
  const Eigen::Vector3d eye_handle = T_handle_camera.translation();
  const double far_m = eye_handle.norm();
  const double facing = is_knob ? eye_handle.normalized().x() : std::hypot(eye_handle.x(), eye_handle.y()) / far_m;
  const double area_sq_m = (is_knob ? 0.785 : 1.0) * 4.0 * half_length_m * half_width_m * std::max(0.05, facing);
  return seen / (area_sq_m * picture.camera.fx * picture.camera.fy / (far_m * far_m));
}

HandleTrial judged(const registration::HandleEstimate& estimate, const World& world, const Picture& picture,
                   const Eigen::Isometry3d& T_map_part_found) {
  const auto index = static_cast<std::size_t>(estimate.handle);
  const model::ModelHandle& real = world.real.handles[index];
  const Eigen::Isometry3d T_map_true =
      world.T_map_model * model::Kinematics(world.real).solve(world.values)[static_cast<std::size_t>(real.part)] * real.T_part_handle;
  const Eigen::Isometry3d T_map_prior = T_map_part_found * world.believed.handles[index].T_part_handle;
  const Eigen::Isometry3d T_true_found = T_map_true.inverse() * estimate.T_map_handle;
  const Eigen::Vector3d eye_handle = T_map_true.inverse() * world.T_map_camera.translation();
  const auto normalError = [&](const Eigen::Isometry3d& T_map_handle) {
    return std::acos(std::clamp(T_map_true.linear().col(0).dot(T_map_handle.linear().col(0)), -1.0, 1.0)) / kDegree;
  };
  HandleTrial trial;
  trial.kind = world.kind;
  trial.name = estimate.name;
  trial.is_knob = real.kind == model::HandleKind::kKnob;
  trial.is_recessed = real.kind == model::HandleKind::kRecessed;
  trial.visible = visibleShare(real, T_map_true, world, picture);
  trial.slant_deg = std::acos(std::clamp(eye_handle.normalized().x(), -1.0, 1.0)) / kDegree;
  trial.distance_m = eye_handle.norm();
  trial.is_visible = trial.visible >= kVisible && trial.slant_deg <= kMostSlant_deg;
  trial.status = estimate.status;
  trial.off_m = T_true_found.translation();
  trial.sigma_m = estimate.covariance.diagonal().head<3>().cwiseSqrt();
  trial.error_m = trial.off_m.norm();
  trial.normal_error_deg = normalError(estimate.T_map_handle);
  trial.rotation_error_deg = trial.is_knob ? trial.normal_error_deg : Eigen::AngleAxisd(T_true_found.linear()).angle() / kDegree;
  trial.prior_error_m = (T_map_true.inverse() * T_map_prior).translation().norm();
  trial.prior_normal_error_deg = normalError(T_map_prior);
  trial.length_error_m = estimate.length_m - real.length_m.value_or(0.0);
  trial.gain = estimate.gain;
  trial.points = estimate.points;
  return trial;
}

}  // namespace

const std::vector<WorldKind>& handleKinds() {
  static const std::vector<WorldKind> kinds = {
      {"cabinet, bar", {"cabinet"}},
      {"two doors, bars", {"cabinet", {{"door_count", "2"}, {"width_m", "0.9"}, {"worktop_thickness_m", "0.04"}}}},
      {"two doors, knobs", {"cabinet", {{"door_count", "2"}, {"width_m", "0.9"}, {"worktop_thickness_m", "0.04"}, {"handle", "knob"}}}},
      {"cabinet, level bar", {"cabinet", {{"handle", "bar_horizontal"}, {"handle_length_m", "0.2"}, {"worktop_thickness_m", "0.04"}}}},
      {"drawers, bars", {"drawer_unit"}},
      {"drawers, knobs", {"drawer_unit", {{"handle", "knob"}}}},
      {"chest, knobs",
       {"drawer_unit", {{"drawer_count", "5"}, {"width_m", "0.8"}, {"height_m", "1.1"}, {"depth_m", "0.45"}, {"handle", "knob"}}}},
      {"wall cupboard, bar",
       {"cabinet",
        {{"bottom_m", "1.35"},
         {"height_m", "0.7"},
         {"depth_m", "0.35"},
         {"plinth_height_m", "0"},
         {"hinge", "right"},
         {"handle_level", "0.1"}}}},
      {"fridge, bars", {"fridge"}},
      {"oven, bar", {"oven"}},
  };
  return kinds;
}

std::vector<HandleTrial> runHandleTrial(int number, const HandleTrialSettings& settings) {
  Random random(settings.seed * 1'000'003 + static_cast<std::uint64_t>(number));
  const WorldKind& kind = handleKinds()[static_cast<std::size_t>(number) % handleKinds().size()];
  World world = makeWorld(kind, settings.world, random);
  displaceHandles(settings, random, world.believed);
  const double most_off_axis_rad = settings.most_off_axis_deg * kDegree;
  double depth_m = 0.0;
  for (const Eigen::Vector3f& vertex : world.real.parts[0].mesh_part->vertices) {
    depth_m = std::max(depth_m, static_cast<double>(vertex.x()));
  }
  lookFrom(depth_m + uniform(random, settings.least_m, settings.most_m), uniform(random, -most_off_axis_rad, most_off_axis_rad), world);
  const Picture picture = takePicture(world, settings.world, static_cast<std::uint64_t>(number) + settings.seed, random);
  const registration::Standing believed = believedAnywhere(world, settings.world, random);
  const registration::Scan scan = registration::makeScan(picture.depth_m, picture.camera, {});
  const registration::ArticulatedResult registered =
      registration::ArticulatedRegistration(world.believed, settings.registration).run(scan, world.T_map_camera, believed);
  const registration::HandleFinder finder(world.believed, settings.handles);
  std::vector<HandleTrial> trials;
  for (const registration::JointEstimate& joint : registered.joints) {
    if (joint.status != registration::JointStatus::kFound) {
      continue;
    }
    const int part = world.believed.joints[static_cast<std::size_t>(joint.joint)].child;
    const std::clock_t begin = std::clock();
    const std::vector<registration::HandleEstimate> found =
        finder.find({picture.depth_m, picture.camera, world.T_map_camera}, part, joint.T_map_part);
    const double ms = 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    for (const registration::HandleEstimate& estimate : found) {
      trials.push_back(judged(estimate, world, picture, joint.T_map_part));
      trials.back().number = number;
      trials.back().ms = ms / static_cast<double>(found.size());
    }
  }
  return trials;
}

}  // namespace oikos::bench
