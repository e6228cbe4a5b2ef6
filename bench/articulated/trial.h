// SPDX-License-Identifier: Apache-2.0
// One piece of furniture with its doors and drawers somewhere, seen once by a simulated sensor and registered.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/articulated/world.h"
#include "registration/articulated/articulated_registration.h"

namespace oikos::bench {

struct TrialSettings {
  WorldSettings world;
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

/// Where the piece and its joints are believed to be: the joints anywhere in their ranges.
[[nodiscard]] registration::Standing believedAnywhere(const World& world, const WorldSettings& settings, Random& random);

/// The kinds take turns.
[[nodiscard]] PieceTrial runTrial(int number, const TrialSettings& settings);

}  // namespace oikos::bench
