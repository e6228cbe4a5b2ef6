// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/recording/recording.h"

namespace oikos::recording {

/// What an installer wants to know before leaving: is this drive good enough to make a map from?
struct InspectionConfig {
  int max_frames = 900;      ///< of a longer recording, bursts of consecutive frames spread over it are looked at
  int geometry_frames = 60;  ///< frames whose depth edges and planes are looked at
  int threads = 2;           ///< changes no result
  double max_blurred_share = 0.15;
  double max_turn_rate_deg_s = 60.0;   ///< at the 95th percentile
  double min_valid_depth_share = 0.5;  ///< of the pixels, mean over frames
  double max_edge_shift_px = 2.0;      ///< of depth edges against colour edges

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("max_frames", max_frames);
    visitor("geometry_frames", geometry_frames);
    visitor("max_blurred_share", max_blurred_share);
    visitor("max_turn_rate_deg_s", max_turn_rate_deg_s);
    visitor("min_valid_depth_share", min_valid_depth_share);
    visitor("max_edge_shift_px", max_edge_shift_px);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct RateReport {
  double rate_hz = 0.0;  ///< from the median interval
  double length_s = 0.0;
  int lost = 0;  ///< frames that fit into gaps of more than 1.5 intervals
  double longest_gap_s = 0.0;
};

struct BlurredFrame {
  int index = -1;
  std::string reason;
};

struct MotionReport {
  double median_rad_s = 0.0;  ///< turning that would explain the motion of the image
  double fast_rad_s = 0.0;    ///< 95th percentile
};

/// How far depth edges have to be moved in the image to fall on colour edges.
struct EdgeReport {
  double shift_u_px = 0.0;
  double shift_v_px = 0.0;
  int edges_u = 0;  ///< depth edges that tell of the shift along u
  int edges_v = 0;
  bool is_known_u = false;  ///< enough edges, and a clear optimum
  bool is_known_v = false;
};

struct FloorReport {
  bool is_seen = false;
  double camera_height_m = 0.0;   ///< median over the frames that see the floor
  double camera_pitch_rad = 0.0;  ///< of the optical axis above the horizon, median
  int frames = 0;                 ///< that see it
};

enum class Verdict { kGood, kUsable, kBad };
enum class Severity { kNote, kWarning, kFault };

struct Finding {
  Severity severity = Severity::kNote;
  std::string what;
  std::string advice;
};

struct Inspection {
  Verdict verdict = Verdict::kBad;
  std::vector<Finding> findings;  ///< worst first
  ListingStatistics listing;
  int frames = 0;      ///< pairs of colour and depth
  int inspected = 0;   ///< of them looked at
  int unreadable = 0;  ///< of them not readable
  std::vector<std::string> first_messages;
  RateReport rate;
  std::vector<BlurredFrame> blurred;  ///< of the inspected ones
  MotionReport motion;
  double valid_depth_share = 0.0;  ///< mean over the readable frames
  EdgeReport edges;
  int geometry_frames = 0;  ///< whose edges and planes were looked at
  FloorReport floor;
};

/// Never fails because of the recording's quality. Throws Error{kUsage} if the configuration is wrong. About 5 ms of processor time a
/// frame.
[[nodiscard]] Inspection inspect(const Recording& recording, const InspectionConfig& config = {}, const base::ProgressSink& progress = {});

/// For a person; lines of text without a last newline.
[[nodiscard]] std::string toText(const Inspection& inspection);
/// The same as JSON; angles in degrees.
[[nodiscard]] std::string toJson(const Inspection& inspection);

}  // namespace oikos::recording
