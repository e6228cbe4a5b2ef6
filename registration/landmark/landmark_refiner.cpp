// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/config_rules.h"
#include "core/base/error.h"

namespace oikos::registration {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Solution {
  AlignResult fit;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

class Refiner {
 public:
  Refiner(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior, const LandmarkConfig& config, std::optional<int> only)
      : scene_(scene), scan_(scan), prior_(prior), config_(config), only_(only), used_(scene.surfaces().size(), 1) {
    for (std::size_t s = 0; s < used_.size(); ++s) {
      used_[s] = !only || scene.surfaces()[s].landmark == *only ? 1 : 0;
    }
    moved_.assign(scene.ids().size(), 0.0);
  }

  LandmarkRefinement run() {
    LandmarkRefinement answer;
    answer.T_map_camera = prior_.T_map_camera;
    answer.covariance = covariance6(priorCovariance(), prior_.T_map_camera);
    Solution solution;
    do {
      ++answer.rounds;
      scene_.show(used_);
      solution = solve();
      check(solution);
    } while (answer.rounds < config_.max_rounds && leaveOutWorst());
    answer.status = judge(solution);
    answer.rms_m = solution.fit.rms_m;
    answer.overlap = solution.fit.overlap;
    answer.landmarks = contributions();
    if (answer.status == RefinementStatus::kRefined) {
      fuse(solution, answer);
    }
    scene_.show(std::vector<char>(used_.size(), 1));
    return answer;
  }

 private:
  [[nodiscard]] Solution solveFrom(const Eigen::Isometry3d& T_map_camera) const {
    CameraMotion motion(scene_.scene(), T_map_camera, PoseFreedom::kPlanar, prior_.robot_camera);
    Solution solution;
    solution.fit = align(motion, scan_, config_.align);
    solution.T_map_camera = motion.T_map_camera();
    return solution;
  }

  [[nodiscard]] Eigen::Isometry3d turnedPrior(double yaw_rad) const {
    geometry::Vector6d twist = geometry::Vector6d::Zero();
    twist(5) = yaw_rad;
    return motionAbout(prior_.T_map_camera * prior_.robot_camera, twist) * prior_.T_map_camera;
  }

  [[nodiscard]] Solution solve() const {
    Solution best = solveFrom(prior_.T_map_camera);
    for (const double side : {-1.0, 1.0}) {
      if (best.fit.overlap < config_.good_overlap) {
        const Solution other = solveFrom(turnedPrior(side * config_.yaw_step_deg * kDegree));
        best = other.fit.inliers > best.fit.inliers ? other : best;
      }
    }
    return best;
  }

  void check(const Solution& solution) {
    const CameraMotion motion(scene_.scene(), solution.T_map_camera, PoseFreedom::kPlanar, prior_.robot_camera);
    checks_ = checkSurfaces(scene_, motion, scan_, solution.fit.covariance, config_.check, config_.align.threads);
  }

  /// What contradicts half as much as the worst goes with it. False: nothing contradicts.
  bool leaveOutWorst() {
    double worst = 1.0;
    for (std::size_t s = 0; s < checks_.size(); ++s) {
      worst = std::max(worst, used_[s] != 0 ? checks_[s].contradiction : 0.0);
    }
    if (worst <= 1.0) {
      return false;
    }
    for (std::size_t s = 0; s < checks_.size(); ++s) {
      const double contradiction = checks_[s].contradiction;
      if (used_[s] != 0 && contradiction > 1.0 && contradiction >= 0.5 * worst) {
        leaveOut(s);
      }
    }
    return true;
  }

  /// With its base a piece goes as a whole.
  void leaveOut(std::size_t surface) {
    const LandmarkSurface& out = scene_.surfaces()[surface];
    used_[surface] = 0;
    if (!out.is_base) {
      dropped_.push_back(static_cast<int>(surface));
      return;
    }
    moved_[static_cast<std::size_t>(out.landmark)] = checks_[surface].contradiction;
    for (std::size_t s = 0; s < used_.size(); ++s) {
      if (scene_.surfaces()[s].landmark == out.landmark) {
        used_[s] = 0;
      }
    }
  }

