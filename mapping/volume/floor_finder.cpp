// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/floor_finder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <opencv2/core.hpp>
#include <random>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "mapping/volume/depth_normal.h"
#include "mapping/volume/up_direction.h"

namespace oikos::mapping {

namespace {

constexpr int kMinReadings = 3;     ///< a surface element from fewer is noise
constexpr int kRansacRounds = 400;  ///< finds a plane of 12 % of the facing surface with 1 - 0.998^400 = 50 %, of 25 % surely
constexpr int kMaxPlanes = 16;
constexpr double kFacingCosine = 0.906;  ///< 25°: a single element's normal is rough
constexpr double kLevelCosine = 0.9925;  ///< 7°: a floor's is not
constexpr double kWellBelow_m = 0.15;
constexpr double kDepthBias_m = 0.02;      ///< of one side of a floor against the other
constexpr double kUpDeviation_rad = 0.02;  ///< of the direction that all surface votes for

/// A plane that faces up, with what speaks for it.
struct Candidate {
  geometry::Plane plane;
  std::vector<std::size_t> inliers;
  double area_m2 = 0.0;
  geometry::PlaneFitResult fit;  ///< to the inliers
};

class PlaneSearch {
 public:
  PlaneSearch(const std::vector<SurfaceElement>& surface, const Eigen::Vector3d& up_world, const FloorConfig& config)
      : surface_(surface), up_world_(up_world), config_(config), random_(static_cast<std::uint64_t>(config.seed)) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (surface[i].normal_world.dot(up_world) > kFacingCosine) {
        facing_.push_back(i);
      }
    }
  }

  /// Largest first.
  std::vector<Candidate> findAll() {
    std::vector<Candidate> planes;
    while (static_cast<int>(planes.size()) < kMaxPlanes && facing_.size() >= 3) {
      const Candidate plane = refine(findLargest());
      if (plane.inliers.size() < 3) {
        break;
      }
      std::erase_if(facing_, [&](std::size_t i) { return std::binary_search(plane.inliers.begin(), plane.inliers.end(), i); });
      if (plane.area_m2 >= config_.min_area_m2) {
        planes.push_back(plane);
      } else if (++small_planes_ > 3) {
        break;
      }
    }
    return planes;
  }

 private:
  /// From three random elements a round.
  geometry::Plane findLargest() {
    geometry::Plane best{up_world_, 0.0};
    std::size_t most = 0;
    for (int round = 0; round < kRansacRounds; ++round) {
      geometry::PlaneFit fit;
      for (int i = 0; i < 3; ++i) {
        fit.add(surface_[facing_[random_() % facing_.size()]].point_world);
      }
      const auto plane = upright(fit);
      const std::size_t count = plane ? countInliers(*plane) : 0;
      if (count > most) {
        most = count;
        best = *plane;
      }
    }
    return best;
  }

  std::optional<geometry::Plane> upright(const geometry::PlaneFit& fit) const {
    const geometry::PlaneFitResult result = fit.solve();
    geometry::Plane plane = result.plane;
    if (plane.normal.dot(up_world_) < 0.0) {
      plane = {-plane.normal, -plane.offset_m};
    }
    const bool level = result.status == geometry::PlaneFitStatus::kFitted && plane.normal.dot(up_world_) > kLevelCosine;
    return level ? std::optional(plane) : std::nullopt;
  }

  [[nodiscard]] std::size_t countInliers(const geometry::Plane& plane) const {
    return static_cast<std::size_t>(std::count_if(facing_.begin(), facing_.end(), [&](std::size_t i) { return isInlier(plane, i); }));
  }

  [[nodiscard]] bool isInlier(const geometry::Plane& plane, std::size_t i) const {
    return std::fabs(plane.distanceM(surface_[i].point_world)) < config_.inlier_distance_m;
  }

  [[nodiscard]] Candidate refine(const geometry::Plane& start) const {
    Candidate candidate{start, {}, 0.0, {}};
    for (int iteration = 0; iteration < 4; ++iteration) {
      candidate.inliers.clear();
      geometry::PlaneFit fit;
      for (const std::size_t i : facing_) {
        if (isInlier(candidate.plane, i)) {
          candidate.inliers.push_back(i);
          fit.add(surface_[i].point_world);
        }
      }
      const auto plane = upright(fit);
      if (!plane) {
        break;
      }
      candidate.plane = *plane;
      candidate.fit = fit.solve();
    }
    candidate.area_m2 = areaM2(candidate);
    return candidate;
  }

