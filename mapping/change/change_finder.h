// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/enum_table.h"
#include "mapping/change/change_config.h"
#include "mapping/change/scan_view.h"
#include "mapping/change/seen_space.h"
#include "mapping/volume/voxel_key.h"

namespace oikos::mapping {

enum class ChangeKind { kNew, kGone };
constexpr auto enumTable(ChangeKind) {
  return std::to_array<base::EnumName<ChangeKind>>({{ChangeKind::kNew, "new"}, {ChangeKind::kGone, "gone"}});
}

/// What has changed, as the box along map's axes around the surface that was seen: what was hidden from all scans (new) or never mapped
/// (gone) may reach beyond.
struct Change {
  ChangeKind kind = ChangeKind::kNew;
  Eigen::Vector3d center_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  /// z in `map`, to a voxel, of what the box stands on, or stood on; nothing: it hangs, or what is below it was not seen.
  std::optional<double> support_height_m;
  /// 0 to 1: the share of views that agree, times the probability that an error of pose, depth and map is smaller than the median voxel
  /// stands clear. Errors of a scan's voxels are not independent: more voxels make a change no surer.
  double confidence = 0.0;
  std::vector<VoxelKey> voxels;  ///< ascending
};

enum class ChangeStatus {
  kNoSurface,  ///< no scan, or none with a reading where depth and pose are sure enough
  kNotInMap,   ///< the scans look at what the map does not know
  kMisplaced,  ///< so much has changed that the scans are elsewhere than they say
  kCompared,   ///< at least one scan
};
constexpr auto enumTable(ChangeStatus) {
  return std::to_array<base::EnumName<ChangeStatus>>({{ChangeStatus::kNoSurface, "no_surface"},
                                                      {ChangeStatus::kNotInMap, "not_in_map"},
                                                      {ChangeStatus::kMisplaced, "misplaced"},
                                                      {ChangeStatus::kCompared, "compared"}});
}

struct [[nodiscard]] ChangeResult {
  ChangeStatus status = ChangeStatus::kNoSurface;  ///< of the scan that came farthest
  std::vector<ChangeStatus> scans;                 ///< of each one, in their order; those not compared say nothing
  std::vector<Change> changes;                     ///< new ones first, then gone ones, each in the order of their lowest voxel key
};

/// What is new and what has gone at the scans' place (METHODS S222): new is a surface now where the map was seen free repeatedly, with all
/// neighbours within the tolerance, from views well apart (Dynablox); gone is a surface of the map that is seen through now, with all
/// pixels within the tolerance. The tolerance is that of each point, from the covariance of the scan's pose, depth noise and map. Space
/// that was not seen, then or now, is no change; a change smaller than the tolerance is not found, nor is one within it of what the map
/// has. Throws ContractViolation for images that do not fit their camera, poses or covariances that are none, and configurations that do
/// not validate. The same result for any number of threads.
ChangeResult findChanges(const SeenSpace& map, const std::vector<LocatedScan>& scans, const ChangeConfig& config);

}  // namespace oikos::mapping
