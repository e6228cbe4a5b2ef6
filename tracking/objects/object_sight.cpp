// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/object_sight.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/camera/depth_noise.h"

namespace oikos::tracking {

namespace {

constexpr double kNear_m = 0.1;
constexpr int kFewest = 15;                // pixels that tell: fewer may be an outline that is off
constexpr double kMinCarrierFacing = 0.1;  // half of what an object needs: tops of furniture are seen flat

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, double by_m) {
  return {box.min() - Eigen::Vector3d::Constant(by_m), box.max() + Eigen::Vector3d::Constant(by_m)};
}

/// A surface of the home in a pixel.
struct Surface {
  double depth_m = 0.0;  ///< NaN: nothing is known to be there
  double facing = 0.0;   ///< cosine between ray and normal
  double upright = 0.0;  ///< cosine between normal and straight up
  double along = 0.0;    ///< normal times the ray that is 1 m long along the optical axis: what a shift along the normal is in depth
};

/// The readings about an object's place, and what the home has there.
struct Crop {
  const DepthView& view;
  const ObjectSight& sight;
  camera::PinholeCamera camera;
  render::View with;
  render::View without;
  Eigen::Vector3d up_camera;

  [[nodiscard]] double reading_m(int u, int v) const {
    return static_cast<double>(view.depth_m.at<float>(v + sight.crop.top, u + sight.crop.left));
  }
  [[nodiscard]] Surface surfaceAt(const render::View& believed, int u, int v) const {
    const auto& normal = believed.normal_camera.at<cv::Vec3f>(v, u);
    const Eigen::Vector3d normal_camera(normal[0], normal[1], normal[2]);
    const Eigen::Vector3d ray_camera = camera.ray(u, v);
    const double along = normal_camera.dot(ray_camera);
    return {static_cast<double>(believed.depth_m.at<float>(v, u)), std::abs(along) / ray_camera.norm(), normal_camera.dot(up_camera),
            along};
  }
};

/// What the readings of the carrier's top say of how high it stands. The object stands on it as high, so that errors of pose and place
/// in this direction, which are most of what hides a flat object, cancel.
struct CarrierHeight {
  double lift_m = 0.0;   ///< above where it is believed to be
  double sigma_m = 0.0;  ///< of that
};

/// When a reading is of a surface.
class Tolerance {
 public:
  Tolerance(const ObjectSightConfig& config, double place_sigma_m, const CarrierHeight& height)
      : sigmas_(config.sigmas), place_sigma_m_(place_sigma_m), height_(height) {}

  /// Where the surface should be, as high as its carrier stands.
  [[nodiscard]] double depth_m(const Surface& surface) const {
    return std::abs(surface.along) < kMinCarrierFacing ? surface.depth_m
                                                       : surface.depth_m + height_.lift_m * surface.upright / surface.along;
  }
  /// Along the optical axis: farther off, a reading is not of that surface.
  [[nodiscard]] double around_m(const Surface& surface) const {
    const double up_sq = surface.upright * surface.upright;
    const double place_m = std::sqrt(up_sq * height_.sigma_m * height_.sigma_m + (1.0 - up_sq) * place_sigma_m_ * place_sigma_m_);
    return sigmas_ * std::hypot(camera::depthSigma_m(surface.depth_m), place_m / std::max(surface.facing, kMinCarrierFacing));
  }

