// SPDX-License-Identifier: Apache-2.0
// What stands still: tables, chairs, sofas, beds, shelves, and what else a room has. One part, "body". Widths run along y, depths along x.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::model {

struct TableShape {
  double width_m = 1.40;
  double depth_m = 0.80;
  double height_m = 0.74;
  double top_m = 0.03;
  double leg_m = 0.06;
  double leg_inset_m = 0.03;     ///< from the top's edges to the legs
  double apron_height_m = 0.08;  ///< of the boards between the legs; 0: none
  std::uint32_t top_rgb = 0xB58A5A;
  std::uint32_t leg_rgb = 0x9C7448;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("top_m", top_m);
    visitor.length("leg_m", leg_m).length("leg_inset_m", leg_inset_m).length("apron_height_m", apron_height_m).color("top_rgb", top_rgb);
    visitor.color("leg_rgb", leg_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeTable(const TableShape& shape);

struct ChairShape {
  double width_m = 0.42;
  double depth_m = 0.46;
  double height_m = 0.88;
  double seat_height_m = 0.45;
  double seat_m = 0.03;
  double leg_m = 0.035;
  double back_board_m = 0.02;  ///< thickness of the boards of the back
  int back_board_count = 2;
  std::uint32_t seat_rgb = 0xB58A5A;
  std::uint32_t leg_rgb = 0x9C7448;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("seat_height_m", seat_height_m);
    visitor.length("seat_m", seat_m).length("leg_m", leg_m).length("back_board_m", back_board_m);
    visitor.count("back_board_count", back_board_count).color("seat_rgb", seat_rgb).color("leg_rgb", leg_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeChair(const ChairShape& shape);

struct SofaShape {
  double width_m = 2.00;
  double depth_m = 0.90;
  double height_m = 0.82;
  double seat_height_m = 0.43;
  double arm_width_m = 0.18;
  double arm_height_m = 0.60;
  double back_m = 0.22;
  double foot_m = 0.06;
  int seat_count = 3;
  std::uint32_t body_rgb = 0x5E6B78;
  std::uint32_t cushion_rgb = 0x71808E;
  std::uint32_t foot_rgb = 0x3B2F26;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("seat_height_m", seat_height_m);
    visitor.length("arm_width_m", arm_width_m).length("arm_height_m", arm_height_m).length("back_m", back_m).length("foot_m", foot_m);
    visitor.count("seat_count", seat_count).color("body_rgb", body_rgb).color("cushion_rgb", cushion_rgb).color("foot_rgb", foot_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeSofa(const SofaShape& shape);

/// Its head is at the back (-x).
struct BedShape {
  double width_m = 1.00;
  double depth_m = 2.08;   ///< its length
  double height_m = 0.90;  ///< of the headboard
  double mattress_top_m = 0.50;
  double mattress_m = 0.18;
  double board_m = 0.03;
  double rail_height_m = 0.16;
  int pillow_count = 1;
  std::uint32_t frame_rgb = 0x9C7448;
  std::uint32_t mattress_rgb = 0xE7E4DC;
  std::uint32_t pillow_rgb = 0xF7F5EF;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("mattress_top_m", mattress_top_m);
    visitor.length("mattress_m", mattress_m).length("board_m", board_m).length("rail_height_m", rail_height_m);
    visitor.count("pillow_count", pillow_count).color("frame_rgb", frame_rgb).color("mattress_rgb", mattress_rgb);
    visitor.color("pillow_rgb", pillow_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeBed(const BedShape& shape);

struct ShelfShape {
  double width_m = 0.80;
  double depth_m = 0.30;
  double height_m = 1.80;
  double bottom_m = 0.0;
  double board_m = 0.02;
  double back_m = 0.006;  ///< 0: open at the back
  int level_count = 5;    ///< boards to put things on, with the lowest and without the top
  std::uint32_t body_rgb = 0xC9A878;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("bottom_m", bottom_m);
    visitor.length("board_m", board_m).length("back_m", back_m).count("level_count", level_count).color("body_rgb", body_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeShelf(const ShelfShape& shape);

/// A worktop on two side panels and a back.
struct CounterShape {
  double width_m = 1.20;
  double depth_m = 0.60;  ///< of the worktop
  double height_m = 0.90;
  double top_m = 0.04;
  double board_m = 0.02;
  double overhang_m = 0.03;  ///< of the worktop before the panels
  std::uint32_t worktop_rgb = 0x7A5C43;
  std::uint32_t body_rgb = 0xEDEBE6;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("top_m", top_m);
    visitor.length("board_m", board_m).length("overhang_m", overhang_m).color("worktop_rgb", worktop_rgb).color("body_rgb", body_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeCounter(const CounterShape& shape);

/// A floor or table lamp: foot, pole and a shade that is open above and below; materials "foot" and "shade". Width is the shade's.
struct LampShape {
  double width_m = 0.40;
  double height_m = 1.60;
  double shade_height_m = 0.28;
  double shade_top_ratio = 0.7;  ///< of the shade's upper diameter to its lower
  double foot_width_m = 0.28;
  double pole_m = 0.024;  ///< diameter
  std::uint32_t foot_rgb = 0x3A3A3C;
  std::uint32_t shade_rgb = 0xF0E2C0;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("height_m", height_m).length("shade_height_m", shade_height_m);
    visitor.ratio("shade_top_ratio", shade_top_ratio).length("foot_width_m", foot_width_m).length("pole_m", pole_m);
    visitor.color("foot_rgb", foot_rgb).color("shade_rgb", shade_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeLamp(const LampShape& shape);

/// On its foot; `height_m` from there to the upper edge. Materials "body" and "screen".
struct TvShape {
  double width_m = 1.10;
  double depth_m = 0.22;  ///< of the foot
  double height_m = 0.68;
  double panel_m = 0.04;
  double foot_height_m = 0.05;
  double frame_m = 0.012;
  std::uint32_t body_rgb = 0x1D1D1F;
  std::uint32_t screen_rgb = 0x0C1014;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("panel_m", panel_m);
    visitor.length("foot_height_m", foot_height_m).length("frame_m", frame_m).color("body_rgb", body_rgb).color("screen_rgb", screen_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeTv(const TvShape& shape);

struct RugShape {
  double width_m = 1.60;
  double depth_m = 2.30;
  double height_m = 0.012;
  double border_m = 0.10;  ///< in a second colour; 0: none
  std::uint32_t middle_rgb = 0xA65E4E;
  std::uint32_t border_rgb = 0xD9C7A3;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("border_m", border_m);
    visitor.color("middle_rgb", middle_rgb).color("border_rgb", border_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] ArticulatedModel makeRug(const RugShape& shape);

}  // namespace oikos::model