  /// Cells of the plane, a voxel wide, that have an inlier: thickness and slant do not count twice.
  [[nodiscard]] double areaM2(const Candidate& candidate) const {
    const Eigen::Vector3d along = candidate.plane.normal.unitOrthogonal();
    const Eigen::Vector3d across = candidate.plane.normal.cross(along);
    BrickIndex cells;
    for (const std::size_t i : candidate.inliers) {
      const auto cell = [&](const Eigen::Vector3d& axis) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(axis.dot(surface_[i].point_world) / config_.voxel_m)) +
                                          (1 << 20));
      };
      cells.findOrInsert((cell(along) << 32U) | cell(across));
    }
    return static_cast<double>(cells.size()) * config_.voxel_m * config_.voxel_m;
  }

  const std::vector<SurfaceElement>& surface_;
  Eigen::Vector3d up_world_;
  const FloorConfig& config_;
  std::mt19937_64 random_;
  std::vector<std::size_t> facing_;
  int small_planes_ = 0;
};

bool isNothingBelow(const Candidate& plane, const std::vector<SurfaceElement>& surface, const FloorConfig& config) {
  const auto below = std::count_if(surface.begin(), surface.end(), [&](const SurfaceElement& element) {
    return plane.plane.distanceM(element.point_world) < -kWellBelow_m;
  });
  return static_cast<double>(below) <= config.max_share_below * static_cast<double>(plane.inliers.size());
}

/// The planes' heights are compared below the camera. Of planes that are the lowest within the depth's errors, the largest.
std::optional<Candidate> chooseFloor(const std::vector<Candidate>& planes, const std::vector<SurfaceElement>& surface,
                                     const Eigen::Vector3d& camera_world, const FloorConfig& config) {
  std::vector<Candidate> possible;
  std::copy_if(planes.begin(), planes.end(), std::back_inserter(possible), [&](const Candidate& plane) {
    return plane.plane.distanceM(camera_world) >= config.min_camera_height_m && isNothingBelow(plane, surface, config);
  });
  if (possible.empty()) {
    return std::nullopt;
  }
  const auto depth_m = [&](const Candidate& plane) { return plane.plane.distanceM(camera_world); };
  double lowest_m = 0.0;
  for (const Candidate& plane : possible) {
    lowest_m = std::max(lowest_m, depth_m(plane));
  }
  std::erase_if(possible, [&](const Candidate& plane) { return depth_m(plane) < lowest_m - kWellBelow_m; });
  return *std::max_element(possible.begin(), possible.end(), [](const Candidate& a, const Candidate& b) { return a.area_m2 < b.area_m2; });
}

/// The floor as it is most likely: a small patch says where the floor is but, with the depth's bias, not which way it faces, and
/// all the other surface does. The two directions are weighed by their variances; the plane goes through the patch's centroid.
geometry::Plane levelled(const Candidate& floor, const Eigen::Vector3d& up_world) {
  const double tilt_deviation_rad = kDepthBias_m / std::max(floor.fit.width_m, 1e-3);
  const double weight_of_floor = 1.0 / (tilt_deviation_rad * tilt_deviation_rad);
  const double weight_of_up = 1.0 / (kUpDeviation_rad * kUpDeviation_rad);
  const Eigen::Vector3d normal = (weight_of_floor * floor.plane.normal + weight_of_up * up_world).normalized();
  return {normal, normal.dot(floor.fit.centroid)};
}

double rmsM(const Candidate& floor, const geometry::Plane& plane, const std::vector<SurfaceElement>& surface) {
  double sum_sq = 0.0;
  for (const std::size_t i : floor.inliers) {
    sum_sq += std::pow(plane.distanceM(surface[i].point_world), 2);
  }
  return std::sqrt(sum_sq / static_cast<double>(floor.inliers.size()));
}

/// z along the plane's normal and 0 in it, the origin below the camera, x along its optical axis.
Eigen::Isometry3d frameOn(const geometry::Plane& plane, const Eigen::Isometry3d& T_world_camera) {
  const auto level = [&](const Eigen::Vector3d& axis) { return Eigen::Vector3d(axis - plane.normal.dot(axis) * plane.normal); };
  Eigen::Vector3d forward = level(T_world_camera.linear().col(2));
  if (forward.norm() < 0.1) {  // it looks straight down or up: the top of the image points ahead
    forward = level(-T_world_camera.linear().col(1));
  }
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  T_world_map.linear().col(2) = plane.normal;
  T_world_map.linear().col(0) = forward.normalized();
  T_world_map.linear().col(1) = plane.normal.cross(T_world_map.linear().col(0));
  const Eigen::Vector3d camera_world = T_world_camera.translation();
  T_world_map.translation() = camera_world - plane.distanceM(camera_world) * plane.normal;
  return T_world_map.inverse(Eigen::Isometry);
}

}  // namespace

