// SPDX-License-Identifier: Apache-2.0
// Where the handles of a door or drawer are, after the part was registered (5.2.1.1 of paper 003, S236-S240).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_table.h"
#include "core/geometry/se3.h"
#include "core/model/articulated_model.h"
#include "registration/handles/depth_view.h"
#include "registration/handles/front_face.h"
#include "registration/handles/front_plane.h"
#include "registration/handles/grip_config.h"
#include "registration/handles/grip_evidence.h"
#include "registration/handles/grip_readings.h"

namespace oikos::registration {

/// All but the first two: the place is the prior's, on the front as far as that was seen.
enum class HandleStatus {
  kFound,
  kPartly,        ///< what the readings do not tell of its place, being hidden or missing, is the prior's (S240)
  kNotSeen,       ///< its front is seen, and nothing stands out there
  kTooFewPoints,  ///< it is in view, but hardly anything was read there
  kHidden,        ///< something stands before it
  kRecessed,      ///< it does not stand out, so there is nothing to be seen of it
  kNotInView,     ///< it lies outside the image, or its front faces away
  kNoFront,       ///< no plane is where its front should be
};
constexpr auto enumTable(HandleStatus) {
  return std::to_array<base::EnumName<HandleStatus>>({{HandleStatus::kFound, "found"},
                                                      {HandleStatus::kPartly, "partly found"},
                                                      {HandleStatus::kNotSeen, "not seen"},
                                                      {HandleStatus::kTooFewPoints, "too few points"},
                                                      {HandleStatus::kHidden, "hidden"},
                                                      {HandleStatus::kRecessed, "recessed"},
                                                      {HandleStatus::kNotInView, "not in view"},
                                                      {HandleStatus::kNoFront, "no front"}});
}

struct HandleConfig {
  FrontPlaneConfig front;
  GripConfig grip;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("front", front);
    visitor("grip", grip);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Of one image.
struct HandleEstimate {
  int handle = 0;    ///< index in the model
  std::string name;  ///< the handle's
  HandleStatus status = HandleStatus::kNoFront;
  Eigen::Isometry3d T_part_handle = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_map_handle = Eigen::Isometry3d::Identity();  ///< x is the front's normal
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< of the right perturbation (m, rad); where it is not seen: the prior's
  geometry::Matrix6d shared =
      geometry::Matrix6d::Zero();  ///< the part of it that is the same in every image: what is the prior's (diagonal)
  double length_m = 0.0;           ///< along z of the handle: of a bar; a knob's diameter. Where it is not seen: the prior's
  double length_sigma_m = 0.0;
  double gain = 0.0;      ///< log likelihood of the handle over that of a bare front
  int points = 0;         ///< readings that show it
  GripEvidence evidence;  ///< for the fusion of many images
  int front_points = 0;   ///< readings of its front, of those that were looked at

  [[nodiscard]] bool isSeen() const { return status == HandleStatus::kFound || status == HandleStatus::kPartly; }
};

/// Finds the handles of a model's parts. Immutable, so thread-safe.
class HandleFinder {
 public:
  /// Throws Error{kInput} for a handle of a part that the model has not; ContractViolation if `config` is not valid.
  HandleFinder(const model::ArticulatedModel& model, const HandleConfig& config);

  /// The handles of one part, in the model's order. `T_map_part`: as registered. Where the camera truly is and the part's own place are not
  /// in doubt here: the covariance is that of the handle before this camera, and its deviations from `T_part_handle` those of the model's.
  [[nodiscard]] std::vector<HandleEstimate> find(const DepthView& view, int part, const Eigen::Isometry3d& T_map_part) const;

 private:
  void findOn(const FrontFace& face, const DepthView& view, const Eigen::Isometry3d& T_map_part, std::vector<HandleEstimate>& found) const;
  [[nodiscard]] HandleEstimate believed(int handle, const Eigen::Isometry3d& T_map_part) const;

  HandleConfig config_;
  std::vector<model::ModelHandle> handles_;
  std::vector<FrontFace> faces_;
  std::vector<GripBelief> beliefs_;  ///< by handle
};

}  // namespace oikos::registration
