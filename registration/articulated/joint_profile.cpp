// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_profile.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "registration/pairs.h"

namespace oikos::registration {

namespace {

constexpr double kMinAlong = 0.05;  // a surface that is seen edge-on has its reading anywhere
constexpr double kRefuted = 3.0;    // deviations

Eigen::Vector3d normalAt(const cv::Mat& normal_camera, int u, int v) {
  const auto& normal = normal_camera.at<cv::Vec3f>(v, u);
  return {static_cast<double>(normal[0]), static_cast<double>(normal[1]), static_cast<double>(normal[2])};
}

/// Calls `visit(pixel of the scan, depth, u, v in the window)` for each pixel of the view that shows something and has a reading.
template <class Visit>
void forEachSeen(const WindowView& seen, const Scan& scan, const Visit& visit) {
  for (int v = 0; v < seen.window.height; ++v) {
    const int* parts = seen.view.part.ptr<int>(v);
    const auto* depths_m = seen.view.depth_m.ptr<float>(v);
    const auto row = static_cast<std::size_t>(seen.window.top + v) * static_cast<std::size_t>(scan.camera.width);
    for (int u = 0; u < seen.window.width; ++u) {
      const std::size_t pixel = row + static_cast<std::size_t>(seen.window.left + u);
      if (parts[u] >= 0 && scan.points[pixel].point_camera.z() > 0.0F) {
        visit(pixel, static_cast<double>(depths_m[u]), u, v);
      }
    }
  }
}

}  // namespace

JointProfiler::JointProfiler(const JointTree& tree, LinkLayers& layers, const Scan& scan, const Eigen::Isometry3d& T_map_camera,
                             const PixelMixture& mixture, const Surroundings& surroundings)
    : tree_(tree), layers_(layers), scan_(scan), T_camera_map_(T_map_camera.inverse()), mixture_(mixture) {
  if (!surroundings.isEmpty()) {
    explainBy(surroundings);
  }
}

void JointProfiler::explainBy(const Surroundings& surroundings) {
  OIKOS_CHECK(surroundings.depth_m.size() == cv::Size(scan_.camera.width, scan_.camera.height));
  about_.resize(scan_.points.size());
  std::size_t pixel = 0;
  for (int v = 0; v < scan_.camera.height; ++v) {
    for (int u = 0; u < scan_.camera.width; ++u, ++pixel) {
      const auto depth_m = static_cast<double>(surroundings.depth_m.at<float>(v, u));
      const ScanPoint& seen = scan_.points[pixel];
      if (!(depth_m > 0.0) || seen.point_camera.z() <= 0.0F) {
        continue;
      }
      const auto reading_m = static_cast<double>(seen.point_camera.z());
      const auto sigma_m = static_cast<double>(surroundings.sigma_m.at<float>(v, u));
      const Eigen::Vector3d normal_camera = normalAt(surroundings.normal_camera, u, v);
      const Eigen::Vector3d ray = seen.point_camera.cast<double>() / reading_m;
      const double along = std::max(kMinAlong, -normal_camera.dot(ray));
      ModelledPixel surface;
      surface.depth_m = depth_m;
      surface.sigma_m = std::hypot(residualSigma_m(reading_m, along / ray.norm()), sigma_m) / along;
      surface.faces = seen.normal_camera.isZero() || seen.normal_camera.cast<double>().dot(normal_camera) > mixture_.minNormalCos();
      if (reading_m - depth_m < kRefuted * surface.sigma_m) {  // else it is seen through: it is not there
        about_[pixel] = {depth_m, std::max(mixture_.logOfSurface(reading_m, surface), mixture_.logOfNothing())};
      }
    }
  }
}

Eigen::Isometry3d JointProfiler::T_camera_link(int link) const {
  const int part = tree_.links()[static_cast<std::size_t>(link)].parts.front();
  return T_camera_map_ * standing_.T_map_model * T_model_part_[static_cast<std::size_t>(part)];
}

void JointProfiler::stand(const Standing& standing, Others others, double sigma_m) {
  standing_ = standing;
  sigma_m_ = sigma_m;
  T_model_part_ = tree_.partPoses(standing_.joint_values);
  layers_.pose(T_model_part_, false);
  views_.assign(tree_.links().size(), {});
  for (std::size_t link = 0; link < views_.size(); ++link) {
    if (link == 0 || others == Others::kAll) {
      views_[link] = layers_.look(static_cast<int>(link), T_camera_link(static_cast<int>(link)), scan_.camera);
    }
  }
  if (others == Others::kAll && tree_.isNested()) {
    layers_.pose(T_model_part_, true);
  }
}

void JointProfiler::choose(int link) {
  link_ = link;
  rest_.assign(scan_.points.size(), {});
  std::vector<std::pair<int, int>> shown(scan_.points.size(), {-1, 0});  // whose surface, and its pixel in that view
  for (std::size_t other = 0; other < views_.size(); ++other) {
    if (static_cast<int>(other) != link && (other == 0 || !tree_.hangsOn(static_cast<int>(other), link)) &&
        !views_[other].window.isEmpty()) {
      forEachSeen(views_[other], scan_, [&](std::size_t pixel, double depth_m, int u, int v) {
        if (depth_m < rest_[pixel].depth_m) {
          rest_[pixel].depth_m = depth_m;
          shown[pixel] = {static_cast<int>(other), v * views_[other].window.width + u};
        }
      });
    }
  }
  std::vector<Eigen::Isometry3d> T_link_camera;
  T_link_camera.reserve(views_.size());
  for (std::size_t other = 0; other < views_.size(); ++other) {
    T_link_camera.push_back(T_camera_link(static_cast<int>(other)).inverse());
  }
  for (std::size_t pixel = 0; pixel < rest_.size(); ++pixel) {
    const auto [owner, place] = shown[pixel];
    rest_[pixel].log_density = mixture_.logOfNothing();
    if (!about_.empty() && about_[pixel].depth_m < rest_[pixel].depth_m) {
      rest_[pixel] = about_[pixel];
    } else if (owner >= 0) {
      const WindowView& seen = views_[static_cast<std::size_t>(owner)];
      rest_[pixel].log_density =
          logOf(pixel, rest_[pixel].depth_m, normalAt(seen.view.normal_camera, place % seen.window.width, place / seen.window.width), owner,
                T_link_camera[static_cast<std::size_t>(owner)]);
    }
  }
}

double JointProfiler::logOf(std::size_t pixel, double depth_m, const Eigen::Vector3d& normal_camera, int link,
                            const Eigen::Isometry3d& T_link_camera, ModelledPixel* kept) const {
  const ScanPoint& seen = scan_.points[pixel];
  const auto reading_m = static_cast<double>(seen.point_camera.z());
  const Eigen::Vector3d ray = seen.point_camera.cast<double>() / reading_m;
  const double along = std::max(kMinAlong, -normal_camera.dot(ray));
  ModelledPixel surface;
  surface.depth_m = depth_m;
  surface.sigma_m = std::hypot(residualSigma_m(reading_m, along / ray.norm()), sigma_m_) / along;
  surface.faces = seen.normal_camera.isZero() || seen.normal_camera.cast<double>().dot(normal_camera) > mixture_.minNormalCos();
  if (reading_m < depth_m - mixture_.minRoom_m() || depth_m - reading_m > 2.0 * surface.sigma_m) {
    const double enter_m = distanceToBox(layers_.ownBox(link), T_link_camera.translation(), T_link_camera.linear() * ray);
    surface.room_m = std::max(0.0, depth_m - enter_m);
  }
  if (kept != nullptr) {
    *kept = surface;
  }
  return mixture_.logOfSurface(reading_m, surface);
}

ValueScore JointProfiler::score(double value, const Eigen::Vector3d& shift_map) const {
  const Link& link = tree_.links()[static_cast<std::size_t>(link_)];
  const model::ModelJoint& joint = tree_.jointOf(link_);
  const Eigen::Isometry3d T_camera_joint =
      T_camera_map_ * standing_.T_map_model * T_model_part_[static_cast<std::size_t>(joint.parent)] * joint.T_parent_joint;
  Eigen::Isometry3d T_camera_child = T_camera_joint * model::jointMotion(joint, value);
  T_camera_child.pretranslate(T_camera_map_.linear() * shift_map);
  const WindowView seen = layers_.look(link_, T_camera_child, scan_.camera);
  ValueScore score;
  if (seen.window.isEmpty()) {
    return score;
  }
  OIKOS_CHECK(link.parts.front() == joint.child);
  const Eigen::Isometry3d T_link_camera = T_camera_child.inverse();
  forEachSeen(seen, scan_, [&](std::size_t pixel, double depth_m, int u, int v) {
    const Rest& rest = rest_[pixel];
    if (depth_m >= rest.depth_m) {
      return;
    }
    ModelledPixel surface;
    const double log_density = logOf(pixel, depth_m, normalAt(seen.view.normal_camera, u, v), link_, T_link_camera, &surface);
    const double deviations = (static_cast<double>(scan_.points[pixel].point_camera.z()) - depth_m) / surface.sigma_m;
    score.log_likelihood += log_density - rest.log_density;
    ++score.pixels;
    score.agreeing += std::abs(deviations) < 3.0 && surface.faces ? 1 : 0;
    score.behind += deviations >= 3.0 ? 1 : 0;
  });
  return score;
}

}  // namespace oikos::registration
