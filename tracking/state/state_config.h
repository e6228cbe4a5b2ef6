// SPDX-License-Identifier: Apache-2.0
// How doors and drawers are read from a recording.
#pragma once

#include <string>
#include <vector>

#include "registration/articulated/articulated_registration.h"
#include "registration/articulated/joint_fusion.h"
#include "registration/scan.h"
#include "tracking/furniture/moved_furniture.h"
#include "tracking/objects/object_config.h"
#include "tracking/state/knob_track_config.h"
#include "tracking/state/piece_handles.h"

namespace oikos::tracking {

/// Which frames are worth a registration. One takes as long as several frames take to be located, and neighbouring frames repeat each
/// other: of a stay before a piece some frames are enough. Where they disagree, frames between them are taken until the moment is found.
struct FrameChoiceConfig {
  double most_hz = 10.0;            ///< frames of a faster recording are passed over
  int step_px = 8;                  ///< readings of pieces are counted in one pixel of so many rows and columns
  int min_pixels = 40;              ///< of these, those within its reach
  double max_range_m = 4.0;         ///< of readings that count
  double max_pose_sigma_m = 0.05;   ///< of a frame's pose at the piece, in x and in y; one in more doubt does not see it
  double max_pose_sigma_deg = 2.5;  ///< likewise of its yaw
  double gap_s = 4.0;               ///< out of view for longer, a piece is seen anew
  double spacing_s = 0.7;           ///< between two frames of one stay, at least,
  int most_frames = 8;              ///< and of one stay, at most
  double reach_weight = 0.6;        ///< of a reading where only an open door or drawer can be, against one where the piece stands
  double whole_weight = 0.15;       ///< of a frame's worth: that the piece is in it as a whole
  int most_halvings = 8;            ///< of the time between two frames that disagree

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("most_hz", most_hz);
    visitor("step_px", step_px);
    visitor("min_pixels", min_pixels);
    visitor("max_range_m", max_range_m);
    visitor("max_pose_sigma_m", max_pose_sigma_m);
    visitor("max_pose_sigma_deg", max_pose_sigma_deg);
    visitor("gap_s", gap_s);
    visitor("spacing_s", spacing_s);
    visitor("most_frames", most_frames);
    visitor("reach_weight", reach_weight);
    visitor("whole_weight", whole_weight);
    visitor("most_halvings", most_halvings);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// How well the home's places are known: standard deviations of x and y, and of the yaw.
struct PlacementConfig {
  double fixed_sigma_m = 0.010;  ///< of built-in furniture, as a tape measures it
  double fixed_sigma_deg = 0.5;
  double shiftable_sigma_m = 0.030;  ///< of what is pushed now and then
  double shiftable_sigma_deg = 2.0;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("fixed_sigma_m", fixed_sigma_m);
    visitor("fixed_sigma_deg", fixed_sigma_deg);
    visitor("shiftable_sigma_m", shiftable_sigma_m);
    visitor("shiftable_sigma_deg", shiftable_sigma_deg);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// When a reading is an event. Both must be exceeded: the significance, so that noise makes none, and the least change, so that none is
/// made of a joint that was nudged.
struct ChangeTestConfig {
  double significance = 4.0;        ///< difference over its deviation, that of the reading and that of the belief
  double believed_sigma_deg = 1.0;  ///< of what the home believes of a hinge,
  double believed_sigma_m = 0.006;  ///< and of a slide
  double min_change_deg = 4.0;
  double min_change_m = 0.015;
  double closed_deg = 2.0;  ///< a reading this near to its closed end is closed
  double closed_m = 0.01;
  int min_images = 2;  ///< that have found the new value

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("significance", significance);
    visitor("believed_sigma_deg", believed_sigma_deg);
    visitor("believed_sigma_m", believed_sigma_m);
    visitor("min_change_deg", min_change_deg);
    visitor("min_change_m", min_change_m);
    visitor("closed_deg", closed_deg);
    visitor("closed_m", closed_m);
    visitor("min_images", min_images);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct StateConfig {
  FrameChoiceConfig frames;
  PlacementConfig placement;
  registration::ScanConfig scan;
  registration::ArticulatedConfig registration;
  registration::JointFusionConfig fusion;
  ChangeTestConfig change;
  MovedFurnitureConfig furniture;  ///< of shiftable pieces
  KnobTrackConfig knobs;
  HandleTrackConfig handles;
  ObjectWatchConfig objects;  ///< small ones

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("frames", frames);
    visitor("placement", placement);
    visitor("scan", scan);
    visitor("registration", registration);
    visitor("fusion", fusion);
    visitor("change", change);
    visitor("furniture", furniture);
    visitor("knobs", knobs);
    visitor("handles", handles);
    visitor("objects", objects);
  }
  [[nodiscard]] std::vector<std::string> validate() const { return {}; }
};

}  // namespace oikos::tracking
