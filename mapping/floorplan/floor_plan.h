// SPDX-License-Identifier: Apache-2.0
// A home's walls as a drawing has them, seen from above.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace oikos::mapping {

/// A straight piece of a wall's surface, or of its middle if the drawing has no thickness. Frame `plan`: that of the drawing, metres, y up.
struct PlanLine {
  Eigen::Vector2d from_plan = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_plan = Eigen::Vector2d::Zero();
  Eigen::Vector2d inwards = Eigen::Vector2d::Zero();  ///< unit length, into the room; zero: not known, either side may be seen
  bool is_wall = true;                                ///< or the side of a fixed piece of furniture: it may be hidden, and hides
  int room = 0;                                       ///< lines with the same number are drawn together

  [[nodiscard]] double lengthM() const { return (to_plan - from_plan).norm(); }
};

struct FloorPlan {
  std::vector<PlanLine> lines;
};

/// Numbers the rooms of a drawing, whose lines say nothing of them: lines that touch belong together.
void numberRooms(FloorPlan& plan);

/// Adds the sides of a room's outline, either way round; seen from inside. Sides shorter than a millimetre are left out.
void addRoom(const std::vector<Eigen::Vector2d>& outline_plan, FloorPlan& plan);

/// Adds the sides of something that stands in the home and stays; seen from outside.
void addFixture(const std::vector<Eigen::Vector2d>& outline_plan, FloorPlan& plan);

}  // namespace oikos::mapping
