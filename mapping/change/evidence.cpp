// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/evidence.h"

#include "mapping/volume/pixel_rays.h"

namespace oikos::mapping {

namespace {

/// Part of the tolerance from which on a voxel belongs to a change beside it that stands clear in full.
constexpr double kWeakShare = 0.5;

/// Distance between the voxel and the nearest one that is not free; the ball's radius if there is none.
double findClearance_m(const SeenSpace& space, VoxelKey key, const std::vector<VoxelStep>& ball) {
  for (const VoxelStep& step : ball) {
    if (space.state(stepFrom(key, step.offset)) != SpaceState::kFree) {
      return step.length_m;
    }
  }
  return ball.back().length_m;
}

void compareSurface(const ScanView& view, const std::vector<SurfaceVoxel>& surface, const Reference& reference, ScanEvidence& evidence) {
  for (const SurfaceVoxel& voxel : surface) {
    const auto tolerance_m = view.findTolerance_m(voxel.point_camera);
    if (!tolerance_m) {
      continue;
    }
    ++evidence.surface;
    evidence.surface_known += reference.space.state(voxel.key) != SpaceState::kUnknown ? 1 : 0;
    const double clear_m = findClearance_m(reference.space, voxel.key, reference.ball);
    const bool is_seed = clear_m >= *tolerance_m;
    evidence.surface_fresh += is_seed ? 1 : 0;
    if (clear_m >= kWeakShare * *tolerance_m) {
      const Eigen::Vector3d point_map = view.scan().T_map_camera * voxel.point_camera;
      evidence.fresh[voxel.key] = {point_map, is_seed, clear_m / view.sigma_m(voxel.point_camera), 1, 0};
    }
  }
}

void compareMap(const ScanView& view, const Reference& reference, ScanEvidence& evidence) {
  for (const VoxelKey key : reference.occupied) {
    const Eigen::Vector3d center_map = reference.space.lattice().center(key).cast<double>();
    const Sighting full = view.look(center_map, 1.0);
    const bool is_gone = full.sight == Sight::kThrough;
    evidence.map_gone += is_gone ? 1 : 0;
    evidence.map_seen += full.sight != Sight::kNothing ? 1 : 0;
    const Sighting weak = is_gone ? full : view.look(center_map, kWeakShare);
    if (weak.sight == Sight::kThrough) {
      evidence.gone[key] = {center_map, is_gone, weak.clear_sigmas, 1, 0};
    } else if (weak.sight == Sight::kNearSurface) {
      evidence.gone[key] = {center_map, false, 0.0, 0, 1};
    }
  }
}

}  // namespace

std::vector<SurfaceVoxel> findSurface(const LocatedScan& scan, const ChangeConfig& config, const VoxelLattice& lattice) {
  struct Sum {
    Eigen::Vector3d points_camera = Eigen::Vector3d::Zero();
    int count = 0;
  };
  const cv::Mat depth_m = filterDepth(scan.depth_m, config.surface);
  const PixelRays rays(scan.camera);
  std::map<VoxelKey, Sum> sums;
  for (int v = 0; v < depth_m.rows; v += config.pixel_stride) {
    for (int u = 0; u < depth_m.cols; u += config.pixel_stride) {
      const float z = depth_m.ptr<float>(v)[u];
      if (!(z > 0.0F)) {
        continue;
      }
      const Eigen::Vector3d point_camera = rays.point(u, v, z).cast<double>();
      if (const auto key = lattice.findKey((scan.T_map_camera * point_camera).cast<float>())) {
        Sum& sum = sums[*key];
        sum.points_camera += point_camera;
        ++sum.count;
      }
    }
  }
  std::vector<SurfaceVoxel> surface;
  for (const auto& [key, sum] : sums) {
    if (sum.count >= config.min_points) {
      surface.push_back({key, sum.points_camera / sum.count});
    }
  }
  return surface;
}

ScanEvidence compareScan(const ScanView& view, const std::vector<SurfaceVoxel>& surface, const Reference& reference) {
  ScanEvidence evidence;
  compareSurface(view, surface, reference, evidence);
  compareMap(view, reference, evidence);
  return evidence;
}

}  // namespace oikos::mapping
