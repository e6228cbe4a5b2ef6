// SPDX-License-Identifier: Apache-2.0
#include "mapping/relocalise/local_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>

namespace oikos::mapping {

namespace {

constexpr double kNear_m = 0.1;
constexpr double kBorder_px = 8.0;
constexpr double kHidden = 1.15;     ///< farther than the reading by this factor: something stands in front
constexpr std::size_t kSampled = 4;  ///< every fourth landmark tells whether a keyframe is worth its others

/// Whether a camera at T_map_camera sees landmarks, as far as one can tell beforehand.
class Visibility {
 public:
  Visibility(const SavedMap& map, const Eigen::Isometry3d& T_map_camera, const cv::Mat& depth_m, double max_view_deg)
      : map_(map),
        T_camera_map_(T_map_camera.inverse()),
        depth_m_(depth_m),
        min_view_cos_(std::cos(max_view_deg * 3.14159265358979 / 180.0)) {}

  void look(int node) { T_camera_host_ = T_camera_map_ * map_.graph().nodes[static_cast<std::size_t>(node)].T_world_camera; }
  /// Of the node that was looked at last.
  [[nodiscard]] bool sees(int landmark) const {
    const Eigen::Vector3d point_host = pointInHost(map_.graph().landmarks[static_cast<std::size_t>(landmark)], map_.camera());
    const Eigen::Vector3d ray = T_camera_host_.linear() * point_host;
    const Eigen::Vector3d p = ray + T_camera_host_.translation();
    if (p.z() < kNear_m || p.dot(ray) < min_view_cos_ * p.norm() * ray.norm()) {
      return false;
    }
    const Eigen::Vector2d px = map_.camera().project(p);
    if (!map_.camera().contains(px, kBorder_px)) {
      return false;
    }
    const auto reading_m =
        static_cast<double>(depth_m_.at<float>(static_cast<int>(std::lround(px.y())), static_cast<int>(std::lround(px.x()))));
    return !(p.z() > kHidden * reading_m);  // no reading hides nothing
  }

 private:
  const SavedMap& map_;
  Eigen::Isometry3d T_camera_map_;
  const cv::Mat& depth_m_;
  double min_view_cos_;
  Eigen::Isometry3d T_camera_host_ = Eigen::Isometry3d::Identity();
};

/// The nodes with most landmarks in view, the best first.
std::vector<int> bestHosts(const SavedMap& map, Visibility& visibility, int most) {
  std::vector<std::pair<int, int>> hosts;  // sampled landmarks in view, node
  for (int node = 0; node < map.keyframeCount(); ++node) {
    const std::vector<int>& hosted = map.graph().nodes[static_cast<std::size_t>(node)].hosted;
    visibility.look(node);
    int seen = 0;
    for (std::size_t i = 0; i < hosted.size(); i += kSampled) {
      seen += visibility.sees(hosted[i]) ? 1 : 0;
    }
    if (seen > 0) {
      hosts.emplace_back(seen, node);
    }
  }
  std::stable_sort(hosts.begin(), hosts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  hosts.resize(std::min(hosts.size(), static_cast<std::size_t>(most)));
  std::vector<int> nodes;
  for (const auto& [seen, node] : hosts) {
    nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

std::vector<int> landmarksInView(const SavedMap& map, const Eigen::Isometry3d& T_map_camera, const cv::Mat& depth_m,
                                 const RelocaliseConfig& config) {
  Visibility visibility(map, T_map_camera, depth_m, config.max_view_deg);
  std::vector<int> seen;
  for (const int node : bestHosts(map, visibility, config.local_keyframes)) {
    visibility.look(node);
    for (const int landmark : map.graph().nodes[static_cast<std::size_t>(node)].hosted) {
      if (visibility.sees(landmark)) {
        seen.push_back(landmark);
      }
    }
  }
  const auto most = static_cast<std::size_t>(config.most_landmarks);
  std::vector<int> kept;
  for (std::size_t i = 0; i < std::min(most, seen.size()); ++i) {
    kept.push_back(seen[i * seen.size() / std::min(most, seen.size())]);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

FollowResult followInMap(const SavedMap& map, const LocatedFrame& located, const std::vector<int>& landmarks,
                         const Eigen::Isometry3d& T_map_camera, const RelocaliseConfig& config) {
  std::map<int, std::shared_ptr<const ImagePyramid>> hosts;
  std::vector<Candidate> candidates;
  candidates.reserve(landmarks.size());
  for (const int id : landmarks) {
    const Landmark& landmark = map.graph().landmarks[static_cast<std::size_t>(id)];
    auto& pyramid = hosts[landmark.host];
    if (!pyramid) {
      pyramid = map.pyramid(landmark.host);
    }
    candidates.push_back({id, &landmark, map.graph().nodes[static_cast<std::size_t>(landmark.host)].T_world_camera, pyramid.get()});
  }
  return followLandmarks({&map.camera(), &located.pyramid, &located.frame.depth_m}, candidates, T_map_camera, config.follower);
}

}  // namespace oikos::mapping
