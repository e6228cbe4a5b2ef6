// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/prior_fusion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "registration/motion.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kElsewhere_m = 0.1;

}  // namespace

PriorFusion::PriorFusion(const LandmarkScene& scene, const CameraPrior& prior, const LandmarkConfig& config, std::optional<int> only)
    : scene_(scene), prior_(prior), config_(config), only_(only) {}

LandmarkRefinement PriorFusion::priorAlone() const {
  LandmarkRefinement answer;
  answer.T_map_camera = prior_.T_map_camera;
  answer.covariance = covariance6(planarCovariance(prior_), prior_.T_map_camera);
  return answer;
}

double PriorFusion::deviations(const LandmarkFit& fit) const {
  const Step back = stepToPrior(prior_, fit.T_map_camera);
  return std::sqrt(back.dot((fit.align.covariance + planarCovariance(prior_)).ldlt().solve(back)));
}

bool PriorFusion::isElsewhere(const LandmarkFit& fit, const Eigen::Isometry3d& T_map_rival) const {
  CameraPrior rival = prior_;
  rival.T_map_camera = T_map_rival;
  const Step back = stepToPrior(rival, fit.T_map_camera);
  const double deviations = std::sqrt(back.dot(fit.align.covariance.ldlt().solve(back)));
  return back.head<2>().norm() > kElsewhere_m && deviations > config_.max_deviations;
}

void PriorFusion::fuse(const LandmarkFit& fit, LandmarkRefinement& answer) const {
  const StepMatrix of_fit = fit.align.covariance + ownPlacement(fit.T_map_camera);
  const StepMatrix gain = of_fit * (of_fit + planarCovariance(prior_)).inverse();
  const Step step = gain * stepToPrior(prior_, fit.T_map_camera);
  CameraMotion motion(scene_.scene(), fit.T_map_camera, PoseFreedom::kPlanar, prior_.robot_camera);
  motion.apply(step);
  answer.T_map_camera = motion.T_map_camera();
  answer.covariance = covariance6(of_fit - gain * of_fit, answer.T_map_camera);
  answer.unobserved = fit.align.unobserved;
  answer.moved_m = (answer.T_map_camera * prior_.robot_camera - prior_.T_map_camera * prior_.robot_camera).norm();
  answer.moved_rad = Eigen::AngleAxisd(prior_.T_map_camera.linear().transpose() * answer.T_map_camera.linear()).angle();
}

StepMatrix PriorFusion::ownPlacement(const Eigen::Isometry3d& T_map_camera) const {
  StepMatrix covariance = StepMatrix::Zero(3, 3);
  if (!only_) {
    return covariance;
  }
  const auto is_its = [this](const LandmarkSurface& surface) { return surface.landmark == *only_; };
  const auto first = std::find_if(scene_.surfaces().begin(), scene_.surfaces().end(), is_its) - scene_.surfaces().begin();
  const Eigen::Vector3d piece_map = scene_.scene().parts()[static_cast<std::size_t>(first)].T_map_part.translation();
  const Eigen::Vector3d arm = T_map_camera * prior_.robot_camera - piece_map;
  const double shift_sq = config_.align.surface_sigma_m * config_.align.surface_sigma_m;
  const double turn_rad = config_.align.normal_sigma_deg * kDegree;
  const Eigen::Vector3d turned(-turn_rad * arm.y(), turn_rad * arm.x(), turn_rad);
  covariance.diagonal() << shift_sq, shift_sq, 0.0;
  covariance += turned * turned.transpose();
  return covariance;
}

geometry::Matrix6d PriorFusion::covariance6(const StepMatrix& planar, const Eigen::Isometry3d& T_map_camera) const {
  return cameraCovariance(planar, {config_.upright_sigma_m, config_.upright_sigma_deg * kDegree}, T_map_camera, prior_.robot_camera);
}

}  // namespace oikos::registration