  [[nodiscard]] double readings() const {
    return static_cast<double>(
        std::count_if(scan_.points.begin(), scan_.points.end(), [](const ScanPoint& p) { return p.point_camera.z() > 0.0F; }));
  }

  [[nodiscard]] std::vector<LandmarkContribution> contributions() const {
    std::vector<LandmarkContribution> all(scene_.ids().size());
    double agreeing = 0.0;
    for (std::size_t s = 0; s < checks_.size(); ++s) {
      LandmarkContribution& piece = all[static_cast<std::size_t>(scene_.surfaces()[s].landmark)];
      piece.pixels += checks_[s].pixels;
      piece.agreeing += checks_[s].agreeing;
      piece.contradiction = std::max(piece.contradiction, used_[s] != 0 ? checks_[s].contradiction : 0.0);
      agreeing += checks_[s].agreeing;
    }
    for (const int surface : dropped_) {
      const LandmarkSurface& part = scene_.surfaces()[static_cast<std::size_t>(surface)];
      all[static_cast<std::size_t>(part.landmark)].dropped_parts.push_back(part.part);
    }
    std::vector<LandmarkContribution> in_view;
    const double least = std::max(1.0, config_.min_share * readings());
    for (std::size_t i = 0; i < all.size(); ++i) {
      LandmarkContribution& piece = all[i];
      piece.id = scene_.ids()[i];
      if (moved_[i] > 0.0) {
        piece.verdict = LandmarkVerdict::kMoved;
        piece.contradiction = moved_[i];
      } else if (piece.agreeing >= least) {
        piece.verdict = piece.dropped_parts.empty() ? LandmarkVerdict::kUsed : LandmarkVerdict::kChanged;
      }
      piece.weight = agreeing > 0.0 ? piece.agreeing / agreeing : 0.0;
      if (piece.pixels >= least || moved_[i] > 0.0) {
        in_view.push_back(std::move(piece));
      }
    }
    return in_view;
  }

  [[nodiscard]] RefinementStatus judge(const Solution& solution) const {
    int agree = 0;
    int moved = 0;
    for (const LandmarkContribution& piece : contributions()) {
      agree += piece.verdict == LandmarkVerdict::kUsed || piece.verdict == LandmarkVerdict::kChanged ? 1 : 0;
      moved += piece.verdict == LandmarkVerdict::kMoved ? 1 : 0;
    }
    const bool contradicts = std::any_of(checks_.begin(), checks_.end(), [&](const SurfaceCheck& c) {
      return used_[static_cast<std::size_t>(&c - checks_.data())] != 0 && c.contradiction > 1.0;
    });
    if (agree < (only_ ? 1 : config_.min_landmarks)) {
      return moved > 0 ? RefinementStatus::kInconsistent : RefinementStatus::kTooFewLandmarks;
    }
    if (contradicts || moved >= agree || deviations(solution) > config_.max_deviations) {
      return RefinementStatus::kInconsistent;
    }
    const bool fits = solution.fit.status == AlignStatus::kConverged || solution.fit.status == AlignStatus::kDegenerate ||
                      solution.fit.status == AlignStatus::kIterationLimit;
    return fits ? RefinementStatus::kRefined : RefinementStatus::kNotConverged;
  }

  [[nodiscard]] StepMatrix priorCovariance() const {
    StepMatrix covariance = StepMatrix::Zero(3, 3);
    covariance.diagonal() << prior_.sigma_m * prior_.sigma_m, prior_.sigma_m * prior_.sigma_m, prior_.sigma_rad * prior_.sigma_rad;
    return covariance;
  }

