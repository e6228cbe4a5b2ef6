// SPDX-License-Identifier: Apache-2.0
// One piece of furniture with its doors and drawers somewhere, seen once by a simulated sensor and registered.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/camera/sensor/depth_sensor.h"
#include "registration/articulated/articulated_registration.h"

namespace oikos::bench {

struct TrialSettings {
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kKinect1;
  double dimension_m = 0.005;  ///< deviation of each length from the model's
  double axis_m = 0.003;       ///< of each coordinate of a joint's origin,
  double axis_deg = 0.5;       ///< of its turn about any axis
  double placement_m = 0.005;  ///< of x and y of the piece
  double placement_deg = 0.3;  ///< of its yaw
  double shift_m = 0.0;        ///< the piece stands so far from where it is believed, in any direction,
  double shift_deg = 0.0;      ///< and is turned so far, to either side
  double occluded = 0.0;       ///< share of the piece's width that a person stands before
  bool has_contents = true;    ///< boxes that no model has, on shelves and in drawers
  std::uint64_t seed = 1;
  registration::ArticulatedConfig config;
};

/// One joint of one trial.
struct JointTrial {
  std::string kind;
  std::string joint;
  bool is_turn = false;
  registration::JointStatus status = registration::JointStatus::kNotInView;
  double true_value = 0.0;  ///< rad or m, as all that follow
  double prior = 0.0;
  double value = 0.0;
  double variance = 0.0;
  double confidence = 0.0;
  double visible = 0.0;  ///< pixels that show the part and have a reading of it, over those of its largest face seen straight on
  registration::JointSight sight;

  [[nodiscard]] double error() const;
  [[nodiscard]] bool isRight() const;  ///< within 5 deg or 2 cm
  [[nodiscard]] bool isFound() const { return status == registration::JointStatus::kFound; }
};

struct PieceTrial {
  int number = 0;
  std::string kind;
  std::vector<JointTrial> joints;
  double base_error_m = 0.0;
  double base_error_deg = 0.0;
  double ms = 0.0;  ///< of processor time: normals and registration, the model being loaded
};

[[nodiscard]] const std::vector<std::string>& trialKinds();
/// The kinds take turns.
[[nodiscard]] PieceTrial runTrial(int number, const TrialSettings& settings);

}  // namespace oikos::bench
