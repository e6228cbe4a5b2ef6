// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/revision.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/base/parallel.h"
#include "mapping/change/voxel_ball.h"
#include "mapping/volume/view_batches.h"

namespace oikos::mapping {

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

SeenSpace spaceOf(const std::vector<View>& earlier, const FusionInput& input, const OccupancyConfig& occupancy,
                  const RevisionConfig& config) {
  struct Seen {
    Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
    camera::RgbdFrame frame;
  };
  SeenSpace space(occupancy, config.free, input.threads);
  forEachBatch<Seen>(
      earlier, input, "recalling the map",
      [&](const View& view) {
        return Seen{view.T_a_camera, input.read(view.frame, false)};
      },
      [&](std::vector<Seen>& batch) {
        for (const Seen& seen : batch) {
          space.insert({seen.frame, input.camera, seen.T_map_camera});
        }
      });
  return space;
}

geometry::Matrix6d covarianceOf(const RevisionConfig& config) {
  geometry::Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(config.pose_sigma_m), Eigen::Vector3d::Constant(config.pose_sigma_deg * kRadPerDeg);
  return sigma.cwiseAbs2().asDiagonal();
}

/// Every other pixel of every other row: a fourth of the memory, and enough for voxels.
LocatedScan halvedScan(const cv::Mat& depth_m, const camera::PinholeCamera& camera) {
  LocatedScan scan;
  scan.camera = {camera.width / 2, camera.height / 2, camera.fx / 2.0, camera.fy / 2.0, camera.cx / 2.0, camera.cy / 2.0};
  scan.depth_m = cv::Mat(scan.camera.height, scan.camera.width, CV_32FC1);
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      scan.depth_m.at<float>(v, u) = depth_m.at<float>(2 * v, 2 * u);
    }
  }
  return scan;
}

std::vector<LocatedScan> scansOf(const std::vector<DriveView>& drive, const FusionInput& input, const RevisionConfig& config) {
  const geometry::Matrix6d covariance = covarianceOf(config);
  std::vector<View> views;
  views.reserve(drive.size());
  for (const DriveView& one : drive) {
    views.push_back(one.view);
  }
  std::vector<LocatedScan> scans;
  forEachBatch<LocatedScan>(
      views, input, "comparing with the map",
      [&](const View& view) {
        LocatedScan scan = halvedScan(input.read(view.frame, false).depth_m, input.camera);
        scan.T_map_camera = view.T_a_camera;
        scan.covariance = covariance;
        return scan;
      },
      [&](std::vector<LocatedScan>& batch) { std::move(batch.begin(), batch.end(), std::back_inserter(scans)); });
  return scans;
}

/// A changed voxel and how many keyframes show it.
struct ChangedVoxel {
  Eigen::Vector3d center_map;
  Sight expected;  ///< of who shows the change
  int shown = 0;
};

std::vector<ChangedVoxel> changedVoxels(const std::vector<Change>& changes, const VoxelLattice& lattice) {
  std::vector<ChangedVoxel> voxels;
  for (const Change& change : changes) {
    for (const VoxelKey key : change.voxels) {
      voxels.push_back({lattice.center(key).cast<double>(), change.kind == ChangeKind::kGone ? Sight::kThrough : Sight::kNearSurface});
    }
  }
  return voxels;
}

/// Which changed voxels each scan shows; those that were not compared show none.
std::vector<std::vector<int>> findShown(const std::vector<ChangedVoxel>& voxels, const std::vector<LocatedScan>& scans,
                                        const ChangeResult& changes, const ChangeConfig& config, double voxel_m) {
  constexpr double kAnyShare = 0.5;  // of the tolerance, from which on change_finder takes a voxel to be changed
  std::vector<std::vector<int>> shown(scans.size());
  base::parallelFor(static_cast<int>(scans.size()), config.threads, [&](int i) {
    const auto s = static_cast<std::size_t>(i);
    if (changes.scans[s] != ChangeStatus::kCompared || voxels.empty()) {
      return;
    }
    const ScanView view(scans[s], config, voxel_m);
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      if (view.look(voxels[v].center_map, kAnyShare).sight == voxels[v].expected) {
        shown[s].push_back(static_cast<int>(v));
      }
    }
  });
  return shown;
}

/// Greedy: each time the view that shows most of what is not shown often enough.
std::vector<int> chooseWitnesses(std::vector<ChangedVoxel> voxels, const std::vector<std::vector<int>>& shown,
                                 const std::vector<DriveView>& drive, const RevisionConfig& config) {
  const auto add = [&](std::size_t view) {
    for (const int voxel : shown[view]) {
      ++voxels[static_cast<std::size_t>(voxel)].shown;
    }
  };
  std::vector<char> taken(drive.size(), 0);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    if (drive[i].is_kept) {
      taken[i] = 1;
      add(i);
    }
  }
  std::vector<int> witnesses;
  while (true) {
    std::ptrdiff_t best = 0;
    std::size_t best_view = 0;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      const auto gain = taken[i] != 0 ? 0 : std::count_if(shown[i].begin(), shown[i].end(), [&](int voxel) {
        return voxels[static_cast<std::size_t>(voxel)].shown < config.witnesses;
      });
      if (gain > best) {
        best = gain;
        best_view = i;
      }
    }
    if (best < config.min_gain_voxels) {
      break;
    }
    taken[best_view] = 1;
    add(best_view);
    witnesses.push_back(drive[best_view].view.frame);
  }
  std::sort(witnesses.begin(), witnesses.end());
  return witnesses;
}

