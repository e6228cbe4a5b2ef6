// SPDX-License-Identifier: Apache-2.0
// Residuals of pixels about the base and the joints, summed up. Included by this folder's sources and tests only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "core/geometry/se3.h"
#include "registration/articulated/joint_tree.h"

namespace oikos::registration {

/// What became of the pixels that a link shows.
struct LinkCounts {
  int shown = 0;
  int read = 0;      ///< of these, with a reading
  int agreeing = 0;  ///< of these, within three deviations and facing as the link
  int nearer = 0;    ///< something stands before it
  int behind = 0;    ///< it is not there
};

/// The base's six freedoms, (translation, rotation) in map about the pivot; then of each link its joint's value, and the three coordinates
/// of the joint's place in map.
constexpr int kBaseSize = 6;
constexpr int kLinkSize = 4;
[[nodiscard]] constexpr int firstOf(int link) {
  return kBaseSize + kLinkSize * (link - 1);
}

/// One pixel's residual: of a reading before a plane of the model, or beside an outline of it.
struct PixelTerm {
  int link = 0;
  Eigen::Vector3d model_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_map = Eigen::Vector3d::Zero();
  double residual_m = 0.0;
  double weight = 0.0;    ///< 1/m^2
  double reading = 0.0;   ///< how much of a reading it is
  double height_m = 0.0;  ///< of the camera above the plane; of an outline 0: no distance moves it
  bool is_outline = false;
};

/// With n the normal, p the model's point, s the reading, and p moved by the columns v of what is free:
///   r(step) = n · (s - p) - n · v * step
class JointEquations {
 public:
  /// `axes`: by link, where the joints are believed to be now. `surface_sigma_m`: of each of the base's surfaces as a whole.
  JointEquations(const JointTree& tree, std::vector<JointAxis> axes, const Eigen::Vector3d& pivot_map, double surface_sigma_m);

  void add(const PixelTerm& term);
  /// Sums up the links that `counting` has (one entry a link). A link's readings count for `tempering` of what they are, and for so many
  /// at most: neighbours repeat each other, and so do the errors of model and sensor.
  void gather(double tempering, double most_readings, const std::vector<char>& counting);

  [[nodiscard]] const Eigen::Vector3d& pivot_map() const { return pivot_map_; }
  [[nodiscard]] const std::vector<JointAxis>& axes() const { return axes_; }
  /// What the base's surfaces, each off as a whole, do to g of the base: its covariance. After gather().
  [[nodiscard]] geometry::Matrix6d surfaces() const;

  /// How far (rad or m) the value of the link's joint is moved by distances that are wrong by a share of 1: of a slide, all alike; of a
  /// turn, in proportion to their distance from the axis, by 1 in the root mean square about the mean, as what is alike moves its place.
  [[nodiscard]] double distortionGain(int link) const;

  Eigen::MatrixXd H;               ///< sum of weight * J^T J
  Eigen::VectorXd g;               ///< sum of weight * J^T r: the step is -H^-1 g
  std::vector<LinkCounts> counts;  ///< by link
  double squares_m = 0.0;          ///< of the residuals of what agrees
  int agreeing = 0;

 private:
  /// A link's pixels speak about all that moves it.
  struct LinkSums {
    std::vector<int> indices;  ///< into the whole
    Eigen::MatrixXd H;         ///< lower triangle
    Eigen::VectorXd g;
    Eigen::VectorXd J;
    double readings = 0.0;
    // Over the planes of the link, weighted: 1, how far a step of the joint's value moves each point along its normal, and
    // the camera's height above it. Of the outlines, the second moment of that alone.
    double weight = 0.0;
    double reach = 0.0;
    double reach_sq = 0.0;
    double height_m = 0.0;
    double outline_reach_sq = 0.0;
  };
  static void addReach(const PixelTerm& term, double reach, LinkSums& sum);

  const JointTree& tree_;
  std::vector<JointAxis> axes_;
  Eigen::Vector3d pivot_map_;
  double surface_sigma_m_;
  std::vector<LinkSums> sums_;
  std::map<std::array<int, 4>, geometry::Vector6d> shifts_;  ///< by surface of the base: what its deviation does to g
  double base_share_ = 0.0;                                  ///< that the base's weights were taken with
};

}  // namespace oikos::registration
