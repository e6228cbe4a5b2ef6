// SPDX-License-Identifier: Apache-2.0
// Chen & Medioni, "Object modelling by registration of multiple range images" (1992, doi:10.1016/0262-8856(92)90066-C), with the
// test of Hatleskog & Alexis, "Probabilistic Degeneracy Detection for Point-to-Plane Error Minimization" (RA-L 2024), in mind: a direction
// counts as observed if its information is a multiple of what turned normals would make of it. Differs in that the normals are the
// model's, so that one deviation stands for the model's error, and that the multiple is asked for instead of a probability.
#include "registration/normal_equations.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>

namespace oikos::registration {

namespace {

/// Points of one part whose normals lie about the same way are off together.
std::array<int, 5> surfaceOf(const Pair& pair) {
  const Eigen::Vector3i facing = (1.5 * pair.normal_map).array().round().cast<int>();
  return {pair.part, pair.is_edge ? 1 : 0, facing.x(), facing.y(), facing.z()};
}

}  // namespace

Step jacobianOf(const Pair& pair, const Twists& twists, const Eigen::Vector3d& pivot_map) {
  Eigen::Matrix<double, 6, 1> row;
  row << pair.normal_map, (pair.model_map - pivot_map).cross(pair.normal_map);
  return -twists.transpose() * row;
}

namespace {

/// Sums in plain arrays: a pair costs some dozens of multiplications, and matrices of a size known only at run time cost more than that.
class Sums {
 public:
  Sums(const Motion& motion, const ErrorModel& errors)
      : motion_(motion), errors_(errors), size_(motion.dimension()), pivot_map_(motion.pivot_map()) {}

  void add(const Pair& pair) {
    const double sigma_m = std::sqrt(pair.sigma_m * pair.sigma_m + errors_.surface_sigma_m * errors_.surface_sigma_m);
    const double residual_m = pair.residual_m();
    const double kernel_m = std::max(3.0 * sigma_m, errors_.kernel_m);
    const double share = 1.0 / (1.0 + residual_m * residual_m / (kernel_m * kernel_m));
    const double weight = share * share / (sigma_m * sigma_m);
    Surface& surface = surfaceFor(pair);
    const Eigen::Vector3d arm = pair.model_map - pivot_map_;
    std::array<double, kMost> J{};
    std::array<Eigen::Vector3d, kMost> velocity;
    for (std::size_t k = 0; k < static_cast<std::size_t>(size_); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      velocity[k] = surface.twists->col(column).head<3>() + Eigen::Vector3d(surface.twists->col(column).tail<3>()).cross(arm);
      J[k] = -pair.normal_map.dot(velocity[k]);
    }
    // A normal turned by a small angle takes up what moves along the surface; an outline has no other side to turn to.
    const double noise = pair.is_edge ? 0.0 : weight * errors_.normal_sigma_rad * errors_.normal_sigma_rad;
    for (std::size_t k = 0; k < static_cast<std::size_t>(size_); ++k) {
      for (std::size_t l = 0; l <= k; ++l) {
        H_[k][l] += weight * J[k] * J[l];
        H_of_noise_[k][l] += noise * (velocity[k].dot(velocity[l]) - J[k] * J[l]);
      }
      g_[k] += weight * residual_m * J[k];
      surface.shift[k] += weight * errors_.surface_sigma_m * J[k];
    }
    sum_.weight += share * share;
    sum_.squares += weight * residual_m * residual_m;
    sum_.squares_m += share * share * residual_m * residual_m;
    if (std::abs(residual_m) < kernel_m) {
      ++(pair.is_edge ? sum_.edge_inliers : sum_.inliers);
    }
  }

  NormalEquations total() {
    sum_.H = StepMatrix::Zero(size_, size_);
    sum_.H_of_noise = StepMatrix::Zero(size_, size_);
    sum_.surfaces = StepMatrix::Zero(size_, size_);
    sum_.g = Eigen::Map<const Step>(g_.data(), size_);
    for (Eigen::Index k = 0; k < size_; ++k) {
      for (Eigen::Index l = 0; l <= k; ++l) {
        sum_.H(k, l) = sum_.H(l, k) = H_[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
        sum_.H_of_noise(k, l) = sum_.H_of_noise(l, k) = H_of_noise_[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
      }
    }
    for (const auto& [key, surface] : surfaces_) {
      const Eigen::Map<const Step> shift(surface.shift.data(), size_);
      sum_.surfaces += shift * shift.transpose();
    }
    return sum_;
  }

 private:
  static constexpr std::size_t kMost = 8;  ///< degrees of freedom
  struct Surface {
    const Twists* twists = nullptr;
    std::array<double, kMost> shift{};  ///< what its deviation does to g
  };

  Surface& surfaceFor(const Pair& pair) {
    const std::array<int, 5> key = surfaceOf(pair);
    if (last_ != nullptr && key == last_key_) {
      return *last_;
    }
    auto surface = surfaces_.find(key);
    if (surface == surfaces_.end()) {
      auto twists = twists_of_part_.find(pair.part);
      if (twists == twists_of_part_.end()) {
        twists = twists_of_part_.emplace(pair.part, motion_.twistsOf(pair.part)).first;
      }
      surface = surfaces_.emplace(key, Surface{&twists->second}).first;
    }
    last_key_ = key;
    last_ = &surface->second;
    return *last_;
  }

  const Motion& motion_;
  const ErrorModel& errors_;
  Eigen::Index size_;
  Eigen::Vector3d pivot_map_;
  std::map<int, Twists> twists_of_part_;
  std::map<std::array<int, 5>, Surface> surfaces_;
  std::array<int, 5> last_key_{};
  Surface* last_ = nullptr;
  std::array<std::array<double, kMost>, kMost> H_{};
  std::array<std::array<double, kMost>, kMost> H_of_noise_{};
  std::array<double, kMost> g_{};
  NormalEquations sum_;
};

}  // namespace

NormalEquations sumUp(const std::vector<Pair>& pairs, const Motion& motion, const ErrorModel& errors) {
  Sums sums(motion, errors);
  for (const Pair& pair : pairs) {
    sums.add(pair);
  }
  return sums.total();
}

Observability observe(const NormalEquations& equations) {
  const Eigen::Index size = equations.g.size();
  const double floor = 1e-9 * (equations.H_of_noise.trace() + equations.H.trace()) / static_cast<double>(size) + 1e-12;
  const StepMatrix noise = equations.H_of_noise + floor * StepMatrix::Identity(size, size);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(equations.H), Eigen::MatrixXd(noise));
  Observability observability;
  observability.ratio.assign(eigen.eigenvalues().begin(), eigen.eigenvalues().end());
  observability.directions = eigen.eigenvectors();
  return observability;
}

}  // namespace oikos::registration
