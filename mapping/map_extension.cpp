// SPDX-License-Identifier: Apache-2.0
#include "mapping/map_extension.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "core/base/config.h"
#include "core/base/error.h"
#include "mapping/extend/known_views.h"
#include "mapping/odometry/corner_detector.h"

namespace oikos::mapping {

namespace {

/// The frames whose place in the map is known.
std::vector<DriveView> placedFrames(const FrontEndResult& drive, const BackEndResult& optimised) {
  std::set<int> keyframes;
  for (const Node& node : drive.graph.nodes) {
    if (node.keyframe) {
      keyframes.insert(node.frame);
    }
  }
  std::vector<DriveView> views;
  for (std::size_t i = 0; i < drive.frames.size(); ++i) {
    const TrackedFrame& frame = drive.frames[i];
    if (frame.status != TrackingStatus::kLost && drive.graph.nodes[static_cast<std::size_t>(frame.reference)].submap == 0) {
      views.push_back({{frame.frame, optimised.T_world_frame[i]}, keyframes.contains(frame.frame)});
    }
  }
  return views;
}

/// Keyframes of the drive that bring no new place are none: before the drive was placed, it had to make them.
void dropKnown(FrontEndResult& drive, const std::vector<View>& earlier, const FusionInput& input, const RevisionConfig& config) {
  std::vector<View> fresh;
  std::vector<std::size_t> nodes;
  for (std::size_t n = static_cast<std::size_t>(drive.graph.settled); n < drive.graph.nodes.size(); ++n) {
    const Node& node = drive.graph.nodes[n];
    if (node.keyframe && node.submap == 0) {
      fresh.push_back({node.frame, node.T_world_camera});
      nodes.push_back(n);
    }
  }
  const std::vector<char> is_known = findKnownViews(earlier, fresh, input, config);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    drive.graph.nodes[nodes[i]].keyframe = is_known[i] == 0;
  }
}

/// A node where there was none, tied to the frame's reference.
int addNode(FrontEndResult& drive, BackEndResult& optimised, std::size_t position) {
  const TrackedFrame& frame = drive.frames[position];
  Node node;
  node.frame = frame.frame;
  node.stamp_ns = frame.stamp_ns;
  node.keyframe = false;
  node.T_world_camera = optimised.T_world_frame[position];
  Edge edge;
  edge.from = frame.reference;
  edge.to = static_cast<int>(drive.graph.nodes.size());
  edge.T_from_to = drive.graph.nodes[static_cast<std::size_t>(frame.reference)].T_world_camera.inverse() * node.T_world_camera;
  geometry::Vector6d information;  // 5 mm, 0.2 degrees
  information << Eigen::Vector3d::Constant(4e4), Eigen::Vector3d::Constant(8e4);
  edge.information = information.asDiagonal();
  drive.graph.nodes.push_back(node);
  drive.graph.edges.push_back(edge);
  drive.features.emplace_back();
  optimised.believed.push_back(1);
  optimised.pose_graph.loop_weight.push_back(1.0);
  return edge.to;
}

void makeKeyframe(FrontEndResult& drive, int id, const camera::RgbdFrame& frame, const camera::PinholeCamera& camera,
                  const FrontEndConfig& config) {
  Node& node = drive.graph.nodes[static_cast<std::size_t>(id)];
  node.keyframe = true;
  if (!node.hosted.empty()) {
    return;  // it was one before, of a place that is known
  }
  for (Landmark& landmark : detectCorners(frame, {}, config.corners)) {
    landmark.host = id;
    node.hosted.push_back(static_cast<int>(drive.graph.landmarks.size()));
    drive.graph.landmarks.push_back(landmark);
  }
  drive.features[static_cast<std::size_t>(id)] = extractFeatures(frame, camera, config.features);
}

}  // namespace

std::unique_ptr<const EarlierMap> openEarlierMap(const recording::Recording& recording, const MapConfig& config, const MapRun& run) {
  if (run.extended.empty()) {
    return nullptr;
  }
  if (config.kind != FrontEndKind::kLandmarks) {
    throw base::Error(base::ErrorCode::kUsage, "kind = pairwise: a map is extended by its landmarks, which this front end has none of");
  }
  auto earlier = std::make_unique<const EarlierMap>(run.extended, SavedMapConfig{config.front_end.pyramid_levels, config.images_in_memory});
  requireSameCamera(earlier->keyframes().camera(), recording.camera(), run.extended / "keyframes.sqlite");
  const auto saved = base::loadConfig<MapConfig>({run.extended / "config.toml", {}});
  if (saved.front_end.features.type != config.front_end.features.type) {
    throw base::Error(base::ErrorCode::kUsage,
                      "the map's features are " + std::string(base::toString(saved.front_end.features.type)) + ", not " +
                          std::string(base::toString(config.front_end.features.type)) + ": places are not recognised by others",
                      (run.extended / "config.toml").string());
  }
  return earlier;
}

