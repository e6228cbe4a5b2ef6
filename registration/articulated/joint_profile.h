// SPDX-License-Identifier: Apache-2.0
// How well each value of a joint explains a depth image. Included by this folder's sources and tests only.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "registration/articulated/joint_tree.h"
#include "registration/articulated/link_layers.h"
#include "registration/articulated/pixel_mixture.h"
#include "registration/articulated/surroundings.h"
#include "registration/scan.h"

namespace oikos::registration {

/// How a model stands.
struct Standing {
  Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
  std::vector<double> joint_values;  ///< one a joint of the model
};

/// What one value of a joint does with the readings.
struct ValueScore {
  double log_likelihood = 0.0;  ///< over that of the model without the link, summed over pixels
  int pixels = 0;               ///< of the scan, with a reading, that the link covers
  int agreeing = 0;             ///< of these, readings of its surface
  int behind = 0;               ///< of these, readings behind it
};

/// Scores values of joints by rendering the link that moves and comparing it, pixel by pixel, with what is there without it. Not
/// thread-safe.
class JointProfiler {
 public:
  /// Tree, layers, scan and mixture are kept by reference. `surroundings`: of the scan's size, or empty.
  JointProfiler(const JointTree& tree, LinkLayers& layers, const Scan& scan, const Eigen::Isometry3d& T_map_camera,
                const PixelMixture& mixture, const Surroundings& surroundings = {});

  enum class Others { kBaseOnly, kAll };
  /// Where the model stands meanwhile, and which other links are believed to be there.
  /// `sigma_m`: of surfaces from where the model has them, whatever it comes from.
  void stand(const Standing& standing, Others others, double sigma_m);

  /// The link to be scored next.
  void choose(int link);
  /// `shift_map`: of its joint from where the model has it.
  [[nodiscard]] ValueScore score(double value, const Eigen::Vector3d& shift_map = Eigen::Vector3d::Zero()) const;

 private:
  struct Rest {
    double depth_m = std::numeric_limits<double>::infinity();
    double log_density = 0.0;
  };
  [[nodiscard]] double logOf(std::size_t pixel, double depth_m, const Eigen::Vector3d& normal_camera, int link,
                             const Eigen::Isometry3d& T_link_camera, ModelledPixel* surface = nullptr) const;
  [[nodiscard]] Eigen::Isometry3d T_camera_link(int link) const;
  void explainBy(const Surroundings& surroundings);

  const JointTree& tree_;
  LinkLayers& layers_;
  const Scan& scan_;
  Eigen::Isometry3d T_camera_map_;
  const PixelMixture& mixture_;
  Standing standing_;
  double sigma_m_ = 0.0;
  std::vector<Eigen::Isometry3d> T_model_part_;
  std::vector<WindowView> views_;  ///< by link, each without what hangs on it; empty ones are not there
  int link_ = 0;
  std::vector<Rest> about_;  ///< by pixel, the surroundings; empty: nothing is known of them
  std::vector<Rest> rest_;   ///< by pixel, without the chosen link
};

}  // namespace oikos::registration
