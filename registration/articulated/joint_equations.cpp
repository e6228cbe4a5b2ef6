// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/joint_equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oikos::registration {

JointEquations::JointEquations(const JointTree& tree, std::vector<JointAxis> axes, const Eigen::Vector3d& pivot_map, double surface_sigma_m)
    : counts(tree.links().size()), tree_(tree), axes_(std::move(axes)), pivot_map_(pivot_map), surface_sigma_m_(surface_sigma_m) {
  const auto size = static_cast<Eigen::Index>(firstOf(static_cast<int>(tree.links().size())));
  H = Eigen::MatrixXd::Zero(size, size);
  g = Eigen::VectorXd::Zero(size);
  for (const Link& link : tree.links()) {
    LinkSums sum;
    for (int i = 0; i < kBaseSize; ++i) {
      sum.indices.push_back(i);
    }
    for (const int mover : link.chain) {
      for (int i = 0; i < kLinkSize; ++i) {
        sum.indices.push_back(firstOf(mover) + i);
      }
    }
    const auto local = static_cast<Eigen::Index>(sum.indices.size());
    sum.H = Eigen::MatrixXd::Zero(local, local);
    sum.g = Eigen::VectorXd::Zero(local);
    sum.J = Eigen::VectorXd::Zero(local);
    sums_.push_back(std::move(sum));
  }
}

void JointEquations::add(const PixelTerm& term) {
  LinkSums& sum = sums_[static_cast<std::size_t>(term.link)];
  sum.J.head<3>() = -term.normal_map;
  sum.J.segment<3>(3) = -(term.model_map - pivot_map_).cross(term.normal_map);
  Eigen::Index i = kBaseSize;
  for (const int mover : tree_.links()[static_cast<std::size_t>(term.link)].chain) {
    sum.J[i] = -term.normal_map.dot(axes_[static_cast<std::size_t>(mover)].velocityOf(term.model_map));
    sum.J.segment<3>(i + 1) = -term.normal_map;
    i += kLinkSize;
  }
  sum.H.selfadjointView<Eigen::Lower>().rankUpdate(sum.J, term.weight);
  sum.g += term.weight * term.residual_m * sum.J;
  sum.readings += term.reading;
  if (term.link != 0) {
    addReach(term, sum.J[i - kLinkSize], sum);  // the last of the chain is its own
  }
  if (term.link == 0) {
    const Eigen::Vector3i facing = (1.5 * term.normal_map).array().round().cast<int>();
    const std::array<int, 4> surface = {term.is_outline ? 1 : 0, facing.x(), facing.y(), facing.z()};
    shifts_.try_emplace(surface, geometry::Vector6d::Zero()).first->second += term.weight * surface_sigma_m_ * sum.J.head<kBaseSize>();
  }
}

void JointEquations::addReach(const PixelTerm& term, double reach, LinkSums& sum) {
  if (term.is_outline) {
    sum.outline_reach_sq += term.weight * reach * reach;
    return;
  }
  sum.weight += term.weight;
  sum.reach += term.weight * reach;
  sum.reach_sq += term.weight * reach * reach;
  sum.height_m += term.weight * term.height_m;
}

double JointEquations::distortionGain(int link) const {
  const LinkSums& sum = sums_[static_cast<std::size_t>(link)];
  if (sum.weight <= 0.0) {
    return 0.0;
  }
  const double mean = sum.reach / sum.weight;
  const double told_sq = axes_[static_cast<std::size_t>(link)].is_turn ? sum.reach_sq - sum.weight * mean * mean : sum.reach_sq;
  if (told_sq <= 0.0) {
    return 0.0;  // planes do not tell its value
  }
  const double by_planes = told_sq / (told_sq + sum.outline_reach_sq);
  return by_planes * (sum.height_m / sum.weight) / std::sqrt(told_sq / sum.weight);
}

void JointEquations::gather(double tempering, double most_readings, const std::vector<char>& counting) {
  for (std::size_t link = 0; link < sums_.size(); ++link) {
    if (counting[link] == 0) {
      continue;
    }
    const LinkSums& sum = sums_[link];
    const double share = std::min(tempering, most_readings / std::max(1.0, sum.readings));
    if (link == 0) {
      base_share_ = share;
    }
    for (std::size_t a = 0; a < sum.indices.size(); ++a) {
      g[sum.indices[a]] += share * sum.g[static_cast<Eigen::Index>(a)];
      for (std::size_t b = 0; b <= a; ++b) {
        const double value = share * sum.H(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        H(sum.indices[a], sum.indices[b]) += value;
        if (a != b) {
          H(sum.indices[b], sum.indices[a]) += value;
        }
      }
    }
  }
}

geometry::Matrix6d JointEquations::surfaces() const {
  geometry::Matrix6d sum = geometry::Matrix6d::Zero();
  for (const auto& [surface, shift] : shifts_) {
    sum += base_share_ * base_share_ * shift * shift.transpose();
  }
  return sum;
}

}  // namespace oikos::registration
