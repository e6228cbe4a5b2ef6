// SPDX-License-Identifier: Apache-2.0
#include "registration/normal_equations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/registration/furniture_scan.h"
#include "tests/support/analytic_room.h"

namespace oikos::registration {
namespace {

struct Bench {
  render::Scene scene;
  std::unique_ptr<CameraMotion> motion;
  explicit Bench(PoseFreedom freedom) {
    scene.add(test::believed({"table"}), Eigen::Isometry3d::Identity(), {});
    scene.commit();
    motion = std::make_unique<CameraMotion>(scene, test::lookAt({2.0, 0.3, 1.3}, {0.0, 0.0, 0.7}), freedom);
  }
};

std::vector<Pair> randomPairs(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    Pair pair;
    pair.model_map = Eigen::Vector3d(normal(random), normal(random), normal(random));
    pair.normal_map = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    pair.scan_map = pair.model_map + 0.01 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    pair.sigma_m = 0.003;
    pair.part = 0;
    pairs.push_back(pair);
  }
  return pairs;
}

/// The model's point goes on by a step, seen from the scan.
double residualAfter(const Pair& pair, const Motion& motion, const Step& step) {
  const Eigen::Isometry3d T_after = motionAbout(motion.pivot_map(), motion.twistsOf(pair.part) * step);
  return pair.normal_map.dot(pair.scan_map - T_after * pair.model_map);
}

TEST(NormalEquations, JacobianIsTheDerivativeOfTheResidual) {
  for (const PoseFreedom freedom : {PoseFreedom::kPlanar, PoseFreedom::kRigid}) {
    const Bench bench(freedom);
    for (const Pair& pair : randomPairs(20, 3)) {
      const Step J = jacobianOf(pair, bench.motion->twistsOf(0), bench.motion->pivot_map());
      for (Eigen::Index i = 0; i < J.size(); ++i) {
        constexpr double kSmall = 1e-6;
        Step step = Step::Zero(J.size());
        step[i] = kSmall;
        EXPECT_NEAR(J[i], (residualAfter(pair, *bench.motion, step) - residualAfter(pair, *bench.motion, -step)) / (2.0 * kSmall), 1e-7);
      }
    }
  }
}

/// The sum is the plain one over pairs, and its step is downhill to the least of the weighted squares.
TEST(NormalEquations, StepSolvesTheLinearProblem) {
  const Bench bench(PoseFreedom::kRigid);
  const std::vector<Pair> pairs = randomPairs(200, 4);
  const NormalEquations sum = sumUp(pairs, *bench.motion, {.surface_sigma_m = 0.0, .kernel_m = 1e6});
  const Step step = -sum.H.ldlt().solve(sum.g);
  const auto cost = [&](const Step& s) {
    double total = 0.0;
    for (const Pair& pair : pairs) {
      const double r = pair.residual_m() + jacobianOf(pair, bench.motion->twistsOf(0), bench.motion->pivot_map()).dot(s);
      total += r * r;
    }
    return total;
  };
  for (Eigen::Index i = 0; i < step.size(); ++i) {
    Step other = step;
    other[i] += 1e-3;
    EXPECT_GT(cost(other), cost(step));
    other[i] -= 2e-3;
    EXPECT_GT(cost(other), cost(step));
  }
  EXPECT_NEAR(sum.squares_m / sum.weight, cost(Step::Zero(6)) / 200.0, 1e-12);
}

TEST(NormalEquations, OneWallHoldsTwoOfThreeFreedoms) {
  const Bench bench(PoseFreedom::kPlanar);
  std::vector<Pair> wall = randomPairs(500, 5);
  for (Pair& pair : wall) {
    pair.model_map.x() = 0.0;
    pair.normal_map = Eigen::Vector3d::UnitX();
  }
  const Observability observability = observe(sumUp(wall, *bench.motion, {}));
  EXPECT_LT(observability.ratio[0], 1e-3);
  EXPECT_GT(observability.ratio[1], 100.0);
  const auto free = observability.directions.col(0);
  EXPECT_GT(std::abs(free[1]), 100.0 * std::abs(free[0]));  // along the wall: y
}

/// Noise on the normals of a bare wall makes information along it; it must be taken for what it is. Each pair's own normal is turned by
/// the deviation that the model of the errors states.
TEST(NormalEquations, NoisyNormalsDoNotMakeAWallObservable) {
  const Bench bench(PoseFreedom::kPlanar);
  const ErrorModel errors;
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  std::vector<Pair> wall = randomPairs(3000, 7);
  for (Pair& pair : wall) {
    pair.model_map.x() = 0.0;
    pair.normal_map = Eigen::Vector3d(1.0, errors.normal_sigma_rad * normal(random), errors.normal_sigma_rad * normal(random)).normalized();
  }
  const NormalEquations sum = sumUp(wall, *bench.motion, errors);
  EXPECT_GT(sum.H(1, 1), 500.0);  // 4 cm or less, if it were true
  EXPECT_LT(observe(sum).ratio[0], 2.0);
}

TEST(NormalEquations, OutliersAreOutweighed) {
  const Bench bench(PoseFreedom::kPlanar);
  std::vector<Pair> pairs = randomPairs(300, 8);
  for (Pair& pair : pairs) {
    pair.scan_map = pair.model_map;
  }
  for (std::size_t i = 0; i < 60; ++i) {
    pairs[i].scan_map += 0.2 * pairs[i].normal_map;
  }
  const NormalEquations robust = sumUp(pairs, *bench.motion, {});
  const NormalEquations naive = sumUp(pairs, *bench.motion, {.kernel_m = 1e6});
  EXPECT_LT(Step(robust.H.ldlt().solve(robust.g)).norm(), 1e-3);
  EXPECT_GT(Step(naive.H.ldlt().solve(naive.g)).norm(), 1e-2);
  EXPECT_EQ(robust.inliers, 240);
}

}  // namespace
}  // namespace oikos::registration
