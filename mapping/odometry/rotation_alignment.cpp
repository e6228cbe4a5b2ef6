// SPDX-License-Identifier: Apache-2.0
// Gauss-Newton over SO(3). Residual per pixel x of the current image, with the infinite homography K R K^-1:
//   e(x) = I_previous(K R K^-1 x) - (gain * I_current(x) + bias)
#include "mapping/odometry/rotation_alignment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/se3.h"

namespace oikos::mapping {

namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

constexpr int kMaxIterations = 15;
constexpr double kHuber = 15.0;  ///< grey values

struct SmallImage {
  cv::Mat value;  ///< CV_32F, blurred
  cv::Mat gradient_x;
  cv::Mat gradient_y;
};

int smallLevel(const ImagePyramid& pyramid) {
  int level = 0;
  while (level + 1 < pyramid.levels() && pyramid.level(level).cols > 90) {
    ++level;
  }
  return level;
}

SmallImage prepare(const cv::Mat& image) {
  SmallImage small;
  image.convertTo(small.value, CV_32F);
  cv::GaussianBlur(small.value, small.value, cv::Size(5, 5), 1.0);
  cv::Sobel(small.value, small.gradient_x, CV_32F, 1, 0, 3, 0.125);
  cv::Sobel(small.value, small.gradient_y, CV_32F, 0, 1, 3, 0.125);
  return small;
}

camera::PinholeCamera scaled(const camera::PinholeCamera& camera, const cv::Mat& image, int level) {
  const double s = 1.0 / (1 << level);
  return {image.cols, image.rows, camera.fx * s, camera.fy * s, (camera.cx + 0.5) * s - 0.5, (camera.cy + 0.5) * s - 0.5};
}

struct Bilinear {
  int x, y;
  float w00, w01, w10, w11;
  Bilinear(double u, double v) : x(static_cast<int>(u)), y(static_cast<int>(v)) {
    const auto a = static_cast<float>(u - x);
    const auto b = static_cast<float>(v - y);
    w00 = (1.0F - a) * (1.0F - b);
    w01 = a * (1.0F - b);
    w10 = (1.0F - a) * b;
    w11 = a * b;
  }
  [[nodiscard]] double at(const cv::Mat& image) const {
    const float* top = image.ptr<float>(y) + x;
    const float* bottom = image.ptr<float>(y + 1) + x;
    return static_cast<double>(w00 * top[0] + w01 * top[1] + w10 * bottom[0] + w11 * bottom[1]);
  }
};

struct NormalEquations {
  Matrix5d H = Matrix5d::Zero();
  Vector5d g = Vector5d::Zero();
  double cost = 0.0;
  int pixels = 0;
};

struct State {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  double gain = 1.0;
  double bias = 0.0;
};

NormalEquations linearise(const SmallImage& previous, const SmallImage& current, const camera::PinholeCamera& camera, const State& state) {
  NormalEquations n;
  for (int v = 0; v < current.value.rows; ++v) {
    const float* row = current.value.ptr<float>(v);
    for (int u = 0; u < current.value.cols; ++u) {
      const Eigen::Vector3d ray = camera.ray(u, v);
      const Eigen::Vector3d p = state.R * ray;
      if (p.z() < 0.2) {
        continue;
      }
      const Eigen::Vector2d px = camera.project(p);
      if (!(px.x() >= 0.0 && px.y() >= 0.0 && px.x() < camera.width - 1 && px.y() < camera.height - 1)) {
        continue;
      }
      const Bilinear b(px.x(), px.y());
      const double intensity = row[u];
      const double e = b.at(previous.value) - state.gain * intensity - state.bias;
      const double gx = b.at(previous.gradient_x) * camera.fx / p.z();
      const double gy = b.at(previous.gradient_y) * camera.fy / p.z();
      const Eigen::Vector3d by_point(gx, gy, -(gx * p.x() + gy * p.y()) / p.z());
      const double weight = std::abs(e) < kHuber ? 1.0 : kHuber / std::abs(e);
      Vector5d J;
      // R exp(w) ray: d(p)/d(w) = -R [ray]x, so e changes by (ray x R^T g) . w
      J.head<3>() = ray.cross(state.R.transpose() * by_point);
      J.tail<2>() << -intensity, -1.0;
      n.H.noalias() += weight * J * J.transpose();
      n.g.noalias() += weight * e * J;
      n.cost += weight * e * e;
      ++n.pixels;
    }
  }
  return n;
}

/// Whether the pictures say anything about the rotation: plain ones do not.
bool isObservable(const NormalEquations& n) {
  constexpr double kLeastChange = 1.0;  // grey values per rad, over all pixels
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(n.H.topLeftCorner<3, 3>(), Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().minCoeff() > kLeastChange * kLeastChange * n.pixels;
}

}  // namespace

RotationAlignment alignRotation(const ImagePyramid& previous, const ImagePyramid& current, const camera::PinholeCamera& camera,
                                const Eigen::Matrix3d& R_previous_current_guess) {
  const int level = smallLevel(current);
  const SmallImage a = prepare(previous.level(level));
  const SmallImage b = prepare(current.level(level));
  const camera::PinholeCamera small = scaled(camera, b.value, level);
  State state{R_previous_current_guess, 1.0, 0.0};
  RotationAlignment result;
  result.R_previous_current = R_previous_current_guess;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const NormalEquations n = linearise(a, b, small, state);
    if (n.pixels < b.value.cols * b.value.rows / 4) {
      return result;
    }
    result.rms = std::sqrt(n.cost / n.pixels);
    if (!isObservable(n)) {
      return result;
    }
    Matrix5d H = n.H;
    H.diagonal() *= 1.0 + 1e-6;
    const Vector5d step = -H.ldlt().solve(n.g);
    if (!step.allFinite()) {
      return result;
    }
    state.R = state.R * geometry::expSo3(step.head<3>());
    state.gain += step[3];
    state.bias += step[4];
    if (step.head<3>().norm() < 2e-4) {
      result.converged = true;
      break;
    }
  }
  result.converged = result.converged || result.rms < kHuber;
  if (result.converged) {
    result.R_previous_current = Eigen::Quaterniond(state.R).normalized().toRotationMatrix();
  }
  return result;
}

}  // namespace oikos::mapping
