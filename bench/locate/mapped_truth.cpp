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

}  // namespace

recording::Trajectory truthInMap(const recording::Trajectory& mapped, const recording::Trajectory& truth) {
  std::vector<Eigen::Vector3d> in_map;
  std::vector<Eigen::Vector3d> in_truth;
  for (const metrics::PosePair& pair : metrics::associate(mapped, truth, metrics::Association::kNearest, kSameStamp_ns)) {
    in_map.emplace_back(pair.T_estimate_camera.translation());
    in_truth.emplace_back(pair.T_truth_camera.translation());
  }
  const geometry::RigidAlignment alignment = geometry::alignRigid(in_map, in_truth);
  if (alignment.status != geometry::RigidAlignmentStatus::kAligned) {
    throw std::runtime_error("the mapped frames cannot be aligned");
  }
  std::printf("map to truth over %zu mapped frames: %.2f cm rms\n", in_map.size(), 100.0 * alignment.rms_m);
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
