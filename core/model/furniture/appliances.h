// SPDX-License-Identifier: Apache-2.0
// Fridges, cookers and dishwashers. Depths are from the back to the face of the closed door, without handles and knobs.
#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

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
  double door_opening_rad = 1.9;
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
  double door_opening_rad = std::numbers::pi / 2.0;
  double window_ratio = 0.6;  ///< of the window's sides to the door's; 0: none
  HandleStyle handle = HandleStyle::kBarHorizontal;
  double handle_length_m = 0.42;
  double handle_offset_m = 0.045;  ///< below the door's upper edge
  int knob_count = 5;
  double knob_radius_m = 0.021;
  int knob_state_count = 10;
  double knob_range_rad = 1.5 * std::numbers::pi;
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
  double door_opening_rad = std::numbers::pi / 2.0;
  HandleStyle handle = HandleStyle::kRecessed;
  double handle_length_m = 0.25;
  double handle_offset_m = 0.05;
  std::uint32_t body_rgb = 0xE3E3E1;
  std::uint32_t front_rgb = 0xDADCDD;
  std::uint32_t panel_rgb = 0x8F9396;
  std::uint32_t handle_rgb = 0x35383A;
  std::uint32_t basket_rgb = 0x7C8B96;
  std::uint32_t plinth_rgb = 0x55524E;

  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeDishwasher(const DishwasherShape& shape);

}  // namespace oikos::model
