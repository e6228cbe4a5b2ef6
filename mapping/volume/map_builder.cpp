// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/map_builder.h"

#include <algorithm>
#include <array>

#include "core/base/parallel.h"
#include "core/geometry/ply.h"
#include "mapping/volume/depth_scan.h"
#include "mapping/volume/mesh_extraction.h"
#include "mapping/volume/octomap_files.h"
#include "mapping/volume/view_batches.h"

namespace oikos::mapping {

namespace {

/// A frame with what was made of it on some thread.
struct PreparedView {
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  camera::RgbdFrame frame;    ///< depth as read
  camera::RgbdFrame surface;  ///< the same with the depth that is good enough for surfaces
};

/// At most `most` views, evenly spread.
std::vector<View> spread(const std::vector<View>& views, int most) {
  const int count = static_cast<int>(views.size());
  if (count <= most) {
    return views;
  }
  std::vector<View> chosen;
  for (int i = 0; i < most; ++i) {
    chosen.push_back(views[static_cast<std::size_t>(i * static_cast<std::int64_t>(count) / most)]);
  }
  return chosen;
}

void countVoxels(const OccupancyIntegrator& occupancy, FusedMap& fused) {
  occupancy.forEachVoxel([&](VoxelKey, float log_odds) { ++(occupancy.isOccupied(log_odds) ? fused.voxels_occupied : fused.voxels_free); });
}

void measureCloud(const VoxelCloud& cloud, FusedMap& fused) {
  fused.cloud_points = static_cast<std::int64_t>(cloud.pointCount());
  bool first = true;
  cloud.forEachPoint([&](const Eigen::Vector3f& point_map, const geometry::Rgb&) {
    const Eigen::Vector3d p = point_map.cast<double>();
    fused.box_min_map = first ? p : fused.box_min_map.cwiseMin(p);
    fused.box_max_map = first ? p : fused.box_max_map.cwiseMax(p);
    first = false;
  });
}

}  // namespace

FloorResult findFloor(const std::vector<View>& views_world, const FusionInput& input, const VolumeConfig& config) {
  struct DepthView {
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    cv::Mat depth_m;
  };
  FloorFinder finder(config.floor);
  FusionInput quiet = input;
  quiet.progress = {};
  forEachBatch<DepthView>(
      spread(views_world, config.floor_views), quiet, "",
      [&](const View& view) {
        return DepthView{view.T_a_camera, filterDepth(input.read(view.frame, false).depth_m, config.surface)};
      },
      [&](std::vector<DepthView>& batch) {
        for (const DepthView& view : batch) {
          finder.add(view.depth_m, input.camera, view.T_world_camera);
        }
      });
  return finder.find();
}

FusedMap fuseMap(const std::vector<View>& views_map, bool floor_known, const FusionInput& input, const VolumeConfig& config,
                 const ViewObserver& observer, const std::filesystem::path& folder) {
  FusedMap fused;
  geometry::ColoredMesh mesh;
  {
    // Each product goes through the views in order on a thread of its own.
    OccupancyIntegrator occupancy(config.occupancy, 1);
    VoxelCloud cloud(config.cloud);
    TsdfVolume distances(config.mesh, 1);
    forEachBatch<PreparedView>(
        views_map, input, "fusing the map",
        [&](const View& view) {
          PreparedView prepared{view.T_a_camera, input.read(view.frame, true), {}};
          prepared.surface = prepared.frame;
          prepared.surface.depth_m = filterDepth(prepared.frame.depth_m, config.surface);
          observer.prepare(prepared.frame);
          return prepared;
        },
        [&](std::vector<PreparedView>& batch) {
          const std::array<std::function<void(const PreparedView&)>, 4> products = {
              [&](const PreparedView& v) {
                distances.integrate({v.surface, input.camera, v.T_map_camera});
              },
              [&](const PreparedView& v) {
                occupancy.insert(makeScan({v.frame, input.camera, v.T_map_camera}, config.occupancy));
              },
              [&](const PreparedView& v) {
                cloud.add({v.surface, input.camera, v.T_map_camera});
              },
              [&](const PreparedView& v) { observer.inOrder(v.frame); }};
          base::parallelFor(static_cast<int>(products.size()), input.threads,
                            [&](int product) { std::for_each(batch.begin(), batch.end(), products[static_cast<std::size_t>(product)]); });
        });
    const std::array<std::function<void()>, 3> results = {[&] { mesh = extractMesh(distances, 1); },
                                                          [&] {
                                                            writeOctomap(occupancy, folder);
                                                            countVoxels(occupancy, fused);
                                                            fused.grid = projectOccupancy(occupancy, config.grid);
                                                          },
                                                          [&] {
                                                            cloud.write(folder / "cloud.ply");
                                                            measureCloud(cloud, fused);
                                                          }};
    base::parallelFor(static_cast<int>(results.size()), input.threads, [&](int i) { results[static_cast<std::size_t>(i)](); });
  }
  if (!floor_known) {
    fused.grid = withAllUnknown(std::move(fused.grid));
  }
  writeGrid(fused.grid, folder);
  removeSpecks(config.min_piece_triangles, mesh);
  geometry::writePly(mesh, folder / "mesh.ply");
  fused.mesh_triangles = static_cast<std::int64_t>(mesh.triangles.size());
  return fused;
}

}  // namespace oikos::mapping
