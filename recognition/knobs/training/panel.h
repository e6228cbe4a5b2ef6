// SPDX-License-Identifier: Apache-2.0
// Panels of appliances with knobs, drawn by chance: what training and the bench look at. Frame `panel`: z away from it, y up, the origin in
// its middle; `map` is the world's, z up.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/render/lighting.h"
#include "core/render/scene.h"
#include "recognition/knobs/training/knob_solid.h"

namespace oikos::recognition {

/// What panels are drawn from. Colours are 0xRRGGBB (sRGB).
struct PanelLook {
  std::vector<KnobMaker> knobs;
  std::vector<std::uint32_t> panel_rgb;
  std::vector<std::uint32_t> body_rgb;
  std::vector<std::uint32_t> mark_rgb;
  std::vector<cv::Mat> body_textures;   ///< CV_8UC3, to be multiplied with the colour; empty: none
  std::vector<cv::Mat> panel_textures;  ///< the same, as large as printOf wants them
  double max_gloss = 0.3;
  int max_lamps = 2;
  double max_tint = 0.0;           ///< how far the colour of a lamp is from white
  double least_lamp_height = 0.3;  ///< sine of the least angle between its light and the panel
};

/// What chance has built, for building it again a little differently.
struct DrawnKnob {
  KnobMaker maker;
  KnobSize size;
  std::uint64_t seed = 0;  ///< of the maker's choices
  double angle_rad = 0.0;  ///< about z, from +x
  Eigen::Vector2d position_panel = Eigen::Vector2d::Zero();
};

/// Of any size; its materials have no looks.
[[nodiscard]] model::TriangleMesh meshOf(const DrawnKnob& knob, const KnobSize& size);

/// The knob at its angle.
[[nodiscard]] Eigen::Isometry3d T_panel_knob(const DrawnKnob& knob);

struct PanelOrder {
  int knob_count = 1;
  std::optional<DrawnKnob> knob;  ///< this one instead
  bool has_clutter = true;        ///< buttons, displays, screws and lamps that are no knobs
};

struct Panel {
  std::vector<DrawnKnob> knobs;
  Eigen::Isometry3d T_map_panel = Eigen::Isometry3d::Identity();
  std::shared_ptr<render::Scene> scene;  ///< committed
  render::Lighting lighting;
};

/// By chance: a family, its size, where it is. All of one panel are of one family.
[[nodiscard]] std::vector<DrawnKnob> drawKnobs(const PanelLook& look, int count, Random& random);

/// A panel of 0.5 m by 0.25 m before a wall.
[[nodiscard]] Panel drawPanel(const PanelLook& look, const PanelOrder& order, Random& random);

/// The look that the detector is trained on.
[[nodiscard]] PanelLook trainingLook();

}  // namespace oikos::recognition
