// SPDX-License-Identifier: Apache-2.0
#include "bench/locate/mapped_truth.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "core/geometry/rigid_alignment.h"
#include "core/metrics/trajectory_association.h"

namespace oikos::bench {

namespace {

constexpr std::int64_t kSameStamp_ns = 1'000'000;

/// Points a metre from the camera to all sides: a short path holds a rotation badly, the orientations along it hold it well.
void appendSurroundings(const Eigen::Isometry3d& T_map_camera, std::vector<Eigen::Vector3d>& points_map) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      points_map.emplace_back(T_map_camera * Eigen::Vector3d(side * Eigen::Vector3d::Unit(axis)));
    }
  }
}

}  // namespace

recording::Trajectory truthInMap(const recording::Trajectory& mapped, const recording::Trajectory& truth) {
  std::vector<Eigen::Vector3d> in_map;
  std::vector<Eigen::Vector3d> in_truth;
  for (const metrics::PosePair& pair : metrics::associate(mapped, truth, metrics::Association::kNearest, kSameStamp_ns)) {
    appendSurroundings(pair.T_estimate_camera, in_map);
    appendSurroundings(pair.T_truth_camera, in_truth);
  }
  const geometry::RigidAlignment alignment = geometry::alignRigid(in_map, in_truth);
  if (alignment.status != geometry::RigidAlignmentStatus::kAligned) {
    throw std::runtime_error("the mapped frames cannot be aligned");
  }
  std::printf("map to truth over %zu mapped frames: %.2f cm rms, a metre around the camera\n", in_map.size() / 6, 100.0 * alignment.rms_m);
  recording::Trajectory moved = truth;
  for (recording::StampedPose& pose : moved) {
    pose.T_map_camera = alignment.T_a_b * pose.T_map_camera;
  }
  return moved;
}

const Eigen::Isometry3d& poseAt(const recording::Trajectory& poses, std::int64_t stamp_ns) {
  for (const recording::StampedPose& pose : poses) {
    if (std::abs(pose.stamp_ns - stamp_ns) < kSameStamp_ns) {
      return pose.T_map_camera;
    }
  }
  throw std::runtime_error("a frame without a true pose");
}

}  // namespace oikos::bench