std::set<VoxelKey> goneVoxels(const std::vector<Change>& changes) {
  std::set<VoxelKey> voxels;
  for (const Change& change : changes) {
    if (change.kind == ChangeKind::kGone) {
      voxels.insert(change.voxels.begin(), change.voxels.end());
    }
  }
  return voxels;
}

/// Voxels beside these, and not among them, that the map has as occupied, be it ever so faintly.
std::vector<VoxelKey> occupiedBeside(const std::set<VoxelKey>& voxels, const SeenSpace& space) {
  std::set<VoxelKey> beside;
  for (const VoxelKey key : voxels) {
    for (const VoxelStep& step : voxelBall(1.75 * space.lattice().resolutionM(), space.lattice().resolutionM())) {
      const VoxelKey neighbour = stepFrom(key, step.offset);
      const auto log_odds = space.occupancy().findLogOdds(neighbour);
      if (!voxels.contains(neighbour) && log_odds && space.occupancy().isOccupied(*log_odds)) {
        beside.insert(neighbour);
      }
    }
  }
  return {beside.begin(), beside.end()};
}

/// Adds what stands clear by less beside what has surely gone: the foot of a chair is nearer to the floor than errors of map and pose, but
/// a chair has its foot with it.
void addFringe(const SeenSpace& space, const std::vector<ScanView>& views, const ChangeConfig& config, std::set<VoxelKey>& voxels) {
  constexpr int kRings = 2;
  constexpr double kFringeShare = 0.25;  // of the tolerance
  for (int ring = 0; ring < kRings; ++ring) {
    const std::vector<VoxelKey> beside = occupiedBeside(voxels, space);
    std::vector<char> is_gone(beside.size(), 0);
    base::parallelFor(static_cast<int>(beside.size()), config.threads, [&](int i) {
      const auto b = static_cast<std::size_t>(i);
      const Eigen::Vector3d center_map = space.lattice().center(beside[b]).cast<double>();
      int through = 0;
      int seen = 0;
      for (const ScanView& view : views) {
        const Sight sight = view.look(center_map, kFringeShare).sight;
        through += sight == Sight::kThrough ? 1 : 0;
        seen += sight != Sight::kNothing ? 1 : 0;
      }
      is_gone[b] = through > 0 && through >= config.min_agreement * seen ? 1 : 0;
    });
    for (std::size_t b = 0; b < beside.size(); ++b) {
      if (is_gone[b] != 0) {
        voxels.insert(beside[b]);
      }
    }
  }
}

/// Of the scans that were compared and show a change.
std::vector<ScanView> viewsOf(const std::vector<LocatedScan>& scans, const std::vector<std::vector<int>>& shown, const ChangeConfig& config,
                              double voxel_m) {
  std::vector<ScanView> views;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!shown[i].empty()) {
      views.emplace_back(scans[i], config, voxel_m);
    }
  }
  return views;
}

}  // namespace

std::vector<DriveView> spreadOut(const std::vector<DriveView>& drive, const RevisionConfig& config) {
  std::vector<DriveView> chosen;
  std::optional<Eigen::Isometry3d> T_map_last;
  for (const DriveView& next : drive) {
    bool is_far = true;
    if (T_map_last) {
      const Eigen::Isometry3d T_last_next = T_map_last->inverse() * next.view.T_a_camera;
      is_far = T_last_next.translation().norm() >= config.view_step_m ||
               Eigen::AngleAxisd(T_last_next.linear()).angle() >= config.view_step_deg * kRadPerDeg;
    }
    if (is_far || next.is_kept) {
      chosen.push_back(next);
      T_map_last = next.view.T_a_camera;
    }
  }
  return chosen;
}

Revision revise(const std::vector<View>& earlier, const std::vector<DriveView>& drive, const FusionInput& input,
                const OccupancyConfig& occupancy, const RevisionConfig& config) {
  ChangeConfig change = config.change;
  change.threads = input.threads;
  const SeenSpace space = spaceOf(earlier, input, occupancy, config);
  const std::vector<LocatedScan> scans = scansOf(drive, input, config);
  Revision revision;
  revision.changes = findChanges(space, scans, change);
  const double voxel_m = space.lattice().resolutionM();
  const std::vector<ChangedVoxel> voxels = changedVoxels(revision.changes.changes, space.lattice());
  const std::vector<std::vector<int>> shown = findShown(voxels, scans, revision.changes, change, voxel_m);
  revision.witnesses = chooseWitnesses(voxels, shown, drive, config);
  std::set<VoxelKey> gone = goneVoxels(revision.changes.changes);
  addFringe(space, viewsOf(scans, shown, change, voxel_m), change, gone);
  revision.scans = scans;
  revision.gone = GoneSpace(voxel_m, {gone.begin(), gone.end()});
  return revision;
}

}  // namespace oikos::mapping