 private:
  double sigmas_;
  double place_sigma_m_;
  CarrierHeight height_;
};

/// Counts the readings beside the object. Nothing of the carrier's top is seen: it is as high as it is believed to be.
CarrierHeight measureCarrier(const Crop& crop, const BelievedScene& scene, const WatchedObject& object, const ObjectSightConfig& config,
                             ObjectSight& sight) {
  constexpr double kUpright = 0.9;
  const Tolerance tolerance(config, sight.sigma_m, {0.0, sight.sigma_m});
  std::vector<double> lifts_m;
  for (int v = 0; v < crop.camera.height; ++v) {
    for (int u = 0; u < crop.camera.width; ++u) {
      const double reading_m = crop.reading_m(u, v);
      const Surface beside = crop.surfaceAt(crop.without, u, v);
      const double behind_m = reading_m - beside.depth_m;
      const double around_m = tolerance.around_m(beside);
      if (!(behind_m >= -around_m) || beside.facing < kMinCarrierFacing || scene.modelOf(crop.with.part.at<int>(v, u)) == object.model) {
        continue;
      }
      const bool agrees = behind_m <= around_m;
      ++sight.around;
      sight.around_agrees += agrees ? 1 : 0;
      if (scene.modelOf(crop.without.part.at<int>(v, u)) == object.carrier_model) {
        ++sight.carrier;
        sight.carrier_agrees += agrees ? 1 : 0;
        if (agrees && beside.upright > kUpright) {
          lifts_m.push_back(behind_m * beside.along);
        }
      }
    }
  }
  if (static_cast<int>(lifts_m.size()) < config.min_carrier_pixels) {
    return {0.0, sight.sigma_m};
  }
  const auto middle = lifts_m.begin() + static_cast<std::ptrdiff_t>(lifts_m.size() / 2);
  std::nth_element(lifts_m.begin(), middle, lifts_m.end());
  return {*middle, std::min(config.height_sigma_m, sight.sigma_m)};
}

/// The box in which matter may be the object, nudged.
Eigen::AlignedBox3d aboutObject(const WatchedObject& object, const ObjectSightConfig& config) {
  Eigen::AlignedBox3d about = grown(object.box_object, config.near_m);
  about.min().z() = object.box_object.min().z() + std::min(config.above_carrier_m, 0.4 * object.box_object.sizes().z());
  return about;
}

/// Where the object is seen wherever it is within its deviation: not at its outline.
bool isCore(const Crop& crop, const BelievedScene& scene, const WatchedObject& object, int u, int v) {
  const double depth_m = static_cast<double>(crop.with.depth_m.at<float>(v, u));
  const int reach = static_cast<int>(std::ceil(crop.sight.sigma_m * crop.camera.fx / depth_m));
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      const int beside_u = u + du * reach;
      const int beside_v = v + dv * reach;
      if (beside_u < 0 || beside_v < 0 || beside_u >= crop.camera.width || beside_v >= crop.camera.height ||
          scene.modelOf(crop.with.part.at<int>(beside_v, beside_u)) != object.model) {
        return false;
      }
    }
  }
  return true;
}

/// A reading at the object's core.
void countCore(double reading_m, const Surface& object, const Surface& behind, const Tolerance& tolerance, const ObjectSightConfig& config,
               ObjectSight& sight) {
  ++sight.core;
  const double around_m = tolerance.around_m(object);
  const double room_m = tolerance.depth_m(behind) - tolerance.depth_m(object);  // NaN: nothing is known to be behind it
  if (object.facing >= config.min_facing && !(room_m <= around_m + 2.0 * camera::depthSigma_m(behind.depth_m))) {
    ++sight.telling;
    sight.through += reading_m > tolerance.depth_m(object) + around_m ? 1 : 0;
  }
}

void countObject(const Crop& crop, const BelievedScene& scene, const WatchedObject& object, const Tolerance& tolerance,
                 const ObjectSightConfig& config, ObjectSight& sight, const Eigen::Isometry3d& T_object_camera) {
  const Eigen::AlignedBox3d about = aboutObject(object, config);
  for (int v = 0; v < crop.camera.height; ++v) {
    for (int u = 0; u < crop.camera.width; ++u) {
      const double reading_m = crop.reading_m(u, v);
      const Surface behind = crop.surfaceAt(crop.without, u, v);
      const bool is_nearer = reading_m > 0.0 && !(reading_m >= tolerance.depth_m(behind) - tolerance.around_m(behind));
      const bool is_matter = is_nearer && about.contains(T_object_camera * (reading_m * crop.camera.ray(u, v)));
      sight.matter += is_matter ? 1 : 0;
      if (scene.modelOf(crop.with.part.at<int>(v, u)) != object.model) {
        continue;
      }
      const Surface surface = crop.surfaceAt(crop.with, u, v);
      ++sight.pixels;
      if (!(reading_m > 0.0)) {
        ++sight.missing;
      } else if (reading_m < tolerance.depth_m(surface) - tolerance.around_m(surface)) {
        sight.hidden += is_matter ? 0 : 1;
      } else if (isCore(crop, scene, object, u, v)) {
        countCore(reading_m, surface, behind, tolerance, config, sight);
      }
    }
  }
}

/// Whether what carries the object is where it should be, and so the camera; nothing: too little of it was measured.
std::optional<bool> isCarrierInPlace(const ObjectSight& sight, bool can_be_pushed, const ObjectSightConfig& config) {
  if (sight.carrier >= config.min_carrier_pixels) {
    return sight.carrier_agrees >= config.min_carrier * sight.carrier;
  }
  if (can_be_pushed || sight.around < config.min_carrier_pixels) {
    return std::nullopt;
  }
  return sight.around_agrees >= config.min_carrier * sight.around;
}

