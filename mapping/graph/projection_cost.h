// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/jet.h>
#include <ceres/rotation.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mapping/graph/keyframe_graph.h"

namespace oikos::mapping {

/// Parameter blocks shared by the costs of the bundle adjustment:
///   pose      7: translation, quaternion (x y z w) of T_world_node
///   depth     1: inverse depth of the landmark in its host
///   lens      4: fx fy cx cy
///   readout   1: seconds from the first to the last row
struct ProjectionCost {
  Eigen::Vector2d host_px;
  Eigen::Vector2d seen_px;
  geometry::Vector6d host_velocity;
  geometry::Vector6d seen_velocity;
  double height;
  double inverse_sigma_px;

  /// Pose at the time of an image row: T_world_node * exp(velocity * t), to first order in the small angle.
  template <typename T>
  static void moved(const T* pose, const geometry::Vector6d& velocity, const T& time_s, Eigen::Quaternion<T>& q, Eigen::Matrix<T, 3, 1>& t) {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> translation(pose);
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(pose + 3);
    const Eigen::Matrix<T, 3, 1> half = velocity.tail<3>().cast<T>() * (T(0.5) * time_s);
    q = rotation * Eigen::Quaternion<T>(T(1.0), half.x(), half.y(), half.z()).normalized();
    t = translation + rotation * (velocity.head<3>().cast<T>() * time_s);
  }

  template <typename T>
  bool operator()(const T* host_pose, const T* seen_pose, const T* inverse_depth, const T* lens, const T* readout, T* residual) const {
    Eigen::Quaternion<T> q_host;
    Eigen::Quaternion<T> q_seen;
    Eigen::Matrix<T, 3, 1> t_host;
    Eigen::Matrix<T, 3, 1> t_seen;
    moved(host_pose, host_velocity, T(host_px.y() / height - 0.5) * readout[0], q_host, t_host);
    moved(seen_pose, seen_velocity, T(seen_px.y() / height - 0.5) * readout[0], q_seen, t_seen);
    const Eigen::Matrix<T, 3, 1> ray((host_px.x() - lens[2]) / lens[0], (host_px.y() - lens[3]) / lens[1], T(1.0));
    // Scaled by the inverse depth, so that far points stay finite.
    const Eigen::Matrix<T, 3, 1> p = q_seen.conjugate() * (q_host * ray + (t_host - t_seen) * inverse_depth[0]);
    if (p.z() < T(0.02)) {  // behind the camera: a constant, so that the kernel ignores it
      residual[0] = residual[1] = T(1e3);
      return true;
    }
    residual[0] = (lens[0] * p.x() / p.z() + lens[2] - seen_px.x()) * inverse_sigma_px;
    residual[1] = (lens[1] * p.y() / p.z() + lens[3] - seen_px.y()) * inverse_sigma_px;
    return true;
  }
};

/// The depth image's reading at a sighting, against the landmark's depth there.
struct SightingDepthCost {
  Eigen::Vector2d host_px;
  double measured_inverse_depth;
  double inverse_sigma;

  template <typename T>
  bool operator()(const T* host_pose, const T* seen_pose, const T* inverse_depth, const T* lens, const T* scale, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q_host(host_pose + 3);
    const Eigen::Map<const Eigen::Quaternion<T>> q_seen(seen_pose + 3);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t_host(host_pose);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t_seen(seen_pose);
    const Eigen::Matrix<T, 3, 1> ray((host_px.x() - lens[2]) / lens[0], (host_px.y() - lens[3]) / lens[1], T(1.0));
    const Eigen::Matrix<T, 3, 1> p = q_seen.conjugate() * (q_host * ray + (t_host - t_seen) * inverse_depth[0]);
    residual[0] = p.z() < T(0.02) ? T(0.0) : (inverse_depth[0] / p.z() * scale[0] - measured_inverse_depth) * inverse_sigma;
    return true;
  }
};

/// The host's own reading.
struct HostDepthCost {
  double measured_inverse_depth;
  double inverse_sigma;

  template <typename T>
  bool operator()(const T* inverse_depth, const T* scale, T* residual) const {
    residual[0] = (inverse_depth[0] * scale[0] - measured_inverse_depth) * inverse_sigma;
    return true;
  }
};

/// Pull of a parameter to its expected value.
template <int N>
struct PriorCost {
  Eigen::Matrix<double, N, 1> expected;
  Eigen::Matrix<double, N, 1> inverse_sigma;

  template <typename T>
  bool operator()(const T* value, T* residual) const {
    for (int i = 0; i < N; ++i) {
      residual[i] = (value[i] - expected[i]) * inverse_sigma[i];
    }
    return true;
  }
};

}  // namespace oikos::mapping
