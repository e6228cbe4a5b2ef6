// SPDX-License-Identifier: Apache-2.0
#include "mapping/odometry/landmark_follower.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace oikos::mapping {

namespace {

/// Point in the world of the host's pixel (u, v), on the landmark's plane.
Eigen::Vector3d pointOnPatch(const Candidate& c, const camera::PinholeCamera& camera, const Eigen::Vector2d& offset_px) {
  const double inverse_depth = c.value->inverse_depth + c.value->inverse_depth_gradient.dot(offset_px);
  const Eigen::Vector2d px = c.value->pixel + offset_px;
  return c.T_world_host * (camera.ray(px.x(), px.y()) / inverse_depth);
}

/// Where the patch should be seen and how it is distorted there; nothing if it is out of view.
std::optional<PatchQuery> predict(const Candidate& c, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_camera_world,
                                  const FollowerConfig& config) {
  constexpr double kStep_px = 3.0;
  std::array<Eigen::Vector2d, 3> px;
  const std::array<Eigen::Vector2d, 3> offsets{Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(kStep_px, 0.0), Eigen::Vector2d(0.0, kStep_px)};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const Eigen::Vector3d p = T_camera_world * pointOnPatch(c, camera, offsets[i]);
    if (p.z() < 0.1) {
      return std::nullopt;
    }
    px[i] = camera.project(p);
  }
  if (!camera.contains(px[0], config.border_px)) {
    return std::nullopt;
  }
  PatchQuery query;
  query.host_px = c.value->pixel;
  query.start_px = px[0];
  query.target_from_host << (px[1] - px[0]) / kStep_px, (px[2] - px[0]) / kStep_px;
  const double area = query.target_from_host.determinant();
  const double limit = config.max_scale * config.max_scale;
  const double skew = query.target_from_host.squaredNorm() / (2.0 * std::abs(area));
  if (!(area > 1.0 / limit && area < limit && skew < 2.5)) {
    return std::nullopt;
  }
  return query;
}

float depthAt(const TargetView& view, const Eigen::Vector2d& px) {
  if (view.depth_m == nullptr) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  return view.depth_m->at<float>(static_cast<int>(px.y() + 0.5), static_cast<int>(px.x() + 0.5));
}

/// Standard deviation of a landmark's projection: of the aligned patch, and of its depth as far as the parallax shows it.
double projectionSigma_px(const Candidate& c, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_camera_world,
                          double pixel_sigma_px) {
  const Eigen::Vector3d ray = camera.ray(c.value->pixel.x(), c.value->pixel.y());
  const Eigen::Vector3d near = T_camera_world * (c.T_world_host * (ray / (c.value->inverse_depth + c.value->sigma)));
  const Eigen::Vector3d middle = T_camera_world * (c.T_world_host * (ray / c.value->inverse_depth));
  if (near.z() < 0.05 || middle.z() < 0.05) {
    return pixel_sigma_px;
  }
  return std::hypot(pixel_sigma_px, (camera.project(near) - camera.project(middle)).norm());
}

/// The patches' matches so far, one slot a candidate.
struct Sightings {
  std::vector<char> in_view;
  std::vector<std::optional<Eigen::Vector2d>> pixel;
  std::vector<std::int8_t> level;
};

/// Which candidates to look for, and from which level of the pyramid down.
struct Search {
  int coarsest_level = 0;
  std::size_t stride = 1;  ///< every n-th candidate
};

void search(const TargetView& view, const std::vector<Candidate>& candidates, const Eigen::Isometry3d& T_world_camera, const Search& what,
            const FollowerConfig& config, Sightings& sightings) {
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  for (std::size_t i = 0; i < candidates.size(); i += what.stride) {
    if (sightings.pixel[i]) {
      continue;
    }
    auto query = predict(candidates[i], *view.camera, T_camera_world, config);
    sightings.in_view[i] = query ? 1 : 0;
    if (!query) {
      continue;
    }
    query->coarsest_level = what.coarsest_level;
    const PatchMatch match = alignPatch(*candidates[i].host, *view.pyramid, *query, config.patch);
    if (match.found && view.camera->contains(match.target_px, 1.0)) {
      sightings.pixel[i] = match.target_px;
      sightings.level[i] = static_cast<std::int8_t>(match.level);
    }
  }
}

struct Solved {
  PoseSolution pose;
  std::vector<std::size_t> candidate;  ///< of each sighting in the solution
};

