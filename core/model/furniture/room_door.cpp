// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/room_door.h"

#include "core/base/error.h"
#include "core/model/furniture/builder.h"
#include "core/model/furniture/fronts.h"
#include "core/model/shape_rules.h"

namespace oikos::model {

namespace {

constexpr double kStop_m = 0.012;  ///< how far the strip that the leaf closes against reaches in, and how thick it is
constexpr double kLeverStandOff_m = 0.05;
constexpr double kLeverRadius_m = 0.009;
constexpr double kRose_m = 0.008;

HingedFront planLeaf(const RoomDoorShape& shape) {
  const double face = shape.depth_m / 2.0;
  const double half_m = shape.width_m / 2.0 - shape.jamb_m - shape.door_gap_m;
  return {.name = "door",
          .closed_model =
              boxOf({face - shape.leaf_m, face}, {-half_m, half_m}, {shape.floor_gap_m, shape.height_m - shape.jamb_m - shape.door_gap_m}),
          .hinge = shape.hinge,
          .opening_rad = shape.door_opening_rad};
}

void addFrame(FurnitureBuilder& builder, const RoomDoorShape& shape) {
  const Finish finish = {"frame", shape.frame_rgb};
  const double face = shape.depth_m / 2.0;
  const double outer = shape.width_m / 2.0;
  const double inner = outer - shape.jamb_m;
  const double lintel = shape.height_m - shape.jamb_m;
  const Span depth = {-face, face};
  builder.addBox(0, boxOf(depth, {-outer, -inner}, {0.0, shape.height_m}), finish);
  builder.addBox(0, boxOf(depth, {inner, outer}, {0.0, shape.height_m}), finish);
  builder.addBox(0, boxOf(depth, {-inner, inner}, {lintel, shape.height_m}), finish);
  const double behind = face - shape.leaf_m - 0.001;
  const Span stop = {behind - kStop_m, behind};
  builder.addBox(0, boxOf(stop, {-inner, -inner + kStop_m}, {0.0, lintel}), finish);
  builder.addBox(0, boxOf(stop, {inner - kStop_m, inner}, {0.0, lintel}), finish);
  builder.addBox(0, boxOf(stop, {-inner + kStop_m, inner - kStop_m}, {lintel - kStop_m, lintel}), finish);
}

/// `outward` is 1 on the front, -1 on the back; the grip reaches from the spindle towards the hinge.
void addLever(FurnitureBuilder& builder, int part, const RoomDoorShape& shape, double outward) {
  const Finish finish = {"handle", shape.handle_rgb};
  const Eigen::AlignedBox3d leaf = planLeaf(shape).closed_model;
  const double to_hinge = shape.hinge == HingeEdge::kLeft ? -1.0 : 1.0;
  const double edge = shape.hinge == HingeEdge::kLeft ? leaf.max().y() : leaf.min().y();
  const Eigen::Vector3d out = Eigen::Vector3d::UnitX() * outward;
  const Eigen::Vector3d along = Eigen::Vector3d::UnitY() * to_hinge;
  const Eigen::Vector3d spindle(outward > 0.0 ? leaf.max().x() : leaf.min().x(), edge + to_hinge * shape.lever_offset_m,
                                shape.lever_height_m);
  const Eigen::Vector3d elbow = spindle + out * kLeverStandOff_m;
  builder.addRod(part, {spindle, spindle + out * kRose_m, 0.026}, finish);
  builder.addRod(part, {spindle + out * kRose_m, elbow + out * kLeverRadius_m, kLeverRadius_m}, finish);
  builder.addRod(part, {elbow, elbow + along * shape.lever_length_m, kLeverRadius_m}, finish);
  ModelHandle handle{.name = outward > 0.0 ? "front_lever" : "back_lever", .part = part, .length_m = shape.lever_length_m};
  handle.T_part_handle.translation() = elbow + along * shape.lever_length_m / 2.0;
  handle.T_part_handle.linear() << out, along.cross(out), along;
  builder.enterHandle(part, handle);
}

}  // namespace

std::vector<std::string> RoomDoorShape::validate() const {
  ShapeRules rules("furniture");
  rules.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("jamb_m", jamb_m);
  rules.length("leaf_m", leaf_m).length("lever_length_m", lever_length_m).between("lever_height_m", lever_height_m, 0.1, 10.0);
  rules.between("door_gap_m", door_gap_m, 0.0, 0.1).between("floor_gap_m", floor_gap_m, 0.0, 0.1);
  rules.angle("door_opening_deg", door_opening_rad, 5.0, 183.0).between("lever_offset_m", lever_offset_m, 0.03, 1.0);
  rules.require(hinge == HingeEdge::kLeft || hinge == HingeEdge::kRight, "hinge", hinge, "must be left or right");
  rules.color("frame_rgb", frame_rgb).color("front_rgb", front_rgb).color("handle_rgb", handle_rgb);
  if (!rules.messages().empty()) {
    return rules.messages();
  }
  const Eigen::Vector3d leaf = planLeaf(*this).closed_model.sizes();
  rules.require(leaf.y() > lever_offset_m + lever_length_m, "width_m", width_m, "must leave a leaf that is wider than its lever");
  rules.require(lever_height_m < height_m - jamb_m - 0.05, "lever_height_m", lever_height_m, "must be below the lintel");
  rules.require(leaf_m + 2.0 * kStop_m < depth_m, "leaf_m", leaf_m, "must leave room for the stop in the frame's depth");
  rules.require(turningRoom(planLeaf(*this)) <= door_gap_m, "door_gap_m", door_gap_m,
                "must let the leaf turn past the jamb: larger, or leaf_m less");
  return rules.messages();
}

ArticulatedModel makeRoomDoor(const RoomDoorShape& shape) {
  OIKOS_CHECK(shape.validate().empty());
  FurnitureBuilder builder("room_door");
  addFrame(builder, shape);
  const HingedFront leaf = planLeaf(shape);
  const int part = builder.addHingedPart(leaf);
  builder.addBox(part, leaf.closed_model, {"front", shape.front_rgb});
  addLever(builder, part, shape, 1.0);
  addLever(builder, part, shape, -1.0);
  return builder.build();
}

}  // namespace oikos::model