  /// From the solution back to the prior: x, y, yaw about the robot's middle.
  [[nodiscard]] Step backToPrior(const Solution& solution) const {
    Step back(3);
    back.head<2>() = (prior_.T_map_camera * prior_.robot_camera - solution.T_map_camera * prior_.robot_camera).head<2>();
    const Eigen::Matrix3d R = prior_.T_map_camera.linear() * solution.T_map_camera.linear().transpose();
    back(2) = std::atan2(R(1, 0), R(0, 0));
    return back;
  }

  [[nodiscard]] double deviations(const Solution& solution) const {
    const Step back = backToPrior(solution);
    return std::sqrt(back.dot((solution.fit.covariance + priorCovariance()).ldlt().solve(back)));
  }

  /// The prior answers for what was not observed.
  void fuse(const Solution& solution, LandmarkRefinement& answer) const {
    const StepMatrix fit = solution.fit.covariance;
    const StepMatrix gain = fit * (fit + priorCovariance()).inverse();
    const Step step = gain * backToPrior(solution);
    CameraMotion motion(scene_.scene(), solution.T_map_camera, PoseFreedom::kPlanar, prior_.robot_camera);
    motion.apply(step);
    answer.T_map_camera = motion.T_map_camera();
    answer.covariance = covariance6(fit - gain * fit, answer.T_map_camera);
    answer.unobserved = solution.fit.unobserved;
    answer.moved_m = (answer.T_map_camera * prior_.robot_camera - prior_.T_map_camera * prior_.robot_camera).norm();
    answer.moved_rad = Eigen::AngleAxisd(prior_.T_map_camera.linear().transpose() * answer.T_map_camera.linear()).angle();
  }

  /// Of the right perturbation of T_map_camera, from x, y, yaw about the robot's middle along the axes of map.
  [[nodiscard]] geometry::Matrix6d covariance6(const StepMatrix& planar, const Eigen::Isometry3d& T_map_camera) const {
    const double tilt_rad = config_.upright_sigma_deg * kDegree;
    geometry::Matrix6d about_robot = geometry::Matrix6d::Zero();
    constexpr std::array<Eigen::Index, 3> kPlanarIndex = {0, 1, 5};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        about_robot(kPlanarIndex[i], kPlanarIndex[j]) = planar(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
    about_robot(2, 2) = config_.upright_sigma_m * config_.upright_sigma_m;
    about_robot(3, 3) = about_robot(4, 4) = tilt_rad * tilt_rad;
    const Eigen::Isometry3d T_map_robot(Eigen::Translation3d(T_map_camera * prior_.robot_camera));
    const geometry::Matrix6d A = geometry::adjoint(T_map_camera.inverse() * T_map_robot);
    return A * about_robot * A.transpose();
  }

  LandmarkScene& scene_;
  const Scan& scan_;
  const CameraPrior& prior_;
  const LandmarkConfig& config_;
  std::optional<int> only_;
  std::vector<char> used_;        ///< one a surface
  std::vector<double> moved_;     ///< one a landmark: the contradiction that it was left out for, or 0
  std::vector<int> dropped_;      ///< surfaces of pieces that stay
  std::vector<SurfaceCheck> checks_;
};

}  // namespace

std::vector<std::string> LandmarkConfig::validate() const {
  base::ConfigRules rules;
  rules.between("min_share", min_share, 0.0, 1.0)
      .atLeast("min_landmarks", min_landmarks, 1)
      .atLeast("max_rounds", max_rounds, 1)
      .greater("yaw_step_deg", yaw_step_deg, 0.0)
      .between("good_overlap", good_overlap, 0.0, 1.0)
      .greater("max_deviations", max_deviations, 0.0)
      .atLeast("upright_sigma_m", upright_sigma_m, 0.0)
      .atLeast("upright_sigma_deg", upright_sigma_deg, 0.0);
  return rules.messages();
}

LandmarkRefinement refineByLandmarks(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior, const LandmarkConfig& config,
                                     std::optional<int> only) {
  OIKOS_CHECK(!only || (*only >= 0 && *only < static_cast<int>(scene.ids().size())));
  return Refiner(scene, scan, prior, config, only).run();
}

}  // namespace oikos::registration
