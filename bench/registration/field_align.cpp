// SPDX-License-Identifier: Apache-2.0
// Schmidt, Newcombe & Fox, "DART: Dense Articulated Real-Time Tracking" (RSS 2014). Differs: a field for each way that a surface can
// face, so that a thin board's other side and the inside of a cupboard draw nothing; what the camera cannot see is left out by a picture
// of the model before the coarse steps and one after them; only the scan's points have residuals.
#include "bench/registration/field_align.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "registration/motion.h"
#include "registration/pairs.h"

namespace oikos::bench {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLongestStep = 0.15;  ///< m, and rad
constexpr double kNearStep = 0.01;     ///< and shorter: the planes stay those that were looked up
constexpr double kWithinAPixel = 0.002;
constexpr double kSmallStep = 2e-4;
constexpr int kStepsOfALook = 3;
constexpr std::size_t kFewest = 6;
constexpr float kMinIncidenceCos = 0.17F;  ///< readings at a more grazing angle are hardly any

/// r = normal · (point - foot); J = -(n_x, n_y, (arm × n)_z) of a step of the model: x, y, yaw, arm being the foot about the pivot.
struct Residual {
  Eigen::Vector3f point_camera;
  Eigen::Vector3f normal_model;
  Eigen::Vector3f foot_model;
  double sigma_sq = 0.0;
};

struct PlanarEquations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d H_of_noise = Eigen::Matrix3d::Zero();  ///< what turned normals alone would make
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  int inliers = 0;
};

class FieldAligner {
 public:
  FieldAligner(const FieldModel& fields, const FieldStart& start, const registration::AlignConfig& config)
      : fields_(fields), start_(start), config_(config) {
    found_.T_map_model = start.T_map_model;
  }

  void runLevel(const registration::Scan& scan, int iterations, double first_gate_m, double last_gate_m) {
    const int gate_steps = first_gate_m > last_gate_m ? 5 : 0;
    min_observability_ = gate_steps > 0 ? 1.0 : config_.min_observability;
    gather(scan, first_gate_m + 0.05);
    bool is_settled = false;
    for (int i = 0; i < iterations && !(is_settled && i > gate_steps); ++i) {
      const double shrink = std::min(1.0, static_cast<double>(i) / std::max(1, gate_steps));
      gate_m_ = first_gate_m * std::pow(last_gate_m / first_gate_m, shrink);
      lookUp();
      double step = takeStep();
      const bool is_within_a_pixel = step < kWithinAPixel;
      for (int k = 0; k < kStepsOfALook && step >= kSmallStep && step < kNearStep; ++k) {
        step = takeStep();
      }
      is_settled = is_within_a_pixel && step < kSmallStep;
      ++found_.lookups;
    }
  }

  void lookAtModel(const camera::PinholeCamera& camera) {
    start_.scene.move(start_.piece, found_.T_map_model, start_.joint_values);
    start_.scene.commit();
    sight_ = FieldSight(start_.scene, camera, start_.T_map_camera, found_.T_map_model);
  }

  [[nodiscard]] const FieldAlignment& found() const { return found_; }

 private:
  [[nodiscard]] Eigen::Isometry3f T_model_camera() const { return (found_.T_map_model.inverse() * start_.T_map_camera).cast<float>(); }

  /// The points about the model as it stands.
  void gather(const registration::Scan& scan, double room_m) {
    const Eigen::Isometry3f T_model_scan = T_model_camera();
    const Eigen::Vector3d room = Eigen::Vector3d::Constant(room_m);
    const Eigen::AlignedBox3f box = Eigen::AlignedBox3d(fields_.box_model().min() - room, fields_.box_model().max() + room).cast<float>();
    points_.clear();
    for (const registration::ScanPoint& point : scan.points) {
      if (point.point_camera.z() > 0.0F && !point.normal_camera.isZero() && box.contains(T_model_scan * point.point_camera)) {
        points_.push_back(point);
      }
    }
  }

  void lookUp() {
    const Eigen::Isometry3f T_model_scan = T_model_camera();
    const Eigen::Vector3f eye_model = T_model_scan.translation();
    const FieldModel::Rules rules{gate_m_, std::cos(config_.max_normal_deg * kDegree)};
    residuals_.clear();
    FieldMatch match;
    for (const registration::ScanPoint& point : points_) {
      const Eigen::Vector3f point_model = T_model_scan * point.point_camera;
      if (!fields_.find(point_model, T_model_scan.linear() * point.normal_camera, sight_, rules, match)) {
        continue;
      }
      const float along = match.normal_model.dot((point_model - eye_model).normalized());
      if (-along >= kMinIncidenceCos) {
        const double reading_m = registration::residualSigma_m(static_cast<double>(point.point_camera.z()), static_cast<double>(along));
        residuals_.push_back({point.point_camera, match.normal_model, match.footOf(point_model),
                              reading_m * reading_m + config_.surface_sigma_m * config_.surface_sigma_m});
      }
    }
  }

