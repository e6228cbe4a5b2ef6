// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/base_pose_error.h"

#include <cmath>
#include <numbers>

namespace oikos::metrics {

namespace {

double yawOf(const Eigen::Isometry3d& T) {
  return std::atan2(T.linear()(1, 0), T.linear()(0, 0));
}

}  // namespace

BasePoseError evaluateBasePoses(const std::vector<PosePair>& pairs) {
  std::vector<double> position_m;
  std::vector<double> rotation_rad;
  std::vector<double> x_m;
  std::vector<double> y_m;
  std::vector<double> yaw_rad;
  for (const PosePair& pair : pairs) {
    const Eigen::Isometry3d& estimate = pair.T_estimate_camera;
    const Eigen::Isometry3d& truth = pair.T_truth_camera;
    const Eigen::Vector3d off_m = estimate.translation() - truth.translation();
    position_m.push_back(off_m.norm());
    x_m.push_back(std::abs(off_m.x()));
    y_m.push_back(std::abs(off_m.y()));
    rotation_rad.push_back(Eigen::AngleAxisd(truth.linear().transpose() * estimate.linear()).angle());
    yaw_rad.push_back(std::abs(std::remainder(yawOf(estimate) - yawOf(truth), 2.0 * std::numbers::pi)));
  }
  return {statisticsOf(position_m), statisticsOf(rotation_rad), statisticsOf(x_m), statisticsOf(y_m), statisticsOf(yaw_rad)};
}

}  // namespace oikos::metrics