void judge(bool can_be_pushed, const ObjectSightConfig& config, ObjectSight& sight) {
  const auto share = [&](int count) { return static_cast<double>(count) / std::max(1, sight.pixels); };
  if (sight.pixels == 0 || sight.sigma_m > config.max_sigma_m) {
    return;
  }
  if (share(sight.matter) >= config.min_matter) {
    sight.verdict = SightVerdict::kThere;
    return;
  }
  if (share(sight.hidden) > config.max_hidden) {
    sight.verdict = SightVerdict::kHidden;
    return;
  }
  const std::optional<bool> is_carried = isCarrierInPlace(sight, can_be_pushed, config);
  sight.is_blind = !is_carried || share(sight.missing) > config.max_missing;
  const bool tells = sight.telling >= kFewest && sight.telling >= config.min_telling * sight.core;
  const bool is_gone = sight.through >= config.min_through * sight.telling && share(sight.matter) <= config.max_matter;
  if (!sight.is_blind && *is_carried && tells && is_gone) {
    sight.against = std::min(1.0, static_cast<double>(sight.telling) / config.min_telling_pixels);
    sight.verdict = sight.telling >= config.min_telling_pixels ? SightVerdict::kNotThere : SightVerdict::kUnclear;
  }
}

}  // namespace

registration::PixelBox pixelsAround(const Eigen::AlignedBox3d& box_object, const Eigen::Isometry3d& T_camera_object,
                                    const camera::PinholeCamera& camera, double around_m) {
  const Eigen::AlignedBox3d around = grown(box_object, around_m);
  Eigen::AlignedBox2d box;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner_camera = T_camera_object * around.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    if (corner_camera.z() < kNear_m) {
      return {};
    }
    box.extend(camera.project(corner_camera));
  }
  const Eigen::Array2d low = box.min().array().max(0.0).min(Eigen::Array2d(camera.width, camera.height));
  const Eigen::Array2d high = (box.max().array() + 1.0).max(0.0).min(Eigen::Array2d(camera.width, camera.height));
  return {static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(high.x()), static_cast<int>(high.y())};
}

camera::PinholeCamera cropped(const camera::PinholeCamera& camera, const registration::PixelBox& box, int step_px) {
  const double step = step_px;
  return {(box.right - box.left + step_px - 1) / step_px,
          (box.bottom - box.top + step_px - 1) / step_px,
          camera.fx / step,
          camera.fy / step,
          (camera.cx - box.left) / step,
          (camera.cy - box.top) / step};
}

double poseSigma_m(const DepthView& view, const Eigen::Vector3d& point_map) {
  Eigen::Matrix<double, 3, 6> J;  // of T exp(xi) p: R (v + w x p)
  J << Eigen::Matrix3d::Identity(), -geometry::skew(view.T_map_camera.inverse() * point_map);
  const Eigen::Matrix3d covariance = J * view.covariance * J.transpose();
  return std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly).eigenvalues()(2)));
}

ObjectSight lookAt(BelievedScene& scene, std::size_t object, const ObjectStand& stand, const DepthView& view,
                   const ObjectSightConfig& config) {
  const WatchedObject& watched = scene.objects()[object];
  const Eigen::Isometry3d T_camera_object = view.T_map_camera.inverse() * stand.T_map_object;
  ObjectSight sight;
  sight.crop = pixelsAround(watched.box_object, T_camera_object, view.camera, config.near_m);
  const camera::PinholeCamera camera = cropped(view.camera, sight.crop);
  if (camera.width <= 0 || camera.height <= 0) {
    return sight;
  }
  const double carried_m = watched.can_be_pushed ? config.carried_sigma_m : config.fixed_sigma_m;
  const Eigen::Vector4d sigmas_m(config.object_sigma_m, carried_m, stand.joint_sigma_m,
                                 poseSigma_m(view, stand.T_map_object * watched.box_object.center()));
  sight.sigma_m = sigmas_m.norm();
  const Crop crop{view,
                  sight,
                  camera,
                  scene.view(camera, view.T_map_camera),
                  scene.viewWithout(object, camera, view.T_map_camera),
                  view.T_map_camera.linear().transpose() * Eigen::Vector3d::UnitZ()};
  const CarrierHeight height = measureCarrier(crop, scene, watched, config, sight);
  countObject(crop, scene, watched, Tolerance(config, sight.sigma_m, height), config, sight, T_camera_object.inverse());
  judge(watched.can_be_pushed, config, sight);
  return sight;
}

}  // namespace oikos::tracking
