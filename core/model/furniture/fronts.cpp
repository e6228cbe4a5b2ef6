// SPDX-License-Identifier: Apache-2.0
#include "core/model/furniture/fronts.h"

#include <algorithm>
#include <cmath>

namespace oikos::model {

namespace {

/// Half of what the handle covers of the front, in y and z.
Eigen::Vector2d handleHalf(const HandleRule& rule) {
  if (rule.style == HandleStyle::kNone) {
    return Eigen::Vector2d::Zero();
  }
  const double thin_m = rule.style == HandleStyle::kRecessed || rule.style == HandleStyle::kKnob ? 0.015 : kBarRadius_m;
  const double long_m = rule.style == HandleStyle::kKnob ? thin_m : rule.length_m / 2.0;
  return rule.style == HandleStyle::kBarVertical ? Eigen::Vector2d(thin_m, long_m) : Eigen::Vector2d(long_m, thin_m);
}

/// From the low to the high end, kept clear of both.
double along(double low, double high, double half_m, const HandleRule& rule) {
  const double margin_m = std::min(0.03, (high - low) / 2.0 - half_m);
  return low + margin_m + half_m + rule.level * (high - low - 2.0 * (margin_m + half_m));
}

}  // namespace

HandlePlace placeHandle(const HingedFront& front, const HandleRule& rule) {
  const Eigen::Vector3d low = front.closed_model.min();
  const Eigen::Vector3d high = front.closed_model.max();
  const Eigen::Vector2d half = handleHalf(rule);
  Eigen::Vector3d centre(high.x(), 0.0, 0.0);
  if (front.hinge == HingeEdge::kLeft || front.hinge == HingeEdge::kRight) {
    const bool across = rule.style == HandleStyle::kBarHorizontal || rule.style == HandleStyle::kRecessed;
    const double inset_m = rule.offset_m + (across ? half.x() : 0.0);
    centre.y() = front.hinge == HingeEdge::kLeft ? high.y() - inset_m : low.y() + inset_m;
    centre.z() = along(low.z(), high.z(), half.y(), rule);
  } else {
    const double inset_m = rule.offset_m + (rule.style == HandleStyle::kBarVertical ? half.y() : 0.0);
    centre.z() = front.hinge == HingeEdge::kBottom ? high.z() - inset_m : low.z() + inset_m;
    centre.y() = along(low.y(), high.y(), half.x(), rule);
  }
  return {.name = front.name + "_handle", .style = rule.style, .centre_model = centre, .length_m = rule.length_m};
}

bool handleFits(const HingedFront& front, const HandleRule& rule) {
  if (rule.style == HandleStyle::kNone) {
    return true;
  }
  const Eigen::Vector2d centre = placeHandle(front, rule).centre_model.tail<2>();
  const Eigen::Vector2d half = handleHalf(rule);
  const Eigen::AlignedBox2d face(front.closed_model.min().tail<2>(), front.closed_model.max().tail<2>());
  return face.contains(Eigen::AlignedBox2d((centre - half).eval(), (centre + half).eval()));
}

double turningRoom(const HingedFront& front) {
  const Eigen::Vector3d size = front.closed_model.sizes();
  const bool upright = front.hinge == HingeEdge::kLeft || front.hinge == HingeEdge::kRight;
  const double length_m = upright ? size.y() : size.z();
  return std::hypot(length_m, size.x()) - length_m;
}

int addBoardDoor(FurnitureBuilder& builder, const HingedFront& front, const HandleRule& rule, const Finish& front_finish,
                 const Finish& handle_finish) {
  const int part = builder.addHingedPart(front);
  builder.addBox(part, front.closed_model, front_finish);
  builder.addHandle(part, placeHandle(front, rule), handle_finish);
  return part;
}

Eigen::AlignedBox3d shrunk(const Eigen::AlignedBox3d& front_model, double margin_m) {
  const Eigen::Vector3d margin(0.0, margin_m, margin_m);
  return {front_model.min() + margin, front_model.max() - margin};
}

}  // namespace oikos::model
