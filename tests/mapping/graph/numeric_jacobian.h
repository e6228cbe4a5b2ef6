// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

#include "mapping/graph/projection_cost.h"

namespace oikos::mapping {

/// What a cost says of itself at a point, and central differences of its residuals there. Blocks of seven are poses, changed along
/// RightPerturbedPose; the matrices have one column a degree of freedom.
struct CheckedJacobians {
  Eigen::VectorXd residuals;
  std::vector<Eigen::MatrixXd> analytic;
  std::vector<Eigen::MatrixXd> numeric;
};

inline Eigen::VectorXd residualsOf(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& blocks) {
  std::vector<const double*> pointers;
  for (const Eigen::VectorXd& block : blocks) {
    pointers.push_back(block.data());
  }
  Eigen::VectorXd residuals(cost.num_residuals());
  cost.Evaluate(pointers.data(), residuals.data(), nullptr);
  return residuals;
}

inline Eigen::VectorXd moved(const Eigen::VectorXd& block, int axis, double step) {
  Eigen::VectorXd result = block;
  if (block.size() == 7) {
    Eigen::Matrix<double, 6, 1> xi = Eigen::Matrix<double, 6, 1>::Zero();
    xi[axis] = step;
    RightPerturbedPose().Plus(block.data(), xi.data(), result.data());
  } else {
    result[axis] += step;
  }
  return result;
}

inline CheckedJacobians checkJacobians(const ceres::CostFunction& cost, const std::vector<Eigen::VectorXd>& blocks, double step = 1e-6) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  CheckedJacobians result;
  std::vector<RowMajor> ambient;
  std::vector<const double*> values;
  std::vector<double*> pointers;
  for (const Eigen::VectorXd& block : blocks) {
    ambient.emplace_back(cost.num_residuals(), block.size());
    values.push_back(block.data());
  }
  for (RowMajor& J : ambient) {
    pointers.push_back(J.data());
  }
  result.residuals.resize(cost.num_residuals());
  cost.Evaluate(values.data(), result.residuals.data(), pointers.data());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto freedom = blocks[b].size() == 7 ? 6 : static_cast<int>(blocks[b].size());
    result.analytic.emplace_back(ambient[b].leftCols(freedom));
    Eigen::MatrixXd numeric(cost.num_residuals(), freedom);
    for (int axis = 0; axis < freedom; ++axis) {
      std::vector<Eigen::VectorXd> forward = blocks;
      std::vector<Eigen::VectorXd> backward = blocks;
      forward[b] = moved(blocks[b], axis, step);
      backward[b] = moved(blocks[b], axis, -step);
      numeric.col(axis) = (residualsOf(cost, forward) - residualsOf(cost, backward)) / (2.0 * step);
    }
    result.numeric.push_back(numeric);
  }
  return result;
}

}  // namespace oikos::mapping
