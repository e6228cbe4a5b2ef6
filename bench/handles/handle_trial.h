// SPDX-License-Identifier: Apache-2.0
// One piece of furniture seen once by a simulated sensor, its doors and drawers registered, and then the handles on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/articulated/world.h"
#include "registration/articulated/articulated_registration.h"
#include "registration/handles/handle_finder.h"

namespace oikos::bench {

struct HandleTrialSettings {
  WorldSettings world;
  std::uint64_t seed = 1;
  double least_m = 0.8;  ///< from the piece's front to the camera,
  double most_m = 2.0;
  double most_off_axis_deg = 45.0;   ///< to either side of what it faces
  double least_displaced_m = 0.003;  ///< of each handle on its front, in any direction, from where it is believed,
  double most_displaced_m = 0.02;
  double height_m = 0.002;  ///< deviation of how far it stands out,
  double length_m = 0.005;  ///< of a bar's length,
  double roll_deg = 0.5;    ///< and of its direction in the front
  registration::ArticulatedConfig registration;
  registration::HandleConfig handles;
};

/// A handle on a part that the registration has found.
struct HandleTrial {
  int number = 0;
  std::string kind;
  std::string name;
  bool is_knob = false;
  bool is_recessed = false;
  bool is_visible = false;  ///< at least half of it, its front not more than 60 degrees from the camera
  double visible = 0.0;     ///< share of its pixels, seen as from here with nothing before it, that the perfect camera sees
  double slant_deg = 0.0;   ///< between its front's normal and the camera
  double distance_m = 0.0;
  registration::HandleStatus status = registration::HandleStatus::kNoFront;
  double error_m = 0.0;                               ///< of its place in map
  Eigen::Vector3d off_m = Eigen::Vector3d::Zero();    ///< the same in the true handle's frame: out of the front, across, along
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();  ///< that is stated of these
  double normal_error_deg = 0.0;
  double rotation_error_deg = 0.0;  ///< of all of its orientation; a knob has none about its axis
  double prior_error_m = 0.0;       ///< of the model's handle on the registered part
  double prior_normal_error_deg = 0.0;
  double length_error_m = 0.0;
  double gain = 0.0;
  int points = 0;
  double ms = 0.0;  ///< of processor time, a handle of the part
};

/// Kinds of furniture with bars and knobs.
[[nodiscard]] const std::vector<WorldKind>& handleKinds();

/// The kinds take turns.
[[nodiscard]] std::vector<HandleTrial> runHandleTrial(int number, const HandleTrialSettings& settings);

}  // namespace oikos::bench
