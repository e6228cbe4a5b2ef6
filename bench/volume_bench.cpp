// SPDX-License-Identifier: Apache-2.0
// Every product of mapping/volume from a recording with given poses: what each one costs a keyframe, and holds in memory.
//   volume_bench [RECORDING TRAJECTORY OUT_FOLDER [EVERY_NTH_FRAME [THREADS]]]
// Without arguments: OIKOS_DATA/kitchen with its reference poses, into a temporary folder.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/ply.h"
#include "core/recording/recording.h"
#include "core/recording/trajectory.h"
#include "mapping/volume/depth_filter.h"
#include "mapping/volume/depth_scan.h"
#include "mapping/volume/floor_finder.h"
#include "mapping/volume/mesh_extraction.h"
#include "mapping/volume/occupancy_grid.h"
#include "mapping/volume/octomap_files.h"
#include "mapping/volume/tsdf_volume.h"
#include "mapping/volume/voxel_cloud.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;

struct Keyframe {
  int index;
  Eigen::Isometry3d T_world_camera;
};

class Stopwatch {
 public:
  void run(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  void print(const char* what, double count, double bytes) const {
    std::printf("%-28s %8.2f ms", what, 1000.0 * seconds_ / count);
    std::printf(bytes > 0.0 ? " %8.1f MB\n" : "\n", bytes / 1e6);
  }

 private:
  double seconds_ = 0.0;
};

std::vector<Keyframe> pickKeyframes(const recording::Recording& recorded, const recording::Trajectory& trajectory, int every_nth) {
  std::vector<Keyframe> keyframes;
  for (int i = 0; i < recorded.frameCount(); i += every_nth) {
    const auto nearest = std::min_element(trajectory.begin(), trajectory.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.stamp_ns - recorded.stampNs(i)) < std::abs(b.stamp_ns - recorded.stampNs(i));
    });
    if (nearest != trajectory.end() && std::abs(nearest->stamp_ns - recorded.stampNs(i)) < 20'000'000) {
      keyframes.push_back({i, nearest->T_map_camera});
    }
  }
  return keyframes;
}

mapping::FloorResult findFloor(const recording::Recording& recorded, const std::vector<Keyframe>& keyframes) {
  mapping::FloorFinder finder{mapping::FloorConfig{}};
  Stopwatch add;
  for (const Keyframe& keyframe : keyframes) {
    const cv::Mat depth_m = mapping::filterDepth(recorded.read(keyframe.index, recording::Channels::kGray).depth_m, {});
    add.run([&] { finder.add(depth_m, recorded.camera(), keyframe.T_world_camera); });
  }
  mapping::FloorResult floor;
  Stopwatch find;
  find.run([&] { floor = finder.find(); });
  add.print("floor, a keyframe", static_cast<double>(keyframes.size()), 0.0);
  find.print("floor, at the end", 1.0, 0.0);
  const Eigen::Vector3d down_world = -floor.T_map_world.linear().row(2).transpose();
  std::printf(
      "floor: %s, %.2f m2, %d elements, rms %.1f mm, tilt to image-up %.1f deg, agreement %.2f, camera at %.2f m, down (%.4f %.4f %.4f)\n",
      floor.status == mapping::FloorStatus::kFound ? "found" : "none", floor.area_m2, floor.inliers, 1000.0 * floor.rms_m,
      floor.tilt_rad * 57.29578, floor.agreement, floor.camera_height_m, down_world.x(), down_world.y(), down_world.z());
  return floor;
}

