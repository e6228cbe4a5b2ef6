// SPDX-License-Identifier: Apache-2.0
// Base and joints brought onto a scan, one after the other or all together. Included by this folder's sources and tests only.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/geometry/se3.h"
#include "registration/articulated/joint_equations.h"
#include "registration/articulated/joint_profile.h"
#include "registration/articulated/joint_tree.h"
#include "registration/articulated/link_layers.h"
#include "registration/articulated/pixel_mixture.h"
#include "registration/edge_pairs.h"
#include "registration/scan.h"

namespace oikos::registration {

struct JointSolverConfig {
  double base_sigma_m = 0.015;     ///< of where the base is believed to stand, in x and in y,
  double base_sigma_deg = 1.0;     ///< and of its yaw
  double upright_sigma_m = 0.005;  ///< of its height before the camera,
  double upright_sigma_deg = 0.3;  ///< and of its tilt
  double axis_sigma_m = 0.004;     ///< of a joint's origin in each direction, what it carries included
  double axis_sigma_deg = 0.5;     ///< and of its direction
  double surface_sigma_m = 0.005;  ///< of the base's surfaces, each as a whole
  double wide_sigma_m = 0.025;     ///< of surfaces, in the first round
  double depth_distortion = 0.0;   ///< of distances, smoothly over the picture: share that no correction has taken away
  double tempering = 0.2;          ///< of a reading's information: its neighbours repeat it
  double most_readings = 150.0;    ///< that a link counts for, whatever it shows
  int rounds = 3;                  ///< pictures that are taken, each followed by a step

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("base_sigma_m", base_sigma_m);
    visitor("base_sigma_deg", base_sigma_deg);
    visitor("upright_sigma_m", upright_sigma_m);
    visitor("upright_sigma_deg", upright_sigma_deg);
    visitor("axis_sigma_m", axis_sigma_m);
    visitor("axis_sigma_deg", axis_sigma_deg);
    visitor("surface_sigma_m", surface_sigma_m);
    visitor("wide_sigma_m", wide_sigma_m);
    visitor("depth_distortion", depth_distortion);
    visitor("tempering", tempering);
    visitor("most_readings", most_readings);
    visitor("rounds", rounds);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// The estimate in progress.
struct JointEstimates {
  Standing standing;
  std::vector<Eigen::Vector3d> shift_map;  ///< by link: where its joint is, from where the model has it
};

struct SolverReport {
  geometry::Matrix6d base_covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation of T_map_model (m, rad)
  std::vector<double> variances;                                    ///< by link: of its joint's value (rad^2 or m^2); the base's is 0
  std::vector<double> shared_variances;                             ///< of these, what another frame would not change: axis, distortion
  std::vector<LinkCounts> counts;                                   ///< by link
  std::vector<double> off_prior;                                    ///< by link: of the base and of the joints that move it, from where
                                                                    ///< they are believed; a sum of squared deviations
  double rms_m = 0.0;                                               ///< of what agrees, from the surfaces
};

/// Of a base that nothing is seen of, about its own origin.
[[nodiscard]] geometry::Matrix6d priorCovariance(const JointSolverConfig& config);

/// Gauss-Newton on point-to-plane distances and outlines, each pixel weighted with how likely it shows what the model has there
/// (PixelMixture). Beside the base (six freedoms, held by their prior) and the joints' values (held by their limits), the place of each
/// joint is a little in doubt: a door that stands out evenly by some millimetres is no door that is ajar. Not thread-safe.
class JointSolver {
 public:
  /// All arguments but the poses are kept by reference.
  JointSolver(const JointTree& tree, WholeModel& model, const Scan& scan, const PixelMixture& mixture, const JointSolverConfig& config,
              const Eigen::Isometry3d& T_map_camera, const Eigen::Isometry3d& T_map_prior);

  struct Freedom {
    bool base = false;
    std::vector<int> links;  ///< whose joints may move
  };
  /// Returns how many steps were taken.
  int solve(JointEstimates& estimates, const Freedom& freedom);
  /// Uncertainty and counts where `estimates` stand, base and all joints being free.
  [[nodiscard]] SolverReport report(const JointEstimates& estimates, const Freedom& freedom);

 private:
  [[nodiscard]] std::vector<Eigen::Isometry3d> T_map_part(const JointEstimates& estimates) const;
  [[nodiscard]] std::vector<JointAxis> axesOf(const JointEstimates& estimates) const;
  [[nodiscard]] JointEquations look(const JointEstimates& estimates, const Freedom& freedom, double width_m);
  [[nodiscard]] std::vector<char> countingLinks(const Freedom& freedom) const;
  [[nodiscard]] geometry::Vector6d baseOff(const JointEstimates& estimates) const;
  [[nodiscard]] std::vector<double> offPrior(const JointEstimates& estimates) const;
  void addPriors(const JointEstimates& estimates, JointEquations& equations) const;
  [[nodiscard]] Eigen::VectorXd stepOf(const JointEquations& equations, const JointEstimates& estimates, const Freedom& freedom) const;
  void apply(const Eigen::VectorXd& step, JointEstimates& estimates) const;
  [[nodiscard]] std::vector<int> freeIndices(const Freedom& freedom) const;

  const JointTree& tree_;
  WholeModel& model_;
  const Scan& scan_;
  const PixelMixture& mixture_;
  const JointSolverConfig& config_;
  Eigen::Isometry3d T_map_camera_;
  Eigen::Isometry3d T_map_prior_;
  Eigen::Vector3d pivot_model_;
  ScanEdges edges_;
};

}  // namespace oikos::registration
