// SPDX-License-Identifier: Apache-2.0
#include "mapping/graph/local_map.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "core/base/error.h"

namespace oikos::mapping {

std::vector<int> neighbourhood(const KeyframeGraph& graph, int node, int rings) {
  std::set<int> found{node};
  for (int ring = 0; ring < rings; ++ring) {
    std::set<int> wider = found;
    for (const Edge& e : graph.edges) {
      if (e.kind == EdgeKind::kOdometry && found.contains(e.from)) {
        wider.insert(e.to);
      }
      if (e.kind == EdgeKind::kOdometry && found.contains(e.to)) {
        wider.insert(e.from);
      }
    }
    found = std::move(wider);
  }
  return {found.begin(), found.end()};
}

std::vector<int> localMap(const KeyframeGraph& graph, const std::vector<int>& nodes, const CameraView& view, int most_hosts) {
  std::vector<std::pair<int, int>> hosts;  // landmarks in view, node
  for (const int node : nodes) {
    const int in_view = countInView(graph, node, view.T_world_camera, view.camera);
    if (in_view > 0) {
      hosts.emplace_back(in_view, node);
    }
  }
  std::stable_sort(hosts.begin(), hosts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  hosts.resize(std::min(hosts.size(), static_cast<std::size_t>(most_hosts)));
  std::vector<int> landmarks;
  for (const auto& [in_view, node] : hosts) {
    const auto& hosted = graph.nodes[static_cast<std::size_t>(node)].hosted;
    landmarks.insert(landmarks.end(), hosted.begin(), hosted.end());
  }
  std::sort(landmarks.begin(), landmarks.end());
  return landmarks;
}

int countUnknown(const KeyframeGraph& graph, const std::vector<int>& active, const std::vector<int>& landmarks, const CameraView& view) {
  const std::set<int> known(active.begin(), active.end());
  return static_cast<int>(std::count_if(landmarks.begin(), landmarks.end(), [&](int id) {
    return !known.contains(id) && isInView(graph, id, view.T_world_camera, view.camera);
  }));
}

int mainHost(const KeyframeGraph& graph, const std::vector<Observation>& observations) {
  std::map<int, int> count;
  for (const Observation& o : observations) {
    ++count[graph.landmarks[static_cast<std::size_t>(o.landmark)].host];
  }
  OIKOS_CHECK(!count.empty());
  return std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
}

}  // namespace oikos::mapping
