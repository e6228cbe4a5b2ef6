// SPDX-License-Identifier: Apache-2.0
// Sinks, toilets and bathtubs. Heights are without taps, which stand on top: tap_height_m = 0 leaves them out.
#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

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
  double door_opening_rad = 1.9;
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
  double lid_opening_rad = std::numbers::pi / 2.0;
  std::uint32_t body_rgb = 0xF2F2F0;
  std::uint32_t lid_rgb = 0xFAFAF8;

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

  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeWashbasin(const WashbasinShape& shape);

}  // namespace oikos::model