void run(const std::vector<std::string>& arguments) {
  const auto recorded = recording::openRecording(arguments[0]);
  const std::filesystem::path out = arguments[2];
  const int threads = arguments.size() > 4 ? std::stoi(arguments[4]) : 1;
  const auto keyframes =
      pickKeyframes(*recorded, recording::readTrajectory(arguments[1]), arguments.size() > 3 ? std::stoi(arguments[3]) : 10);
  std::printf("%s: %zu keyframes, %d threads\n", arguments[0].c_str(), keyframes.size(), threads);
  const auto count = static_cast<double>(keyframes.size());
  const mapping::FloorResult floor = findFloor(*recorded, keyframes);

  mapping::OccupancyIntegrator occupancy(mapping::OccupancyConfig{}, threads);
  mapping::VoxelCloud cloud{mapping::VoxelCloudConfig{}};
  mapping::TsdfVolume volume(mapping::TsdfConfig{}, threads);
  Stopwatch filter_time, occupancy_time, cloud_time, mesh_time;
  for (const Keyframe& keyframe : keyframes) {
    camera::RgbdFrame frame = recorded->read(keyframe.index, recording::Channels::kColor);
    const Eigen::Isometry3d T_map_camera = floor.T_map_world * keyframe.T_world_camera;
    const mapping::PosedFrame posed{frame, recorded->camera(), T_map_camera};
    occupancy_time.run([&] { occupancy.insert(mapping::makeScan(posed, occupancy.config())); });
    filter_time.run([&] { frame.depth_m = mapping::filterDepth(frame.depth_m, {}); });
    cloud_time.run([&] { cloud.add(posed); });
    mesh_time.run([&] { volume.integrate(posed); });
  }
  filter_time.print("depth filter, a keyframe", count, 0.0);
  occupancy_time.print("occupancy, a keyframe", count, static_cast<double>(occupancy.memoryBytes()));
  cloud_time.print("cloud, a keyframe", count, static_cast<double>(cloud.memoryBytes()));
  mesh_time.print("TSDF, a keyframe", count, static_cast<double>(volume.memoryBytes()));

  std::filesystem::create_directories(out);
  Stopwatch octomap_write, grid_write, cloud_write, extract, mesh_write;
  octomap_write.run([&] { mapping::writeOctomap(occupancy, out); });
  grid_write.run([&] { mapping::writeGrid(mapping::projectOccupancy(occupancy, mapping::OccupancyGridConfig{}), out); });
  cloud_write.run([&] { cloud.write(out / "cloud.ply"); });
  geometry::ColoredMesh mesh;
  extract.run([&] {
    mesh = mapping::extractMesh(volume, threads);
    mapping::removeSpecks(100, mesh);
  });
  mesh_write.run([&] { geometry::writePly(mesh, out / "mesh.ply"); });
  octomap_write.print("octomap.bt, octomap.ot", 1.0, 0.0);
  grid_write.print("grid", 1.0, 0.0);
  cloud_write.print("cloud.ply", 1.0, 0.0);
  extract.print("mesh", 1.0, 0.0);
  mesh_write.print("mesh.ply", 1.0, 0.0);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%zu points, %zu vertices, %zu triangles; peak memory of the process %.0f MB\n", cloud.pointCount(),
              mesh.vertices.points.size(), mesh.triangles.size(), static_cast<double>(usage.ru_maxrss) / 1000.0);
}

void runOnKitchen() {
  const char* const data = std::getenv("OIKOS_DATA");
  const std::string kitchen = data != nullptr ? std::string(data) + "/kitchen" : "";
  if (!std::filesystem::is_directory(kitchen)) {
    std::printf("SKIPPED: volume_bench needs a recording with poses, or OIKOS_DATA with kitchen in it\n");
    return;
  }
  const test::TemporaryFolder out;
  run({kitchen, kitchen + "/groundtruth_sfm.txt", out.path().string(), "8"});
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 1) {
      runOnKitchen();
      return 0;
    }
    if (argc < 4) {
      std::fprintf(stderr, "volume_bench [RECORDING TRAJECTORY OUT_FOLDER [EVERY_NTH_FRAME [THREADS]]]\n");
      return 2;
    }
    run({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "volume_bench: %s\n", error.what());
    return 1;
  }
}
