// SPDX-License-Identifier: Apache-2.0
// What many images say about one handle.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/geometry/se3.h"
#include "registration/handles/handle_finder.h"

namespace oikos::registration {

struct HandleFusionConfig {
  double freedom = 4.0;    ///< of Student's distribution: the smaller, the less an image that differs counts
  double repeated = 0.1;   ///< share of what an image says that the others repeat: their registration, the same noise
  double min_gain = 15.0;  ///< log likelihood, over that of a bare front, of a handle that all images together show but few by themselves
  double min_seen = 0.5;   ///< of the images that looked at it, those that have to have found it, else all are taken together
  double most_apart_m = 0.01;    ///< half of what two halves of them may differ by then
  double place_sigma_m = 0.012;  ///< of the belief, for that
  double max_height_m = 0.1;     ///< that anything may stand out
  double outlier = 0.3;          ///< images that weigh less than this, beside one that is off by its deviations, are counted as outliers

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("freedom", freedom);
    visitor("repeated", repeated);
    visitor("min_gain", min_gain);
    visitor("min_seen", min_seen);
    visitor("most_apart_m", most_apart_m);
    visitor("place_sigma_m", place_sigma_m);
    visitor("max_height_m", max_height_m);
    visitor("outlier", outlier);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct FusedHandle {
  HandleStatus status = HandleStatus::kNotInView;  ///< found, partly found, or what most images say
  Eigen::Isometry3d T_part_handle = Eigen::Isometry3d::Identity();
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad)
  double length_m = 0.0;
  int images = 0;          ///< all
  int seen = 0;            ///< in which it was found, wholly or partly
  int outliers = 0;        ///< of these, far from the others
  bool is_summed = false;  ///< from the sum of what all images say, not from the single images' handles
  double gain = 0.0;       ///< then: log likelihood of the handle over that of a bare front
  /// Root mean square of the seen images' places about the fused one, outliers left out. Summed: half the distance between what the first,
  /// third, … image say and what the second, fourth, … do.
  double spread_m = 0.0;
  double spread_deg = 0.0;  ///< the same of their rotations
};

/// One handle over the images of a recording, on its part, which may move meanwhile: the images' estimates weighted with their covariances,
/// those far from the rest less, and none more than
/// they agree (Student's t by iterated weights; Lange, Little & Taylor 1989, doi:10.2307/2290063). Not thread-safe.
class HandleFusion {
 public:
  /// Throws ContractViolation if `config` is not valid.
  explicit HandleFusion(const HandleFusionConfig& config);

  /// Throws ContractViolation for another handle than the first one's.
  void add(const HandleEstimate& estimate);
  /// Of no image: status not in view.
  [[nodiscard]] FusedHandle result() const;

 private:
  void fuseSeen(const std::vector<const HandleEstimate*>& seen, FusedHandle& result) const;
  void sumUp(const std::vector<const HandleEstimate*>& looked, FusedHandle& result) const;

  HandleFusionConfig config_;
  std::vector<HandleEstimate> estimates_;
};

}  // namespace oikos::registration
