// SPDX-License-Identifier: Apache-2.0
// Sinks, toilets and bathtubs. Heights are without taps, which stand on top: tap_height_m = 0 leaves them out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/degrees.h"
#include "core/model/articulated_model.h"
#include "core/model/furniture/options.h"

namespace oikos::model {

/// A kitchen's sink in a worktop above a cupboard with two doors, "left_door" and "right_door".
struct SinkUnitShape {
  double width_m = 0.80;
  double depth_m = 0.60;
  double height_m = 0.90;
  double board_m = 0.018;
  double plinth_height_m = 0.10;
  double worktop_thickness_m = 0.04;
  double worktop_overhang_m = 0.02;
  double basin_width_m = 0.50;
  double basin_depth_m = 0.36;
  double basin_height_m = 0.18;
  double tap_height_m = 0.26;
  double door_gap_m = 0.003;
  double door_opening_rad = 110.0 * base::kRadPerDeg;
  HandleStyle handle = HandleStyle::kBarVertical;
  double handle_length_m = 0.16;
  double handle_offset_m = 0.04;
  double handle_level = 0.9;
  std::uint32_t body_rgb = 0xEDEBE6;
  std::uint32_t front_rgb = 0xD8CBB2;
  std::uint32_t handle_rgb = 0x8C9094;
  std::uint32_t plinth_rgb = 0x55524E;
  std::uint32_t worktop_rgb = 0x7A5C43;
  std::uint32_t basin_rgb = 0xB9BEC2;
  std::uint32_t tap_rgb = 0x9AA0A5;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("board_m", board_m);
    visitor.length("plinth_height_m", plinth_height_m).length("worktop_thickness_m", worktop_thickness_m);
    visitor.length("worktop_overhang_m", worktop_overhang_m).length("basin_width_m", basin_width_m).length("basin_depth_m", basin_depth_m);
    visitor.length("basin_height_m", basin_height_m).length("tap_height_m", tap_height_m).length("door_gap_m", door_gap_m);
    visitor.angle("door_opening_deg", door_opening_rad).choice("handle", handle).length("handle_length_m", handle_length_m);
    visitor.length("handle_offset_m", handle_offset_m).ratio("handle_level", handle_level).color("body_rgb", body_rgb);
    visitor.color("front_rgb", front_rgb).color("handle_rgb", handle_rgb).color("plinth_rgb", plinth_rgb);
    visitor.color("worktop_rgb", worktop_rgb).color("basin_rgb", basin_rgb).color("tap_rgb", tap_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeSinkUnit(const SinkUnitShape& shape);

/// Part "lid" opens upwards.
struct ToiletShape {
  double width_m = 0.37;
  double depth_m = 0.67;
  double height_m = 0.80;       ///< of the cistern
  double seat_height_m = 0.43;  ///< to the top of the closed lid
  double cistern_depth_m = 0.17;
  double lid_m = 0.025;
  double lid_opening_rad = 90.0 * base::kRadPerDeg;
  std::uint32_t body_rgb = 0xF2F2F0;
  std::uint32_t lid_rgb = 0xFAFAF8;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("seat_height_m", seat_height_m);
    visitor.length("cistern_depth_m", cistern_depth_m).length("lid_m", lid_m).angle("lid_opening_deg", lid_opening_rad);
    visitor.color("body_rgb", body_rgb).color("lid_rgb", lid_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeToilet(const ToiletShape& shape);

/// Its long side (y) to the front, the tap at its right end.
struct BathtubShape {
  double width_m = 1.70;
  double depth_m = 0.75;
  double height_m = 0.56;
  double rim_m = 0.07;     ///< width of the rim
  double bottom_m = 0.12;  ///< from the floor to the bottom inside
  double tap_height_m = 0.10;
  std::uint32_t body_rgb = 0xF2F2F0;
  std::uint32_t tap_rgb = 0x9AA0A5;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("rim_m", rim_m);
    visitor.length("bottom_m", bottom_m).length("tap_height_m", tap_height_m).color("body_rgb", body_rgb).color("tap_rgb", tap_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeBathtub(const BathtubShape& shape);

struct WashbasinShape {
  double width_m = 0.56;
  double depth_m = 0.46;
  double height_m = 0.86;
  double basin_height_m = 0.17;
  double rim_m = 0.025;
  double shelf_m = 0.09;  ///< the broader rim at the back, where the tap stands
  double pedestal_width_m = 0.18;
  double tap_height_m = 0.12;
  std::uint32_t body_rgb = 0xF2F2F0;
  std::uint32_t tap_rgb = 0x9AA0A5;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("basin_height_m", basin_height_m);
    visitor.length("rim_m", rim_m).length("shelf_m", shelf_m).length("pedestal_width_m", pedestal_width_m);
    visitor.length("tap_height_m", tap_height_m).color("body_rgb", body_rgb).color("tap_rgb", tap_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeWashbasin(const WashbasinShape& shape);

}  // namespace oikos::model
