// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/frame_poses.h"

#include <map>

#include "core/base/parallel.h"
#include "mapping/odometry/pose_solver.h"

namespace oikos::mapping {

namespace {

double secondsBetween(const TrackedFrame& a, const TrackedFrame& b) {
  return 1e-9 * static_cast<double>(b.stamp_ns - a.stamp_ns);
}

Eigen::Vector3d pointInWorld(const KeyframeGraph& graph, const Landmark& landmark, const RollingShutterCamera& camera) {
  const Node& host = graph.nodes[static_cast<std::size_t>(landmark.host)];
  const Eigen::Isometry3d T_world_row = host.T_world_camera * geometry::expSe3(camera.rowTime_s(landmark.pixel.y()) * host.velocity);
  return T_world_row * pointInHost(landmark, camera.pinhole);
}

PoseSolution solveOne(const KeyframeGraph& graph, const TrackedFrame& frame, const RollingShutterCamera& camera,
                      const Eigen::Isometry3d& T_world_frame_start, const geometry::Vector6d& velocity, double pixel_sigma_px) {
  std::vector<PointSighting> sightings;
  for (const Observation& o : frame.observations) {
    const Landmark& landmark = graph.landmarks[static_cast<std::size_t>(o.landmark)];
    const Eigen::Vector2d pixel = o.pixel.cast<double>();
    sightings.push_back({pointInWorld(graph, landmark, camera), pixel, static_cast<float>(o.depth_m), pixel_sigma_px * (1 << o.level),
                         camera.rowTime_s(pixel.y())});
  }
  PoseSolverConfig config;
  config.depth_weight = 0.1;
  return solvePose(sightings, camera.pinhole, T_world_frame_start, config, velocity);
}

}  // namespace

std::vector<Eigen::Isometry3d> posesFromReferences(const KeyframeGraph& graph, const std::vector<TrackedFrame>& frames) {
  std::vector<Eigen::Isometry3d> poses;
  for (const TrackedFrame& frame : frames) {
    poses.push_back(graph.nodes[static_cast<std::size_t>(frame.reference)].T_world_camera * frame.T_reference_frame);
  }
  return poses;
}

std::vector<geometry::Vector6d> velocitiesOf(const std::vector<TrackedFrame>& frames, const std::vector<Eigen::Isometry3d>& T_world_frame,
                                             double max_gap_s) {
  std::vector<geometry::Vector6d> velocities(frames.size(), geometry::Vector6d::Zero());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto usable = [&](std::size_t a, std::size_t b) {
      return frames[a].status != TrackingStatus::kLost && frames[b].status != TrackingStatus::kLost &&
             frames[b].status != TrackingStatus::kStart && secondsBetween(frames[a], frames[b]) < max_gap_s;
    };
    const std::size_t before = i > 0 && usable(i - 1, i) ? i - 1 : i;
    const std::size_t after = i + 1 < frames.size() && usable(i, i + 1) ? i + 1 : i;
    if (before != after) {
      velocities[i] =
          geometry::logSe3(T_world_frame[before].inverse() * T_world_frame[after]) / secondsBetween(frames[before], frames[after]);
    }
  }
  return velocities;
}

void setNodeVelocities(KeyframeGraph& graph, const std::vector<TrackedFrame>& frames, const std::vector<geometry::Vector6d>& velocities) {
  std::map<int, std::size_t> position;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    position[frames[i].frame] = i;
  }
  for (Node& node : graph.nodes) {
    if (const auto found = position.find(node.frame); found != position.end()) {
      node.velocity = velocities[found->second];
    }
  }
}

std::vector<Eigen::Isometry3d> solveFramePoses(const KeyframeGraph& graph, const std::vector<TrackedFrame>& frames,
                                               const RollingShutterCamera& camera, const std::vector<geometry::Vector6d>& velocities,
                                               double pixel_sigma_px, int threads) {
  std::vector<Eigen::Isometry3d> poses = posesFromReferences(graph, frames);
  base::parallelFor(static_cast<int>(frames.size()), threads, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    const PoseSolution solution = solveOne(graph, frames[i], camera, poses[i], velocities[i], pixel_sigma_px);
    if (solution.status == PoseStatus::kConverged && solution.inliers >= 15) {
      poses[i] = solution.T_world_camera;
    }
  });
  return poses;
}

}  // namespace oikos::mapping
