// SPDX-License-Identifier: Apache-2.0
// What stands on a kitchen table, as one mesh each. Frame: z up, the origin on the table below the middle, x towards the viewer.
// Textures: an image on the material that is named as the label wraps once around, its middle at +x; each face of a box shows a whole
// image. Diameters and widths are the outermost ones, without handles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::model {

/// Label "outside"; also "body" (rim, foot, handle) and "inside". The handle stands at +y.
struct CupShape {
  double diameter_m = 0.082;
  double bottom_diameter_m = 0.070;
  double height_m = 0.095;
  double wall_m = 0.004;
  double bottom_m = 0.006;
  double handle_reach_m = 0.030;  ///< from the wall outwards; 0: no handle
  double handle_rod_m = 0.009;    ///< its diameter
  std::uint32_t outside_rgb = 0x3C6EA8;
  std::uint32_t body_rgb = 0x3C6EA8;
  std::uint32_t inside_rgb = 0xF4F2EC;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("diameter_m", diameter_m).length("bottom_diameter_m", bottom_diameter_m).length("height_m", height_m);
    visitor.length("wall_m", wall_m).length("bottom_m", bottom_m).length("handle_reach_m", handle_reach_m);
    visitor.length("handle_rod_m", handle_rod_m).color("outside_rgb", outside_rgb).color("body_rgb", body_rgb);
    visitor.color("inside_rgb", inside_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeCup(const CupShape& shape);

/// Label "outside"; also "body" (rim and foot) and "inside".
struct BowlShape {
  double diameter_m = 0.16;
  double height_m = 0.07;
  double foot_diameter_m = 0.07;
  double wall_m = 0.004;
  std::uint32_t outside_rgb = 0xC8553D;
  std::uint32_t inside_rgb = 0xF4F2EC;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("diameter_m", diameter_m).length("height_m", height_m).length("foot_diameter_m", foot_diameter_m);
    visitor.length("wall_m", wall_m).color("outside_rgb", outside_rgb).color("inside_rgb", inside_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeBowl(const BowlShape& shape);

/// "body" below, "inside" above: a picture there fills the square around the plate.
struct PlateShape {
  double diameter_m = 0.25;
  double height_m = 0.022;
  double well_diameter_m = 0.16;
  double wall_m = 0.005;
  std::uint32_t body_rgb = 0xF4F2EC;
  std::uint32_t inside_rgb = 0xF4F2EC;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("diameter_m", diameter_m).length("height_m", height_m).length("well_diameter_m", well_diameter_m);
    visitor.length("wall_m", wall_m).color("body_rgb", body_rgb).color("inside_rgb", inside_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makePlate(const PlateShape& shape);

/// "label" around the straight part; also "body" and "cap".
struct BottleShape {
  double diameter_m = 0.075;
  double height_m = 0.27;  ///< with the cap
  double neck_diameter_m = 0.030;
  double shoulder_height_m = 0.16;  ///< where the straight part ends
  double neck_height_m = 0.21;      ///< where the neck begins
  double cap_height_m = 0.022;
  double label_low_m = 0.03;
  double label_high_m = 0.14;
  std::uint32_t body_rgb = 0x2F6B45;
  std::uint32_t label_rgb = 0xEFE9D8;
  std::uint32_t cap_rgb = 0xB8372F;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("diameter_m", diameter_m).length("height_m", height_m).length("neck_diameter_m", neck_diameter_m);
    visitor.length("shoulder_height_m", shoulder_height_m).length("neck_height_m", neck_height_m).length("cap_height_m", cap_height_m);
    visitor.length("label_low_m", label_low_m).length("label_high_m", label_high_m).color("body_rgb", body_rgb);
    visitor.color("label_rgb", label_rgb).color("cap_rgb", cap_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeBottle(const BottleShape& shape);

/// "label" is the mantle, "metal" the rims and ends.
struct TinShape {
  double diameter_m = 0.074;
  double height_m = 0.110;
  double rim_m = 0.003;  ///< how high and thick its rims are
  std::uint32_t label_rgb = 0xD9A13B;
  std::uint32_t metal_rgb = 0xBFC3C6;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("diameter_m", diameter_m).length("height_m", height_m).length("rim_m", rim_m).color("label_rgb", label_rgb);
    visitor.color("metal_rgb", metal_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeTin(const TinShape& shape);

/// A sugar jar: "label" is the mantle; also "body" and "lid".
struct JarShape {
  double diameter_m = 0.10;
  double height_m = 0.13;  ///< with the lid's knob
  double lid_height_m = 0.035;
  std::uint32_t label_rgb = 0xE8E2D2;
  std::uint32_t body_rgb = 0xE8E2D2;
  std::uint32_t lid_rgb = 0x7A5C43;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("diameter_m", diameter_m).length("height_m", height_m).length("lid_height_m", lid_height_m);
    visitor.color("label_rgb", label_rgb).color("body_rgb", body_rgb).color("lid_rgb", lid_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeJar(const JarShape& shape);

/// Materials "front" (+x), "back", "left" (-y), "right", "top", "bottom", each with a whole image.
struct BoxShape {
  double width_m = 0.19;  ///< along y
  double depth_m = 0.06;  ///< along x
  double height_m = 0.28;
  std::uint32_t body_rgb = 0xD8B04A;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).color("body_rgb", body_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeSmallBox(const BoxShape& shape);

/// A drink's carton: a box as above below a roof with its seam ("roof", the ridge along y) and a screw cap ("cap") on the front slope.
struct CartonShape {
  double width_m = 0.07;
  double depth_m = 0.07;
  double height_m = 0.235;        ///< to the upper edge of the seam
  double roof_height_m = 0.03;    ///< from the box to the ridge
  double seam_m = 0.015;          ///< the seam's height; it stands on the ridge
  double cap_diameter_m = 0.025;  ///< 0: none
  std::uint32_t body_rgb = 0xE9EEF2;
  std::uint32_t roof_rgb = 0x5B8FC7;
  std::uint32_t cap_rgb = 0xC23B33;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("roof_height_m", roof_height_m);
    visitor.length("seam_m", seam_m).length("cap_diameter_m", cap_diameter_m).color("body_rgb", body_rgb).color("roof_rgb", roof_rgb);
    visitor.color("cap_rgb", cap_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeCarton(const CartonShape& shape);

/// Standing, its cover to the front and its spine on the left: "cover", "back_cover" and "spine" with whole images, and "pages".
struct BookShape {
  double width_m = 0.14;   ///< from the spine to the fore edge
  double depth_m = 0.025;  ///< its thickness
  double height_m = 0.21;
  double board_m = 0.0025;  ///< the covers' thickness
  std::uint32_t cover_rgb = 0x8C2F39;
  std::uint32_t pages_rgb = 0xEFE9D8;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor.length("width_m", width_m).length("depth_m", depth_m).length("height_m", height_m).length("board_m", board_m);
    visitor.color("cover_rgb", cover_rgb).color("pages_rgb", pages_rgb);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};
[[nodiscard]] TriangleMesh makeBook(const BookShape& shape);

}  // namespace oikos::model