Solved solve(const TargetView& view, const std::vector<Candidate>& candidates, const Sightings& sightings,
             const Eigen::Isometry3d& T_world_camera, const FollowerConfig& config) {
  Solved solved;
  std::vector<PointSighting> points;
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (sightings.pixel[i]) {
      const Candidate& c = candidates[i];
      points.push_back({c.T_world_host * pointInHost(*c.value, *view.camera), *sightings.pixel[i], depthAt(view, *sightings.pixel[i]),
                        projectionSigma_px(c, *view.camera, T_camera_world, config.pixel_sigma_px * (1 << sightings.level[i]))});
      solved.candidate.push_back(i);
    }
  }
  solved.pose = solvePose(points, *view.camera, T_world_camera, config.pose);
  return solved;
}

void forgetOutliers(const Solved& solved, Sightings& sightings) {
  for (std::size_t k = 0; k < solved.candidate.size(); ++k) {
    if (solved.pose.inlier[k] == 0) {
      sightings.pixel[solved.candidate[k]].reset();
    }
  }
}

/// A few landmarks looked for from far away tell the pose well enough for all others to be looked for nearby. The prediction stands
/// where too few are found.
Eigen::Isometry3d probe(const TargetView& view, const std::vector<Candidate>& candidates, const Eigen::Isometry3d& T_world_camera_predicted,
                        const FollowerConfig& config, Sightings& sightings) {
  constexpr std::size_t kProbes = 40;
  constexpr int kEnough = 12;
  search(view, candidates, T_world_camera_predicted, {config.coarsest_level, std::max<std::size_t>(1, candidates.size() / kProbes)}, config,
         sightings);
  const Solved solved = solve(view, candidates, sightings, T_world_camera_predicted, config);
  const bool usable = solved.pose.status == PoseStatus::kConverged && solved.pose.inliers >= kEnough &&
                      solved.pose.inliers * 10 >= static_cast<int>(solved.candidate.size()) * 7;
  if (!usable) {
    search(view, candidates, T_world_camera_predicted, {config.coarsest_level, 1}, config, sightings);
    return T_world_camera_predicted;
  }
  forgetOutliers(solved, sightings);
  search(view, candidates, solved.pose.T_world_camera, {1, 1}, config, sightings);
  return solved.pose.T_world_camera;
}

}  // namespace

FollowResult followLandmarks(const TargetView& view, const std::vector<Candidate>& candidates,
                             const Eigen::Isometry3d& T_world_camera_predicted, const FollowerConfig& config) {
  FollowResult result;
  Sightings sightings{std::vector<char>(candidates.size(), 0), std::vector<std::optional<Eigen::Vector2d>>(candidates.size()),
                      std::vector<std::int8_t>(candidates.size(), 0)};
  const Eigen::Isometry3d T_world_camera_probed = probe(view, candidates, T_world_camera_predicted, config, sightings);
  Solved solved = solve(view, candidates, sightings, T_world_camera_probed, config);
  if (solved.pose.status == PoseStatus::kConverged) {
    forgetOutliers(solved, sightings);
    search(view, candidates, solved.pose.T_world_camera, {1, 1}, config, sightings);
    solved = solve(view, candidates, sightings, solved.pose.T_world_camera, config);
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    result.in_view += sightings.in_view[i] != 0 || sightings.pixel[i] ? 1 : 0;
  }
  result.found = static_cast<int>(solved.candidate.size());
  result.pose = solved.pose;
  if (solved.pose.status != PoseStatus::kConverged) {
    return result;
  }
  for (std::size_t k = 0; k < solved.candidate.size(); ++k) {
    if (solved.pose.inlier[k] != 0) {
      const std::size_t i = solved.candidate[k];
      result.observations.push_back(
          {candidates[i].landmark, sightings.pixel[i]->cast<float>(), Eigen::half(depthAt(view, *sightings.pixel[i])), sightings.level[i]});
    }
  }
  result.tracked = result.pose.inliers >= config.min_inliers && result.pose.inliers >= config.min_inlier_ratio * result.found;
  return result;
}

std::vector<Observation> findLandmarks(const TargetView& view, const std::vector<Candidate>& candidates,
                                       const Eigen::Isometry3d& T_world_camera, double gate_px, const FollowerConfig& config) {
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  std::vector<Observation> observations;
  for (const Candidate& candidate : candidates) {
    auto query = predict(candidate, *view.camera, T_camera_world, config);
    if (!query) {
      continue;
    }
    query->coarsest_level = 1;
    const PatchMatch match = alignPatch(*candidate.host, *view.pyramid, *query, config.patch);
    if (match.found && match.level == 0 && (match.target_px - query->start_px).norm() < gate_px &&
        view.camera->contains(match.target_px, 1.0)) {
      observations.push_back({candidate.landmark, match.target_px.cast<float>(), Eigen::half(depthAt(view, match.target_px)), 0});
    }
  }
  return observations;
}

}  // namespace oikos::mapping
