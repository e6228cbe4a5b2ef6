// SPDX-License-Identifier: Apache-2.0
// Occupancy integration against OctoMap's own insertPointCloud(…, discretize) on the same clouds, one after the other in one run,
// and whether both maps are the same, node for node and bit for bit.
//   occupancy_bench [RESOLUTION_M [EVERY_NTH_FRAME [PIXEL_STRIDE]]]
// The clouds are the real kitchen's with its reference poses (OIKOS_DATA/kitchen), else a simulated room's.
#include <octomap/OcTree.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/recording/trajectory.h"
#include "mapping/volume/depth_scan.h"
#include "mapping/volume/occupancy_integrator.h"
#include "mapping/volume/octomap_tree.h"
#include "tests/support/analytic_room.h"

namespace {

using namespace oikos;

std::vector<mapping::OccupancyScan> kitchenScans(const std::string& folder, int every_nth, const mapping::OccupancyConfig& config) {
  const auto recorded = recording::openRecording(folder);
  const auto trajectory = recording::readTrajectory(folder + "/groundtruth_sfm.txt");
  std::vector<mapping::OccupancyScan> scans;
  for (int i = 0; i < recorded->frameCount(); i += every_nth) {
    for (const auto& pose : trajectory) {
      if (std::abs(pose.stamp_ns - recorded->stampNs(i)) < 1'000'000) {
        const camera::RgbdFrame frame = recorded->read(i, recording::Channels::kGray);
        scans.push_back(mapping::makeScan({frame, recorded->camera(), pose.T_map_camera}, config));
        break;
      }
    }
  }
  return scans;
}

std::vector<mapping::OccupancyScan> roomScans(const mapping::OccupancyConfig& config) {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  const camera::PinholeCamera camera{640, 480, 525.0, 525.0, 319.5, 239.5};
  std::vector<mapping::OccupancyScan> scans;
  for (const Eigen::Isometry3d& T_map_camera : test::lookAround(20, 0.3, 1.3, 0.4)) {
    const camera::RgbdFrame frame = room.render(camera, T_map_camera);
    scans.push_back(mapping::makeScan({frame, camera, T_map_camera}, config));
  }
  return scans;
}

double elapsedS(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string bytes(const octomap::OcTree& tree) {
  std::ostringstream stream;
  tree.write(stream);
  return std::move(stream).str();
}

octomap::Pointcloud toOctomap(const mapping::OccupancyScan& scan) {
  octomap::Pointcloud cloud;
  cloud.reserve(scan.points_map.size());
  for (const Eigen::Vector3f& point : scan.points_map) {
    cloud.push_back(point.x(), point.y(), point.z());
  }
  return cloud;
}

/// Returns whether all maps are the same.
bool compare(const std::vector<mapping::OccupancyScan>& scans, const mapping::OccupancyConfig& config) {
  octomap::OcTree theirs(config.resolution_m);
  double octomap_s = 0.0;
  for (const auto& scan : scans) {
    const octomap::Pointcloud cloud = toOctomap(scan);
    const octomap::point3d origin(scan.origin_map.x(), scan.origin_map.y(), scan.origin_map.z());
    octomap_s += elapsedS([&] { theirs.insertPointCloud(cloud, origin, config.max_range_m, false, true); });
  }
  const double per_scan_ms = 1000.0 / static_cast<double>(scans.size());
  const std::string expected = bytes(theirs);
  std::printf("%-34s %10s %12s %8s  %s\n", "", "ms a scan", "tree, ms", "faster", "same map");
  std::printf("%-34s %10.1f %12s %8.1f  %s\n", "OctoMap insertPointCloud", octomap_s * per_scan_ms, "-", 1.0, "-");
  bool all_same = true;
  for (const int threads : {1, 2}) {
    mapping::OccupancyIntegrator ours(config, threads);
    const double insert_s = elapsedS([&] {
      for (const auto& scan : scans) {
        ours.insert(scan);
      }
    });
    std::unique_ptr<octomap::OcTree> tree;
    const double tree_s = elapsedS([&] { tree = mapping::makeOctomapTree(ours); });
    const bool same = *tree == theirs && bytes(*tree) == expected;
    all_same = all_same && same;
    std::printf("bricks, octree at the end, %d thread%s %10.1f %12.1f %8.1f  %s\n", threads, threads == 1 ? " " : "s",
                insert_s * per_scan_ms, tree_s * 1000.0, octomap_s / (insert_s + tree_s), same ? "yes" : "NO");
    std::printf("  bricks hold %.1f MB, the octree %.1f MB\n", static_cast<double>(ours.memoryBytes()) / 1e6,
                static_cast<double>(tree->memoryUsage()) / 1e6);
  }
  return all_same;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    mapping::OccupancyConfig config;
    config.resolution_m = argc > 1 ? std::stod(argv[1]) : 0.02;
    const int every_nth = argc > 2 ? std::stoi(argv[2]) : 20;
    config.pixel_stride = argc > 3 ? std::stoi(argv[3]) : 1;
    const char* data = std::getenv("OIKOS_DATA");
    const std::string folder = data != nullptr ? std::string(data) + "/kitchen" : std::string();
    const bool real = !folder.empty() && std::filesystem::exists(folder);
    const auto scans = real ? kitchenScans(folder, every_nth, config) : roomScans(config);
    std::printf("%s: %zu scans, %.2f m voxels, range %.1f m, pixel stride %d\n", real ? "kitchen" : "simulated room", scans.size(),
                config.resolution_m, config.max_range_m, config.pixel_stride);
    return compare(scans, config) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "occupancy_bench: %s\n", error.what());
    return 1;
  }
}
