// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/earlier_map.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "core/base/error.h"
#include "core/geometry/se3.h"
#include "mapping/extend/earlier_edges.h"
#include "mapping/graph/frame_poses.h"
#include "mapping/graph/g2o_file.h"

namespace oikos::mapping {

namespace {

namespace fs = std::filesystem;

fs::path getStore(const fs::path& folder) {
  const fs::path file = folder / "keyframes.sqlite";
  if (!fs::exists(file)) {
    throw base::Error(base::ErrorCode::kUsage, "no such map to extend: make one first, without --extend", file.string());
  }
  return file;
}

bool isSamePlace(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  constexpr double kRounding = 1e-5;  // of texts and blobs
  return geometry::logSe3(a.inverse() * b).norm() < kRounding;
}

}  // namespace

EarlierMap::EarlierMap(const fs::path& folder, const SavedMapConfig& config)
    : keyframes_(getStore(folder), config), trajectory_(recording::readTrajectory(folder / "trajectory.txt")) {
  if (fs::exists(folder / "base_trajectory.txt")) {
    base_trajectory_ = recording::readTrajectory(folder / "base_trajectory.txt");
  }
  checkFrames(folder / "trajectory.txt");
  drives_ = readEarlierDrives(folder / "report.json", frameCount());
  readEdges(folder / "graph.g2o");
}

void EarlierMap::checkFrames(const fs::path& file) const {
  for (const Node& node : keyframes_.graph().nodes) {
    const auto frame = static_cast<std::size_t>(node.frame);
    if (node.frame < 0 || frame >= trajectory_.size()) {
      throw base::Error(base::ErrorCode::kInput,
                        "has " + std::to_string(trajectory_.size()) + " poses, but keyframes.sqlite beside it a keyframe of frame " +
                            std::to_string(node.frame) + ": they are not of one map; map the home again",
                        file.string());
    }
  }
}

void EarlierMap::readEdges(const fs::path& file) {
  const KeyframeGraph saved = readG2o(file);
  std::vector<int> position(saved.nodes.size(), -1);
  for (int node = 0; node < keyframes_.keyframeCount(); ++node) {
    const auto id = static_cast<std::size_t>(keyframes_.storedId(node));
    const Eigen::Isometry3d& T_map_camera = keyframes_.graph().nodes[static_cast<std::size_t>(node)].T_world_camera;
    if (id >= saved.nodes.size() || !isSamePlace(saved.nodes[id].T_world_camera, T_map_camera)) {
      throw base::Error(base::ErrorCode::kInput,
                        "vertex " + std::to_string(id) + " is not where keyframe " + std::to_string(id) +
                            " of keyframes.sqlite is: they are not of one map; map the home again",
                        file.string());
    }
    position[id] = node;
  }
  std::vector<int> drive;
  for (const Node& node : keyframes_.graph().nodes) {
    const auto next = std::find_if(drives().begin(), drives().end(), [&](const DriveFacts& d) { return node.frame < d.first_frame; });
    drive.push_back(static_cast<int>(next - drives().begin()));
  }
  edges_ = edgesBetweenKept(saved, position, drive);
}

/// Of each frame: the optimisation wants to know how a camera moved while its image was read out.
std::vector<geometry::Vector6d> EarlierMap::velocities() const {
  std::vector<TrackedFrame> frames(trajectory_.size());
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < trajectory_.size(); ++i) {
    frames[i].stamp_ns = trajectory_[i].stamp_ns;
    frames[i].status = TrackingStatus::kTracked;
    poses.push_back(trajectory_[i].T_map_camera);
  }
  return velocitiesOf(frames, poses);
}

FrontEndResult EarlierMap::start() const {
  FrontEndResult start;
  start.graph = keyframes_.graph();
  start.graph.edges = edges_;
  start.graph.settled = keyframes_.keyframeCount();
  const std::vector<geometry::Vector6d> moving = velocities();
  for (int node = 0; node < keyframes_.keyframeCount(); ++node) {
    Node& settled = start.graph.nodes[static_cast<std::size_t>(node)];
    settled.velocity = moving[static_cast<std::size_t>(settled.frame)];
    start.features.push_back(keyframes_.features(node));
  }
  return start;
}

std::optional<int> EarlierMap::findKeyframe(int frame) const {
  const std::vector<Node>& nodes = keyframes_.graph().nodes;
  const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) { return node.frame == frame; });
  return found == nodes.end() ? std::nullopt : std::optional(static_cast<int>(found - nodes.begin()));
}

}  // namespace oikos::mapping
