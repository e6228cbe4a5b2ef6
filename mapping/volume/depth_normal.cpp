// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/depth_normal.h"

#include <Eigen/Geometry>

namespace oikos::mapping {

std::optional<Eigen::Vector3f> findDepthNormal(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const Eigen::Vector2i& pixel,
                                               int reach_px) {
  const auto point = [&](int du, int dv) -> Eigen::Vector3f {
    const float z = depth_m.ptr<float>(pixel.y() + dv)[pixel.x() + du];
    return z * camera.ray(pixel.x() + du, pixel.y() + dv).cast<float>();
  };
  const Eigen::Vector3f across = point(reach_px, 0) - point(-reach_px, 0);
  const Eigen::Vector3f down = point(0, reach_px) - point(0, -reach_px);
  const Eigen::Vector3f normal = down.cross(across);
  const Eigen::Vector3f bend = point(reach_px, 0) + point(-reach_px, 0) - point(0, reach_px) - point(0, -reach_px);
  const float length = normal.norm();
  if (!(length > 0.0F) || !(bend.norm() < 0.25F * (across.norm() + down.norm()))) {
    return std::nullopt;
  }
  return normal / length;
}

}  // namespace oikos::mapping
