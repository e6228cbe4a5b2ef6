// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/metrics/error_statistics.h"

namespace oikos::metrics {

struct MapErrorConfig {
  double fine_m = 0.02;    ///< first limit of the shares below
  double coarse_m = 0.05;  ///< second limit
  int threads = 1;         ///< the result does not depend on it

  /// What is wrong, a line each; empty when all is well.
  [[nodiscard]] std::vector<std::string> validate() const;
};

enum class MapErrorStatus { kEmptyCloud, kEmptyReference, kNonFinite, kEvaluated };
constexpr auto enumTable(MapErrorStatus) {
  return std::to_array<base::EnumName<MapErrorStatus>>({{MapErrorStatus::kEmptyCloud, "empty-cloud"},
                                                        {MapErrorStatus::kEmptyReference, "empty-reference"},
                                                        {MapErrorStatus::kNonFinite, "non-finite"},
                                                        {MapErrorStatus::kEvaluated, "evaluated"}});
}

/// Distances from each point of one cloud to the nearest point of the other.
struct CloudDistance {
  ErrorStatistics distance_m;
  double share_within_fine = 0.0;    ///< points at most `fine_m` away / all points
  double share_within_coarse = 0.0;  ///< points at most `coarse_m` away / all points
};

struct [[nodiscard]] MapError {
  MapErrorStatus status = MapErrorStatus::kEmptyCloud;
  CloudDistance accuracy;      ///< from the cloud to the reference: what was mapped, is it there?
  CloudDistance completeness;  ///< from the reference to the cloud: what is there, was it mapped?
};

/// Accuracy and completeness as in Seitz et al., "A comparison and evaluation of multi-view stereo reconstruction algorithms",
/// CVPR 2006 (doi:10.1109/CVPR.2006.19), between points in one frame, in metres; nothing is aligned. The reference has to be
/// sampled more densely than the errors that matter. O(n log m), nearest neighbours by k-d tree.
MapError evaluateMap(const std::vector<Eigen::Vector3f>& cloud_map, const std::vector<Eigen::Vector3f>& reference_map,
                     const MapErrorConfig& config = {});

}  // namespace oikos::metrics
