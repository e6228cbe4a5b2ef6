// SPDX-License-Identifier: Apache-2.0
#include "bench/articulated/trial.h"

#include <cmath>
#include <ctime>
#include <numbers>
#include <opencv2/core.hpp>

namespace oikos::bench {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

JointTrial judged(const registration::JointEstimate& joint, const World& world, const registration::Standing& believed,
                  const std::vector<double>& visible_shares) {
  const auto index = static_cast<std::size_t>(joint.joint);
  JointTrial trial;
  trial.kind = world.kind;
  trial.joint = joint.name;
  trial.is_turn = joint.evidence.is_turn;
  trial.status = joint.status;
  trial.true_value = world.values[index];
  trial.prior = believed.joint_values[index];
  trial.value = joint.value;
  trial.variance = joint.variance;
  trial.confidence = joint.confidence;
  trial.visible = visible_shares[static_cast<std::size_t>(world.real.joints[index].child)];
  trial.sight = joint.sight;
  return trial;
}

}  // namespace

double JointTrial::error() const {
  return std::abs(value - true_value);
}

bool JointTrial::isRight() const {
  return error() <= (is_turn ? 5.0 * kDegree : 0.02);
}

registration::Standing believedAnywhere(const World& world, const WorldSettings& settings, Random& random) {
  registration::Standing believed{believedPlace(world, settings, random), {}};
  for (const model::ModelJoint& joint : world.believed.joints) {
    believed.joint_values.push_back(std::uniform_real_distribution<double>(joint.lower, joint.upper)(random));
  }
  return believed;
}

PieceTrial runTrial(int number, const TrialSettings& settings) {
  Random random(settings.seed * 1'000'003 + static_cast<std::uint64_t>(number));
  const World world = makeWorld(number, settings.world, random);
  const Picture picture = takePicture(world, settings.world, static_cast<std::uint64_t>(number) + settings.seed, random);
  const registration::Standing believed = believedAnywhere(world, settings.world, random);
  registration::ArticulatedRegistration registration(world.believed, settings.config);
  PieceTrial trial;
  trial.number = number;
  trial.kind = world.kind;
  const std::clock_t begin = std::clock();
  const registration::Scan scan = registration::makeScan(picture.depth_m, picture.camera, {});
  const registration::ArticulatedResult result = registration.run(scan, world.T_map_camera, believed);
  trial.ms = 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  const Eigen::Isometry3d T_true_found = world.T_map_model.inverse() * result.T_map_model;
  trial.base_error_m = T_true_found.translation().norm();
  trial.base_error_deg = Eigen::AngleAxisd(T_true_found.linear()).angle() / kDegree;
  const std::vector<double> visible_shares = visibleShares(world, picture);
  for (const registration::JointEstimate& joint : result.joints) {
    trial.joints.push_back(judged(joint, world, believed, visible_shares));
  }
  return trial;
}

}  // namespace oikos::bench