std::vector<std::string> FloorConfig::validate() const {
  base::ConfigRules rules;
  rules.between("voxel_m", voxel_m, 0.01, 0.2).between("pixel_stride", pixel_stride, 1, 64);
  rules.between("normal_baseline_m", normal_baseline_m, 0.01, 1.0).between("max_tilt_rad", max_tilt_rad, 0.0, 1.5);
  rules.greater("inlier_distance_m", inlier_distance_m, 0.0).greater("min_area_m2", min_area_m2, 0.0);
  rules.atLeast("min_camera_height_m", min_camera_height_m, 0.0).between("max_share_below", max_share_below, 0.0, 1.0);
  return rules.messages();
}

FloorFinder::FloorFinder(const FloorConfig& config) : config_(config), lattice_(config.voxel_m) {
  OIKOS_CHECK(config.validate().empty());
}

void FloorFinder::add(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_world_camera) {
  OIKOS_CHECK(depth_m.type() == CV_32FC1 && depth_m.cols == camera.width && depth_m.rows == camera.height);
  T_world_first_ = T_world_first_.value_or(T_world_camera);
  image_up_sum_ -= T_world_camera.linear().col(1);
  const Eigen::Isometry3f T = T_world_camera.cast<float>();
  for (int v = 0; v < depth_m.rows; v += config_.pixel_stride) {
    for (int u = 0; u < depth_m.cols; u += config_.pixel_stride) {
      const float z = depth_m.ptr<float>(v)[u];
      const double wanted_px = 0.5 * config_.normal_baseline_m * camera.fx / static_cast<double>(z);
      const int room_px = std::min({u, v, depth_m.cols - 1 - u, depth_m.rows - 1 - v});
      if (!(z > 0.0F) || !(wanted_px <= room_px)) {
        continue;
      }
      const auto normal = findDepthNormal(depth_m, camera, {u, v}, std::max(2, static_cast<int>(wanted_px)));
      const Eigen::Vector3f point_world = T * (z * camera.ray(u, v).cast<float>());
      const auto key = lattice_.findKey(point_world);
      if (!normal || !key) {
        continue;
      }
      const std::uint32_t number = index_.findOrInsert(*key);
      if (number == sums_.size()) {
        sums_.emplace_back();
      }
      sums_[number].point_world += point_world - lattice_.center(*key);
      sums_[number].normal_world += T.linear() * *normal;
      ++sums_[number].count;
    }
  }
}

FloorResult FloorFinder::find() const {
  FloorResult result;
  if (!T_world_first_) {
    return result;
  }
  std::vector<SurfaceElement> surface;
  for (const std::uint32_t number : index_.sorted()) {
    const Sum& sum = sums_[number];
    const double length = sum.normal_world.cast<double>().norm();
    if (sum.count >= kMinReadings && length > 0.5 * sum.count) {
      const Eigen::Vector3f mean = lattice_.center(index_.key(number)) + sum.point_world / static_cast<float>(sum.count);
      surface.push_back({mean.cast<double>(), sum.normal_world.cast<double>() / length});
    }
  }
  const Eigen::Vector3d image_up =
      image_up_sum_.norm() > 1e-6 ? Eigen::Vector3d(image_up_sum_.normalized()) : Eigen::Vector3d(-T_world_first_->linear().col(1));
  const UpDirection up = findUp(surface, {image_up, config_.max_tilt_rad});
  result.agreement = up.agreement;
  const Eigen::Vector3d camera_world = T_world_first_->translation();
  const auto floor = chooseFloor(PlaneSearch(surface, up.up_world, config_).findAll(), surface, camera_world, config_);
  geometry::Plane ground{up.up_world, up.up_world.dot(camera_world)};
  result.status = FloorStatus::kNoFloor;
  if (floor) {
    ground = levelled(*floor, up.up_world);
    result.status = FloorStatus::kFound;
    result.inliers = static_cast<int>(floor->inliers.size());
    result.area_m2 = floor->area_m2;
    result.rms_m = rmsM(*floor, ground, surface);
    result.camera_height_m = ground.distanceM(camera_world);
  }
  result.tilt_rad = std::acos(std::clamp(ground.normal.dot(image_up), -1.0, 1.0));
  result.T_map_world = frameOn(ground, *T_world_first_);
  return result;
}

}  // namespace oikos::mapping
