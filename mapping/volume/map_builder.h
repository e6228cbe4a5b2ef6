// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "mapping/volume/depth_filter.h"
#include "mapping/volume/floor_finder.h"
#include "mapping/volume/occupancy_config.h"
#include "mapping/volume/occupancy_grid.h"
#include "mapping/volume/occupancy_integrator.h"
#include "mapping/volume/tsdf_volume.h"
#include "mapping/volume/voxel_cloud.h"

namespace oikos::mapping {

struct VolumeConfig {
  bool every_frame = false;  ///< fuse every frame, not the keyframes only
  OccupancyConfig occupancy;
  DepthFilterConfig surface;
  VoxelCloudConfig cloud;
  TsdfConfig mesh;
  int min_piece_triangles = 100;  ///< smaller connected pieces of the mesh are specks
  OccupancyGridConfig grid;
  FloorConfig floor;
  int floor_views = 40;  ///< keyframes that the floor is looked for in, spread over the drive

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("every_frame", every_frame);
    visitor("occupancy", occupancy);
    visitor("surface", surface);
    visitor("cloud", cloud);
    visitor("mesh", mesh);
    visitor("min_piece_triangles", min_piece_triangles);
    visitor("grid", grid);
    visitor("floor", floor);
    visitor("floor_views", floor_views);
  }
};

/// A view to fuse: which frame, and from where it was taken.
struct View {
  int frame = -1;
  Eigen::Isometry3d T_a_camera = Eigen::Isometry3d::Identity();  ///< a: the world of the graph for the floor, map for fusion
};

/// What came of the fusion, for the report.
struct FusedMap {
  OccupancyGrid grid;
  std::int64_t voxels_occupied = 0;
  std::int64_t voxels_free = 0;
  std::int64_t cloud_points = 0;
  std::int64_t mesh_triangles = 0;
  Eigen::Vector3d box_min_map = Eigen::Vector3d::Zero();  ///< of the cloud
  Eigen::Vector3d box_max_map = Eigen::Vector3d::Zero();
};

struct FusionInput {
  const camera::PinholeCamera& camera;
  std::function<camera::RgbdFrame(int frame, bool color)> read;  ///< thread-safe; a frame that tracking has read before
  int threads = 1;
  base::ProgressSink progress;
};

/// Is shown each view's colour frame: `prepare` on any thread, then `inOrder` one after the other.
struct ViewObserver {
  std::function<void(const camera::RgbdFrame&)> prepare;
  std::function<void(const camera::RgbdFrame&)> inOrder;
};

[[nodiscard]] FloorResult findFloor(const std::vector<View>& views_world, const FusionInput& input, const VolumeConfig& config);

/// Fuses the views in their order and writes octomap.bt, octomap.ot, cloud.ply, mesh.ply, grid.pgm and grid.yaml into `folder`.
/// `floor_known`: false makes every cell of the grid unknown.
FusedMap fuseMap(const std::vector<View>& views_map, bool floor_known, const FusionInput& input, const VolumeConfig& config,
                 const ViewObserver& observer, const std::filesystem::path& folder);

}  // namespace oikos::mapping
