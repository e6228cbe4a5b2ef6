// SPDX-License-Identifier: Apache-2.0
// A robot that drives past a piece of furniture while somebody moves one of its joints.
#pragma once

#include <string>
#include <vector>

#include "bench/articulated/trial.h"
#include "registration/articulated/joint_fusion.h"

namespace oikos::bench {

struct SequenceSettings {
  TrialSettings trial;
  registration::JointFusionConfig fusion;
  int frames = 12;
  double arc_deg = 25.0;  ///< that the robot drives around the piece
};

/// One joint over the images.
struct JointSequence {
  std::string kind;
  std::string joint;
  bool is_turn = false;
  bool has_moved = false;       ///< between two images in the middle, by 10 deg or 5 cm at least
  bool is_split_right = false;  ///< as many spans as there are states, and the change between the right two images that see the joint
  std::size_t spans = 0;
  registration::JointStatus status = registration::JointStatus::kNotInView;  ///< of the last span
  double error = 0.0;                                                        ///< of the last span: rad or m
  double variance = 0.0;
  double mean_error = 0.0;  ///< of the images of the last state that have found the joint, each by itself
  int found = 0;            ///< how many they are
};

[[nodiscard]] std::vector<JointSequence> runSequence(int number, const SequenceSettings& settings);

}  // namespace oikos::bench
