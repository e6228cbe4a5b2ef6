// SPDX-License-Identifier: Apache-2.0
// Puts a piece of furniture together as it stands closed: everything is given in the model's frame and lands in its part's.
#pragma once

#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "core/model/finish.h"
#include "core/model/furniture/options.h"

namespace oikos::model {

struct Span {
  double low_m;
  double high_m;
};

[[nodiscard]] Eigen::AlignedBox3d boxOf(const Span& x, const Span& y, const Span& z);

/// A round rod between two points.
struct Rod {
  Eigen::Vector3d from_model;
  Eigen::Vector3d to_model;
  double radius_m;
};

/// A front that turns about one of its edges: the axis is that edge of its face (greatest x), so that the front, however far it is open,
/// stays before what was behind it and between its neighbours.
struct HingedFront {
  std::string name;
  Eigen::AlignedBox3d closed_model;
  HingeEdge hinge = HingeEdge::kLeft;
  double opening_rad = 1.9;
};

/// Any other turning joint.
struct Hinge {
  Eigen::Vector3d origin_model;
  Eigen::Vector3d axis_model;
  double opening_rad;
};

/// `centre_model` lies on the face that the handle stands on.
struct HandlePlace {
  std::string name;
  HandleStyle style = HandleStyle::kBarVertical;
  Eigen::Vector3d centre_model = Eigen::Vector3d::Zero();
  double length_m = 0.16;
};

/// Turned clockwise, as a person who stands before it sees it, from state 0 with its mark upwards.
struct KnobPlace {
  std::string name;
  Eigen::Vector3d centre_model = Eigen::Vector3d::Zero();  ///< on the panel
  double radius_m = 0.02;
  int state_count = 10;
  double range_rad = 4.7;  ///< from the first state to the last
};

constexpr double kBarStandOff_m = 0.03;  ///< from the face to the middle of a bar
constexpr double kBarRadius_m = 0.006;
constexpr double kKnobLength_m = 0.022;
constexpr double kRecessedProud_m = 0.001;

/// How far a handle stands out before the face.
[[nodiscard]] double handleReach(HandleStyle style);

/// Part 0 is the base; all others hang on it.
class FurnitureBuilder {
 public:
  explicit FurnitureBuilder(std::string name);

  void addBox(int part, const Eigen::AlignedBox3d& box_model, const Finish& finish);
  void addCushion(int part, const Eigen::AlignedBox3d& box_model, const Finish& finish);  ///< a box with round edges
  void addRod(int part, const Rod& rod, const Finish& finish);
  /// A shape that stands upright with its origin at `origin_model`.
  void addShape(int part, const TriangleMesh& shape, const Eigen::Vector3d& origin_model, const Finish& finish);
  void addShape(int part, const TriangleMesh& shape, const Eigen::Isometry3d& T_model_shape, const Finish& finish);

  [[nodiscard]] int addTurningPart(const std::string& name, const Hinge& hinge);
  [[nodiscard]] int addHingedPart(const HingedFront& front);
  [[nodiscard]] int addSlidingPart(const std::string& name, const Eigen::Vector3d& origin_model, double travel_m);  ///< along +x
  void addHandle(int part, const HandlePlace& place, const Finish& finish);
  /// A part of its own, with its joint, and its mark in the finish `mark`.
  void addKnob(const KnobPlace& place, const Finish& finish, const Finish& mark);
  /// Enters a handle whose shape is already there. Its frame: in the middle of the grip, x away from the face, z along the grip.
  void enterHandle(int part, const ModelHandle& handle_model);

  [[nodiscard]] ArticulatedModel build() const;

 private:
  int addPart(const std::string& name, const ModelJoint& joint);

  ArticulatedModel model_;
  std::vector<TriangleMesh> meshes_part_;
  std::vector<Eigen::Vector3d> origins_model_;  ///< of each part; all stand upright
};

}  // namespace oikos::model
