// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/object_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "tracking/objects/object_sight.h"

namespace oikos::tracking {

namespace {

constexpr double kSecond_ns = 1e9;
constexpr double kEnough_px = 2500.0;
constexpr int kRaysPerSide = 14;

/// One frame of each stretch of `spacing_s`: the first that was read, else the first.
std::vector<const WatchFrame*> thinned(const std::vector<WatchFrame>& frames, double spacing_s) {
  std::vector<const WatchFrame*> chosen;
  std::int64_t begin_ns = 0;
  for (const WatchFrame& frame : frames) {
    if (chosen.empty() || static_cast<double>(frame.stamp_ns - begin_ns) >= spacing_s * kSecond_ns) {
      begin_ns = frame.stamp_ns;
      chosen.push_back(&frame);
    } else if (frame.was_read && !chosen.back()->was_read) {
      chosen.back() = &frame;
    }
  }
  return chosen;
}

bool isNear(const Eigen::Isometry3d& T_camera_object, const WatchedObject& object, const ObjectViewConfig& config) {
  const Eigen::Vector3d middle_camera = T_camera_object * object.box_object.center();
  return middle_camera.z() > 0.0 && middle_camera.norm() <= config.max_range_m;
}

bool isWithin(const registration::PixelBox& box, const camera::PinholeCamera& camera) {
  return box.left > 0 && box.top > 0 && box.right < camera.width && box.bottom < camera.height;
}

/// Pixels that should show the object; 0: too few, or too much of it is hidden.
double shownPixels(const BelievedScene& scene, const WatchedObject& object, const Eigen::Isometry3d& T_map_camera,
                   const Eigen::Isometry3d& T_camera_object, const camera::PinholeCamera& camera, const ObjectViewConfig& config) {
  const registration::PixelBox box = pixelsAround(object.box_object, T_camera_object, camera, 0.0);
  const int width = box.right - box.left;
  const int height = box.bottom - box.top;
  if (!isWithin(box, camera) || std::min(width, height) < config.min_side_px || width * height < config.min_pixels) {
    return 0.0;
  }
  const int step_px = (std::max(width, height) + kRaysPerSide - 1) / kRaysPerSide;
  const render::View view = scene.view(cropped(camera, box, step_px), T_map_camera);
  int rays = 0;
  for (int v = 0; v < view.part.rows; ++v) {
    for (int u = 0; u < view.part.cols; ++u) {
      rays += scene.modelOf(view.part.at<int>(v, u)) == object.model ? 1 : 0;
    }
  }
  const double pixels = static_cast<double>(rays) * step_px * step_px;
  return pixels >= config.min_pixels && pixels >= config.min_shown * width * height ? pixels : 0.0;
}

bool isApart(const ObjectCandidate& one, const std::vector<Eigen::Vector3d>& places_map, double apart_m) {
  return std::all_of(places_map.begin(), places_map.end(),
                     [&](const Eigen::Vector3d& place) { return (one.camera_map - place).norm() >= apart_m; });
}

}  // namespace

std::vector<std::vector<ObjectCandidate>> findCandidates(BelievedScene& scene, const std::vector<WatchFrame>& frames,
                                                         const camera::PinholeCamera& camera, const ObjectViewConfig& config) {
  std::vector<std::vector<ObjectCandidate>> candidates(scene.objects().size());
  for (const WatchFrame* const frame : thinned(frames, config.spacing_s)) {
    scene.goTo(frame->stamp_ns);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const std::optional<ObjectStand> stand = scene.stand(i);
      if (!stand) {
        continue;
      }
      const Eigen::Isometry3d T_camera_object = frame->T_map_camera.inverse() * stand->T_map_object;
      const WatchedObject& object = scene.objects()[i];
      if (isNear(T_camera_object, object, config)) {
        const double pixels = shownPixels(scene, object, frame->T_map_camera, T_camera_object, camera, config);
        if (pixels > 0.0) {
          candidates[i].push_back({frame->frame, frame->stamp_ns, frame->T_map_camera.translation(), std::min(pixels, kEnough_px)});
        }
      }
    }
  }
  return candidates;
}

std::optional<ObjectCandidate> bestCandidate(const std::vector<ObjectCandidate>& candidates, std::int64_t from_ns,
                                             const std::vector<Eigen::Vector3d>& places_map, const std::set<int>& read,
                                             const ObjectViewConfig& config) {
  double most = 0.0;
  for (const ObjectCandidate& one : candidates) {
    most = std::max(most, one.worth);
  }
  const ObjectCandidate* best = nullptr;
  double best_worth = 0.0;
  for (const ObjectCandidate& one : candidates) {
    const double worth = one.worth * (read.contains(one.frame) ? config.read_anyway : 1.0);
    if (one.stamp_ns >= from_ns && one.worth >= config.min_worth * most && worth > best_worth && isApart(one, places_map, config.apart_m)) {
      best = &one;
      best_worth = worth;
    }
  }
  return best == nullptr ? std::nullopt : std::optional(*best);
}

}  // namespace oikos::tracking
