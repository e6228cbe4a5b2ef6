// SPDX-License-Identifier: Apache-2.0
// Fridges, cookers and dishwashers. Depths are from the back to the face of the closed door, without handles and knobs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/degrees.h"
#include "core/model/articulated_model.h"
#include "core/model/furniture/options.h"

namespace oikos::model {

enum class FreezerPlace { kNone, kBelow, kAbove };
constexpr auto enumTable(FreezerPlace) {
  return std::to_array<base::EnumName<FreezerPlace>>(
      {{FreezerPlace::kNone, "none"}, {FreezerPlace::kBelow, "below"}, {FreezerPlace::kAbove, "above"}});
}

/// Parts "door" and, with a freezer, "freezer_door".
struct FridgeShape {
  double width_m = 0.60;
  double depth_m = 0.65;
  double height_m = 1.80;
  double wall_m = 0.04;
  double door_m = 0.05;
  double plinth_height_m = 0.04;
  int shelf_count = 4;
  HingeEdge hinge = HingeEdge::kRight;  ///< left or right
  double door_gap_m = 0.008;
  double door_opening_rad = 110.0 * base::kRadPerDeg;
  FreezerPlace freezer = FreezerPlace::kBelow;
  double freezer_height_m = 0.60;
  HandleStyle handle = HandleStyle::kBarVertical;
  double handle_length_m = 0.35;
  double handle_offset_m = 0.05;
  std::uint32_t body_rgb = 0xD9DBDC;
  std::uint32_t front_rgb = 0xC4C8CB;
  std::uint32_t handle_rgb = 0x6F7478;
  std::uint32_t shelf_rgb = 0xB9D2D6;
  std::uint32_t plinth_rgb = 0x2E2E30;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("wall_m", wall_m);
    visitor.length("door_m", door_m).length("plinth_height_m", plinth_height_m).count("shelf_count", shelf_count).choice("hinge", hinge);
    visitor.length("door_gap_m", door_gap_m).angle("door_opening_deg", door_opening_rad).choice("freezer", freezer);
    visitor.length("freezer_height_m", freezer_height_m).choice("handle", handle).length("handle_length_m", handle_length_m);
    visitor.length("handle_offset_m", handle_offset_m).color("body_rgb", body_rgb).color("front_rgb", front_rgb);
    visitor.color("handle_rgb", handle_rgb).color("shelf_rgb", shelf_rgb).color("plinth_rgb", plinth_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeFridge(const FridgeShape& shape);

/// A cooker: a hob above, knobs on a panel, an oven with a window in its door, which opens downwards. Parts "door" and "knob_0"
/// (leftmost), "knob_1", …, which turn clockwise. Without a plinth, a hob and a lower front it is an oven to build in.
struct OvenShape {
  double width_m = 0.60;
  double depth_m = 0.60;
  double height_m = 0.85;
  double bottom_m = 0.0;
  double wall_m = 0.04;
  double door_m = 0.035;
  double plinth_height_m = 0.06;
  double lower_front_height_m = 0.16;  ///< of the fixed front below the door; 0: none
  double panel_height_m = 0.11;
  int rack_count = 2;
  int hob_plate_count = 4;  ///< 0: no hob; 1 to 4
  double door_gap_m = 0.004;
  double door_opening_rad = 90.0 * base::kRadPerDeg;
  double window_ratio = 0.6;  ///< of the window's sides to the door's; 0: none
  HandleStyle handle = HandleStyle::kBarHorizontal;
  double handle_length_m = 0.42;
  double handle_offset_m = 0.045;  ///< below the door's upper edge
  int knob_count = 5;
  double knob_radius_m = 0.021;
  int knob_state_count = 10;
  double knob_range_rad = 270.0 * base::kRadPerDeg;
  std::uint32_t body_rgb = 0xE3E3E1;
  std::uint32_t front_rgb = 0xCFD1D2;
  std::uint32_t panel_rgb = 0xB4B7B9;
  std::uint32_t inside_rgb = 0x3A3B3D;
  std::uint32_t glass_rgb = 0x22282B;
  std::uint32_t hob_rgb = 0x1B1B1D;
  std::uint32_t plate_rgb = 0x4B4B4E;
  std::uint32_t handle_rgb = 0x6F7478;
  std::uint32_t knob_rgb = 0x2C2C2E;
  std::uint32_t mark_rgb = 0xF4F4F4;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("bottom_m", bottom_m);
    visitor.length("wall_m", wall_m).length("door_m", door_m).length("plinth_height_m", plinth_height_m);
    visitor.length("lower_front_height_m", lower_front_height_m).length("panel_height_m", panel_height_m).count("rack_count", rack_count);
    visitor.count("hob_plate_count", hob_plate_count).length("door_gap_m", door_gap_m).angle("door_opening_deg", door_opening_rad);
    visitor.ratio("window_ratio", window_ratio).choice("handle", handle).length("handle_length_m", handle_length_m);
    visitor.length("handle_offset_m", handle_offset_m).count("knob_count", knob_count).length("knob_radius_m", knob_radius_m);
    visitor.count("knob_state_count", knob_state_count).angle("knob_range_deg", knob_range_rad).color("body_rgb", body_rgb);
    visitor.color("front_rgb", front_rgb).color("panel_rgb", panel_rgb).color("inside_rgb", inside_rgb).color("glass_rgb", glass_rgb);
    visitor.color("hob_rgb", hob_rgb).color("plate_rgb", plate_rgb).color("handle_rgb", handle_rgb).color("knob_rgb", knob_rgb);
    visitor.color("mark_rgb", mark_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeOven(const OvenShape& shape);

/// Parts "door", which opens downwards, and "basket_0" (the lowest), "basket_1", …, which come out over the open door.
struct DishwasherShape {
  double width_m = 0.60;
  double depth_m = 0.60;
  double height_m = 0.85;
  double wall_m = 0.03;
  double door_m = 0.03;
  double plinth_height_m = 0.10;
  double panel_height_m = 0.10;  ///< the darker strip on top of the door
  int basket_count = 2;
  double basket_ratio = 0.8;  ///< how much of its depth a basket comes out
  double door_gap_m = 0.004;
  double door_opening_rad = 90.0 * base::kRadPerDeg;
  HandleStyle handle = HandleStyle::kRecessed;
  double handle_length_m = 0.25;
  double handle_offset_m = 0.05;
  std::uint32_t body_rgb = 0xE3E3E1;
  std::uint32_t front_rgb = 0xDADCDD;
  std::uint32_t panel_rgb = 0x8F9396;
  std::uint32_t handle_rgb = 0x35383A;
  std::uint32_t basket_rgb = 0x7C8B96;
  std::uint32_t plinth_rgb = 0x55524E;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("wall_m", wall_m);
    visitor.length("door_m", door_m).length("plinth_height_m", plinth_height_m).length("panel_height_m", panel_height_m);
    visitor.count("basket_count", basket_count).ratio("basket_ratio", basket_ratio).length("door_gap_m", door_gap_m);
    visitor.angle("door_opening_deg", door_opening_rad).choice("handle", handle).length("handle_length_m", handle_length_m);
    visitor.length("handle_offset_m", handle_offset_m).color("body_rgb", body_rgb).color("front_rgb", front_rgb);
    visitor.color("panel_rgb", panel_rgb).color("handle_rgb", handle_rgb).color("basket_rgb", basket_rgb).color("plinth_rgb", plinth_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeDishwasher(const DishwasherShape& shape);

}  // namespace oikos::model
