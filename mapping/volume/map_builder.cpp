// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/map_builder.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/geometry/ply.h"
#include "mapping/volume/depth_scan.h"
#include "mapping/volume/mesh_extraction.h"
#include "mapping/volume/octomap_files.h"

namespace oikos::mapping {

namespace {

/// Reads views a few at a time, as many as there are threads, and hands them on in order.
void forEachView(const std::vector<View>& views, bool color, const FusionInput& input,
                 const std::function<void(const View&, camera::RgbdFrame&)>& visit) {
  const int batch = std::max(1, input.threads);
  for (int begin = 0; begin < static_cast<int>(views.size()); begin += batch) {
    const int count = std::min(batch, static_cast<int>(views.size()) - begin);
    std::vector<camera::RgbdFrame> frames(static_cast<std::size_t>(count));
    base::parallelFor(count, input.threads, [&](int i) {
      frames[static_cast<std::size_t>(i)] = input.read(views[static_cast<std::size_t>(begin + i)].frame, color);
    });
    for (int i = 0; i < count; ++i) {
      visit(views[static_cast<std::size_t>(begin + i)], frames[static_cast<std::size_t>(i)]);
    }
    if (color && input.progress) {
      input.progress(begin + count, static_cast<int>(views.size()));
    }
  }
}

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
  FloorFinder finder(config.floor);
  forEachView(spread(views_world, config.floor_views), false, input, [&](const View& view, camera::RgbdFrame& frame) {
    finder.add(filterDepth(frame.depth_m, config.surface), input.camera, view.T_a_camera);
  });
  return finder.find();
}

FusedMap fuseMap(const std::vector<View>& views_map, bool floor_known, const FusionInput& input, const VolumeConfig& config,
                 const std::function<void(const camera::RgbdFrame&)>& also, const std::filesystem::path& folder) {
  FusedMap fused;
  geometry::ColoredMesh mesh;
  {
    OccupancyIntegrator occupancy(config.occupancy, input.threads);
    VoxelCloud cloud(config.cloud);
    TsdfVolume distances(config.mesh, input.threads);
    forEachView(views_map, true, input, [&](const View& view, camera::RgbdFrame& frame) {
      also(frame);
      const PosedFrame posed{frame, input.camera, view.T_a_camera};
      occupancy.insert(makeScan(posed, config.occupancy));
      frame.depth_m = filterDepth(frame.depth_m, config.surface);
      cloud.add(posed);
      distances.integrate(posed);
    });
    writeOctomap(occupancy, folder);
    countVoxels(occupancy, fused);
    fused.grid = projectOccupancy(occupancy, config.grid);
    cloud.write(folder / "cloud.ply");
    measureCloud(cloud, fused);
    mesh = extractMesh(distances, input.threads);
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