bool MapExtension::isPlaced(const FrontEndResult& drive, const BackEndResult& optimised) {
  constexpr int kMinLoops = 2;
  int loops = 0;
  for (std::size_t e = 0; e < drive.graph.edges.size(); ++e) {
    const Edge& edge = drive.graph.edges[e];
    loops += edge.kind == EdgeKind::kLoop && optimised.believed[e] != 0 && edge.from < drive.graph.settled ? 1 : 0;
  }
  return loops >= kMinLoops;
}

void MapExtension::revise(FrontEndResult& drive, BackEndResult& optimised, const Tools& tools) {
  std::vector<View> earlier;
  for (int node = 0; node < drive.graph.settled; ++node) {
    const Node& keyframe = drive.graph.nodes[static_cast<std::size_t>(node)];
    earlier.push_back({keyframe.frame, keyframe.T_world_camera});
  }
  dropKnown(drive, earlier, tools.input, tools.revision);
  const std::vector<DriveView> views = spreadOut(placedFrames(drive, optimised), tools.revision);
  revision_ = mapping::revise(earlier, views, tools.input, tools.occupancy, tools.revision);
  if (tools.explain) {
    explanation_ = tools.explain(revision_.changes.changes, revision_.scans);
  }
  revision_.scans.clear();
  std::map<int, int> node_of_frame;
  for (std::size_t n = 0; n < drive.graph.nodes.size(); ++n) {
    node_of_frame[drive.graph.nodes[n].frame] = static_cast<int>(n);
  }
  for (const int witness : revision_.witnesses) {
    const auto position = static_cast<std::size_t>(
        std::find_if(drive.frames.begin(), drive.frames.end(), [&](const TrackedFrame& f) { return f.frame == witness; }) -
        drive.frames.begin());
    const auto known = node_of_frame.find(witness);
    const int node = known != node_of_frame.end() ? known->second : addNode(drive, optimised, position);
    makeKeyframe(drive, node, tools.input.read(witness, false), tools.input.camera, tools.front_end);
  }
}

std::vector<MovedKeyframe> MapExtension::movedKeyframes(const KeyframeGraph& graph) const {
  std::vector<MovedKeyframe> keyframes;
  for (int n = 0; n < graph.settled; ++n) {
    const Node& before = earlier_.keyframes().graph().nodes[static_cast<std::size_t>(n)];
    keyframes.push_back({before.frame, before.T_world_camera, graph.nodes[static_cast<std::size_t>(n)].T_world_camera});
  }
  std::stable_sort(keyframes.begin(), keyframes.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return keyframes;
}

recording::Trajectory MapExtension::trajectory(const KeyframeGraph& graph) const {
  return carryAlong(earlier_.trajectory(), movedKeyframes(graph));
}

recording::Trajectory MapExtension::baseTrajectory(const recording::Trajectory& T_map_camera) const {
  recording::Trajectory base = earlier_.baseTrajectory();
  std::size_t frame = 0;
  for (recording::StampedPose& pose : base) {
    while (frame < T_map_camera.size() && T_map_camera[frame].stamp_ns != pose.stamp_ns) {
      ++frame;
    }
    if (frame < T_map_camera.size()) {
      const Eigen::Isometry3d T_camera_base = earlier_.trajectory()[frame].T_map_camera.inverse() * pose.T_map_camera;
      pose.T_map_camera = T_map_camera[frame].T_map_camera * T_camera_base;
    }
  }
  return base;
}

double MapExtension::largestMove_m(const KeyframeGraph& graph) const {
  double largest_m = 0.0;
  for (const MovedKeyframe& keyframe : movedKeyframes(graph)) {
    largest_m = std::max(largest_m, (keyframe.T_map_after.translation() - keyframe.T_map_before.translation()).norm());
  }
  return largest_m;
}

}  // namespace oikos::mapping