  [[nodiscard]] PlanarEquations sumUp() const {
    const Eigen::Isometry3f T_model_scan = T_model_camera();
    const Eigen::Matrix3f R_map_model = found_.T_map_model.linear().cast<float>();
    const Eigen::Vector3f pivot_model = fields_.box_model().center().cast<float>();
    const double normal_sigma_rad = config_.normal_sigma_deg * kDegree;
    const double gate_kernel_sq = gate_m_ * gate_m_ / 9.0;
    PlanarEquations sum;
    for (const Residual& residual : residuals_) {
      const auto r = static_cast<double>(residual.normal_model.dot(T_model_scan * residual.point_camera - residual.foot_model));
      const double kernel_sq = std::max(9.0 * residual.sigma_sq, gate_kernel_sq);
      const double share = 1.0 / (1.0 + r * r / kernel_sq);
      const double weight = share * share / residual.sigma_sq;
      const Eigen::Vector3d n = (R_map_model * residual.normal_model).cast<double>();
      const Eigen::Vector3d arm = (R_map_model * (residual.foot_model - pivot_model)).cast<double>();
      const Eigen::Vector3d J(-n.x(), -n.y(), arm.y() * n.x() - arm.x() * n.y());
      Eigen::Matrix3d speeds_sq;  // of the foot
      speeds_sq << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x(), -arm.y(), arm.x(), arm.head<2>().squaredNorm();
      const Eigen::Matrix3d JtJ = J * J.transpose();
      sum.H += weight * JtJ;
      sum.H_of_noise += weight * normal_sigma_rad * normal_sigma_rad * (speeds_sq - JtJ);
      sum.g += weight * r * J;
      sum.inliers += r * r < kernel_sq ? 1 : 0;
    }
    return sum;
  }

  /// Along what is observed. Returns the step's length (m or rad).
  double takeStep() {
    const PlanarEquations sum = sumUp();
    found_.inliers = sum.inliers;
    if (residuals_.size() < kFewest) {
      return 0.0;
    }
    const double floor = 1e-9 * (sum.H_of_noise.trace() + sum.H.trace()) / 3.0 + 1e-12;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum.H, sum.H_of_noise + floor * Eigen::Matrix3d::Identity());
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      if (eigen.eigenvalues()[i] >= min_observability_) {
        const Eigen::Vector3d v = eigen.eigenvectors().col(i);
        step -= v * (v.dot(sum.g) / eigen.eigenvalues()[i]);
      }
    }
    const double length = step.cwiseAbs().maxCoeff();
    step *= std::min(1.0, kLongestStep / std::max(length, kSmallStep));
    Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
    twist.head<2>() = step.head<2>();
    twist[5] = step.z();
    found_.T_map_model = registration::motionAbout(found_.T_map_model * fields_.box_model().center(), twist) * found_.T_map_model;
    return length;
  }

  const FieldModel& fields_;
  const FieldStart& start_;
  const registration::AlignConfig& config_;
  FieldSight sight_;
  std::vector<registration::ScanPoint> points_;
  std::vector<Residual> residuals_;
  double gate_m_ = 0.0;
  double min_observability_ = 0.0;
  FieldAlignment found_;
};

}  // namespace

FieldAlignment alignOnFields(const FieldModel& fields, const FieldStart& start, const registration::Scan& scan,
                             const registration::AlignConfig& config) {
  FieldAligner aligner(fields, start, config);
  const int thinning = std::max(1, (scan.camera.width + config.coarse_columns - 1) / config.coarse_columns);
  const camera::PinholeCamera camera = registration::thinned(scan.camera, thinning);
  aligner.lookAtModel(camera);
  aligner.runLevel(registration::thinned(scan, thinning), config.coarse_iterations, config.coarse_gate_m, config.fine_gate_m);
  aligner.lookAtModel(camera);
  for (int between = thinning / 2; between > 1; between /= 2) {
    aligner.runLevel(registration::thinned(scan, between), config.fine_iterations, config.fine_gate_m, config.fine_gate_m);
  }
  aligner.runLevel(scan, config.fine_iterations, config.fine_gate_m, config.fine_gate_m);
  return aligner.found();
}

}  // namespace oikos::bench
