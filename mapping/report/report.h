// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/camera/pinhole_camera.h"
#include "core/recording/trajectory.h"
#include "mapping/change/change_finder.h"

namespace oikos::mapping {

/// A frame, or a line of a list, that could not be used, and why.
struct SkippedFrame {
  std::string name;    ///< as the recording calls it, relative to its folder
  std::string reason;  ///< one line for a person
};

struct RecordingFacts {
  std::string format;     ///< "tum", "7-scenes", …
  int frames_listed = 0;  ///< colour images that the recording names
  int frames_read = 0;    ///< colour and depth decoded and used
  int skipped = 0;        ///< unreadable: missing, truncated, of a wrong size
  int unmatched = 0;      ///< colour without depth near enough in time
  int duplicates = 0;     ///< repeated stamps
  std::vector<SkippedFrame> messages;
  camera::PinholeCamera camera;  ///< the rectified colour camera
};

/// How a frame got its pose.
enum class FrameStatus {
  kTracked,      ///< followed from the frames before
  kRelocalised,  ///< found again after a loss
  kCarried,      ///< not followed; moved on by the wheels' odometry from the last frame that was
  kLost,         ///< keeps the last pose
};
constexpr auto enumTable(FrameStatus) {
  return std::to_array<base::EnumName<FrameStatus>>({{FrameStatus::kTracked, "tracked"},
                                                     {FrameStatus::kRelocalised, "relocalised"},
                                                     {FrameStatus::kCarried, "carried"},
                                                     {FrameStatus::kLost, "lost"}});
}

struct FrameFacts {
  FrameStatus status = FrameStatus::kLost;
  int inliers = 0;           ///< matches that agree with the motion
  double residual_px = 0.0;  ///< root mean square over the inliers; NaN when there are none
  bool is_keyframe = false;
};

enum class LoopVerdict { kAccepted, kDownWeighted, kRejectedByGeometry, kRejectedByConsistency };
constexpr auto enumTable(LoopVerdict) {
  return std::to_array<base::EnumName<LoopVerdict>>({{LoopVerdict::kAccepted, "accepted"},
                                                     {LoopVerdict::kDownWeighted, "down-weighted"},
                                                     {LoopVerdict::kRejectedByGeometry, "rejected-by-geometry"},
                                                     {LoopVerdict::kRejectedByConsistency, "rejected-by-consistency"}});
}

/// A place that looked like one seen before, and what became of it.
struct LoopFacts {
  int from_frame = 0;  ///< the later one; index into MapReport::frames
  int to_frame = 0;    ///< the earlier one
  int inliers = 0;
  double residual_px = 0.0;
  LoopVerdict verdict = LoopVerdict::kRejectedByGeometry;
  bool is_to_earlier_drive = false;  ///< `to_frame` is an index into MapReport::extension->trajectory instead
};

/// One of the drives that a map is made of.
struct DriveFacts {
  int first_frame = 0;  ///< frames are numbered through, in the order of trajectory.txt
  int frames = 0;
  std::int64_t added_to_stamps_s = 0;  ///< to each stamp of its recording, where its clock does not go on from the drive before
};

/// A piece of furniture that was found elsewhere than the home has it.
struct MovedPieceFacts {
  std::string id;
  Eigen::Isometry3d T_map_before = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_after = Eigen::Isometry3d::Identity();
  int views = 0;          ///< that agree on it
  double spread_m = 0.0;  ///< of their answers, root mean square
};

/// What the home's furniture has to do with changes.
struct ChangeExplanation {
  std::vector<std::string> pieces;     ///< one a change: the id of the piece that it is of; empty: of none that is known
  std::vector<MovedPieceFacts> moved;  ///< in the home's order
};

/// What was there before a drive that extends a map, and what became of it.
struct ExtensionFacts {
  recording::Trajectory trajectory;  ///< T_map_camera of the earlier drives' frames, final
  int keyframes = 0;                 ///< of the earlier drives
  int witnesses = 0;                 ///< keyframes of this drive that are kept because they show changes
  double largest_move_m = 0.0;       ///< of an earlier keyframe, by the optimisation with this drive
  ChangeExplanation explanation;     ///< pieces: one a change, or none at all: nobody knew the furniture
  std::vector<Change> changes;       ///< of what stands where, between the earlier drives and this one
};

/// A number that the optimiser was free to change.
struct RefinedValue {
  std::string name;  ///< with its unit: "rolling_shutter_readout_s", "depth_scale", "fx_px"
  double before = 0.0;
  double after = 0.0;
};

struct OptimisationFacts {
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int iterations = 0;
  bool converged = false;
  std::vector<RefinedValue> refined;
};

enum class FloorSighting { kFound, kNotInSight };
constexpr auto enumTable(FloorSighting) {
  return std::to_array<base::EnumName<FloorSighting>>({{FloorSighting::kFound, "found"}, {FloorSighting::kNotInSight, "not-in-sight"}});
}

struct FloorFacts {
  FloorSighting status = FloorSighting::kNotInSight;
  double camera_height_m = 0.0;  ///< of the first frame's camera over the floor
};

struct VolumeFacts {
  double resolution_m = 0.0;
  std::int64_t voxels_occupied = 0;
  std::int64_t voxels_free = 0;
  std::int64_t cells_occupied = 0;  ///< of the 2D grid
  std::int64_t cells_free = 0;
  std::int64_t cloud_points = 0;
  std::int64_t mesh_triangles = 0;
  Eigen::Vector3d box_min_m = Eigen::Vector3d::Zero();  ///< of the cloud, frame map
  Eigen::Vector3d box_max_m = Eigen::Vector3d::Zero();
};

/// How the map lies on the floor plan; what the figures mean stands with PlanFigures.
struct PlanFacts {
  Eigen::Isometry2d T_plan_map = Eigen::Isometry2d::Identity();
  Eigen::Isometry2d T_map_base = Eigen::Isometry2d::Identity();  ///< the robot at the first frame
  double plan_m = 0.0;
  double supported_share = 0.0;
  double on_plan_share = 0.0;
  double rms_m = 0.0;
  double crossed_m = 0.0;
  double missing_m = 0.0;
  double floor_outside_m2 = 0.0;
  double beyond_share = 0.0;
  std::vector<std::array<Eigen::Vector2d, 2>> lines_map;  ///< the plan's
};

/// The 2D grid as `grid.pgm` has it: row 0 is the greatest y; 0 occupied, 254 free, anything else unknown.
struct GridPicture {
  cv::Mat cells;                                       ///< CV_8UC1; empty: there is none
  double resolution_m = 0.0;                           ///< side of a cell
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  ///< lower left corner of the lower left cell, frame map
};

/// Everything that `report.json` and `report.html` tell about a map. Plain values, equal for equal input: no time of day, no
/// time taken, no path, no thread count. Frames, trajectory and loops are those of this drive. One entry of `frames` and `trajectory` per
/// frame read, in order.
struct MapReport {
  RecordingFacts recording;
  std::vector<FrameFacts> frames;
  recording::Trajectory trajectory;               ///< T_map_camera, final
  recording::Trajectory trajectory_before_loops;  ///< the same frames by odometry alone, first pose as above; empty: not kept
  int submaps = 1;                                ///< pieces that tracking left, because it was lost in between
  int submaps_joined = 1;                         ///< pieces that are in the one map, the first included
  int relocalisations = 0;
  std::vector<LoopFacts> loops;
  OptimisationFacts optimisation;
  FloorFacts floor;
  std::optional<PlanFacts> plan;            ///< nothing: there was no floor plan
  std::vector<DriveFacts> drives;           ///< all that the map is made of, this one last
  std::optional<ExtensionFacts> extension;  ///< nothing: the map is of this drive alone
  VolumeFacts volume;
  GridPicture grid;
  std::vector<std::string> warnings;  ///< one line each, for a person
};

/// `report.json`: everything but the grid's picture, in a fixed order of keys, UTF-8. Not finite numbers become null.
[[nodiscard]] std::string reportJson(const MapReport& report);

/// `report.html`: one page that needs nothing else, readable on a screen (light and dark) and on paper; well-formed XML, too.
[[nodiscard]] std::string reportHtml(const MapReport& report);

}  // namespace oikos::mapping
