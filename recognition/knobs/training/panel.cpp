// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/training/panel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/model/finish.h"
#include "core/model/primitives.h"
#include "recognition/knobs/training/panel_print.h"

namespace oikos::recognition {

namespace {

constexpr float kThickness_m = 0.02F;

double lumaOf(const model::Material& material) {
  return material.color_rgb.dot(Eigen::Vector3f(0.3F, 0.59F, 0.11F));
}

model::Material drawMaterial(const std::vector<std::uint32_t>& colors, double max_gloss, Random& random) {
  model::Material material = model::makeMaterial({"", random.of(colors)});
  for (int i = 0; i < 3; ++i) {
    material.color_rgb[i] = std::clamp(material.color_rgb[i] + static_cast<float>(random.between(-0.05, 0.05)), 0.02F, 0.98F);
  }
  material.gloss = static_cast<float>(random.between(0.0, max_gloss));
  return material;
}

/// The mark differs from what it is on (S252).
void paintKnob(model::TriangleMesh& mesh_knob, const PanelLook& look, Random& random) {
  constexpr double kLeastContrast = 0.3;
  mesh_knob.materials[kBody] = drawMaterial(look.body_rgb, look.max_gloss, random);
  if (!look.body_textures.empty()) {
    mesh_knob.materials[kBody].texture = random.of(look.body_textures);
  }
  mesh_knob.materials[kSkirt] = drawMaterial(look.body_rgb, look.max_gloss, random);
  do {
    mesh_knob.materials[kMark] = drawMaterial(look.mark_rgb, look.max_gloss, random);
  } while (std::abs(lumaOf(mesh_knob.materials[kMark]) - lumaOf(mesh_knob.materials[kBody])) < kLeastContrast);
}

/// Within the panel and clear of the others.
bool hasRoom(const Eigen::Vector2d& position, double radius_m, const std::vector<Eigen::Vector3d>& taken) {
  const bool is_inside =
      std::abs(position.x()) + radius_m < 0.48 * kPanelWidth_m && std::abs(position.y()) + radius_m < 0.48 * kPanelHeight_m;
  return is_inside && std::all_of(taken.begin(), taken.end(),
                                  [&](const Eigen::Vector3d& other) { return (other.head<2>() - position).norm() > radius_m + other.z(); });
}

/// Things on a panel that are no knobs.
void addClutter(render::Scene& scene, const Panel& panel, const PanelLook& look, Random& random) {
  std::vector<Eigen::Vector3d> taken;  // position, radius
  for (const DrawnKnob& knob : panel.knobs) {
    taken.emplace_back(knob.position_panel.x(), knob.position_panel.y(), 1.3 * knob.size.radius_m);
  }
  const int count = random.below(8);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d position(random.between(-0.24, 0.24), random.between(-0.12, 0.12));
    const int kind = random.below(4);
    const double reach_m = kind == 0 ? random.between(0.002, 0.009) : kind == 1 ? random.between(0.004, 0.012) : random.between(0.01, 0.05);
    if (!hasRoom(position, reach_m, taken)) {
      continue;
    }
    const auto reach = static_cast<float>(reach_m);
    model::TriangleMesh mesh;
    double lift_m = 0.0;
    if (kind == 0) {  // a button, a screw or a lamp
      const auto height = static_cast<float>(random.between(0.0005, 0.004));
      mesh = model::makeCylinder({.radius_m = reach, .length_m = 2.0F * height, .segments = 24});
    } else if (kind == 1) {  // a square button
      mesh = model::makeBox({2.0F * reach, 1.4F * reach, static_cast<float>(random.between(0.001, 0.006))});
    } else if (kind == 2) {  // a display
      mesh = model::makeBox({1.7F * reach, 0.7F * reach, 0.001F});
    } else {  // a bar to hold
      mesh = model::makeBox({1.9F * reach, 0.012F, 0.01F});
      lift_m = 0.03;
    }
    mesh.materials = {drawMaterial(random.chance(0.5) ? look.body_rgb : look.panel_rgb, look.max_gloss, random)};
    scene.add(std::make_shared<const model::TriangleMesh>(std::move(mesh)),
              panel.T_map_panel * Eigen::Translation3d(position.x(), position.y(), lift_m));
    taken.emplace_back(position.x(), position.y(), reach_m);
  }
}

/// Lamps before the panel, as bright together as to expose it well, and a glow from all sides.
render::Lighting drawLight(const PanelLook& look, const Eigen::Isometry3d& T_map_panel, Random& random) {
  render::Lighting light;
  const double glow = random.between(0.12, 0.5);
  light.from_above_rgb = Eigen::Vector3f::Constant(static_cast<float>(glow * random.between(1.0, 1.5)));
  light.from_below_rgb = Eigen::Vector3f::Constant(static_cast<float>(glow * random.between(0.4, 1.0)));
  const double wanted = random.between(0.6, 1.0) - glow;
  const int count = 1 + random.below(look.max_lamps);
  for (int i = 0; i < count; ++i) {
    const double sine = random.between(look.least_lamp_height, 1.0);
    const double around = random.between(0.0, 2.0 * std::numbers::pi);
    const double across = std::sqrt(1.0 - sine * sine);
    const double distance_m = random.between(0.6, 2.5);
    render::PointLight lamp;
    lamp.position_map = T_map_panel * (distance_m * Eigen::Vector3d(across * std::cos(around), across * std::sin(around), sine));
    const double intensity = std::max(0.05, wanted) * distance_m * distance_m / (sine * count);
    for (int channel = 0; channel < 3; ++channel) {
      lamp.intensity_rgb[channel] = static_cast<float>(intensity * (1.0 + random.between(-look.max_tint, look.max_tint)));
    }
    light.lamps.push_back(lamp);
  }
  return light;
}

/// z up: a front, or a top that leans back.
Eigen::Isometry3d drawStand(Random& random) {
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // panel x to map x, panel y to map z
  const double leaning = random.chance(0.3) ? random.between(0.2, 1.5) : 0.0;
  return Eigen::Isometry3d(upright * Eigen::AngleAxisd(-leaning, Eigen::Vector3d::UnitX()).toRotationMatrix());
}

cv::Mat drawGround(const PanelLook& look, Random& random) {
  const model::Material material = drawMaterial(look.panel_rgb, 0.0, random);
  const cv::Size size(static_cast<int>(kPanelWidth_m * kPrintPixelsPerMetre), static_cast<int>(kPanelHeight_m * kPrintPixelsPerMetre));
  const cv::Scalar color(255.0 * material.color_rgb.z(), 255.0 * material.color_rgb.y(), 255.0 * material.color_rgb.x());
  cv::Mat ground(size, CV_8UC3, color);
  if (!look.panel_textures.empty()) {
    cv::Mat shades;
    cv::resize(random.of(look.panel_textures), shades, size);
    cv::multiply(ground, shades, ground, 1.0 / 255.0);
  }
  return ground;
}

/// Coarse or fine grain that repeats itself.
cv::Mat speckles(int size_px, double depth) {
  constexpr int kSide = 128;
  Random random(static_cast<std::uint64_t>(size_px));
  cv::Mat noise(kSide / size_px, kSide / size_px, CV_8UC1);
  for (int i = 0; i < noise.rows * noise.cols; ++i) {
    noise.at<std::uint8_t>(i / noise.cols, i % noise.cols) =
        static_cast<std::uint8_t>(std::clamp(255.0 * (1.0 - 2.0 * depth + depth * random.normal()), 0.0, 255.0));
  }
  cv::resize(noise, noise, {kSide, kSide}, 0.0, 0.0, cv::INTER_CUBIC);
  cv::Mat color;
  cv::cvtColor(noise, color, cv::COLOR_GRAY2BGR);
  return color;
}

model::TriangleMesh makePlate(const cv::Mat& print, Random& random) {
  model::TriangleMesh plate = model::makeBoxBetween({Eigen::Vector3f(-kPanelWidth_m / 2.0F, -kPanelHeight_m / 2.0F, -kThickness_m),
                                                     Eigen::Vector3f(kPanelWidth_m / 2.0F, kPanelHeight_m / 2.0F, 0.0F)},
                                                    model::TextureScale::kMetres);
  // The print covers the front once, whatever the box would do with it.
  for (std::size_t i = 0; i < plate.vertices.size(); ++i) {
    plate.texture_coordinates[i] = {plate.vertices[i].x() / kPanelWidth_m + 0.5F, plate.vertices[i].y() / kPanelHeight_m + 0.5F};
  }
  model::Material material;
  material.color_rgb = Eigen::Vector3f::Ones();
  material.gloss = static_cast<float>(random.between(0.0, 0.2));
  material.texture = print;
  plate.materials = {material};
  return plate;
}

}  // namespace

// In a row, as on cookers.
std::vector<DrawnKnob> drawKnobs(const PanelLook& look, int count, Random& random) {
  std::vector<DrawnKnob> knobs;
  const KnobMaker& maker = random.of(look.knobs);
  KnobSize size;
  size.radius_m = static_cast<float>(random.between(0.013, 0.026));
  size.height_m = size.radius_m * static_cast<float>(random.between(0.55, 1.2));
  size.mark_scale = static_cast<float>(random.between(0.9, 1.2));
  const std::uint64_t seed = random.bits();
  const double pitch_m = size.radius_m * random.between(2.6, 4.0);
  const double row_m = random.between(-0.06, 0.06);
  for (int i = 0; i < count; ++i) {
    DrawnKnob knob{maker, size, seed, random.between(0.0, 2.0 * std::numbers::pi), {}};
    knob.position_panel = {(i - (count - 1) / 2.0) * pitch_m + random.between(-0.01, 0.01) * (count == 1 ? 5.0 : 0.0), row_m};
    knobs.push_back(knob);
  }
  return knobs;
}

model::TriangleMesh meshOf(const DrawnKnob& knob, const KnobSize& size) {
  Random random(knob.seed);
  return knob.maker(size, random);
}

Eigen::Isometry3d T_panel_knob(const DrawnKnob& knob) {
  return Eigen::Translation3d(knob.position_panel.x(), knob.position_panel.y(), 0.0) *
         Eigen::AngleAxisd(knob.angle_rad, Eigen::Vector3d::UnitZ());
}

Panel drawPanel(const PanelLook& look, const PanelOrder& order, Random& random) {
  Panel panel;
  panel.T_map_panel = drawStand(random);
  panel.scene = std::make_shared<render::Scene>();
  panel.knobs = order.knob ? std::vector{*order.knob} : drawKnobs(look, order.knob_count, random);
  const cv::Mat print = printPanel(panel.knobs, drawGround(look, random), random);
  panel.scene->add(std::make_shared<const model::TriangleMesh>(makePlate(print, random)), panel.T_map_panel);
  const std::uint64_t paint = random.bits();
  for (const DrawnKnob& knob : panel.knobs) {
    model::TriangleMesh mesh_knob = meshOf(knob, knob.size);
    Random same_for_all(paint);
    paintKnob(mesh_knob, look, same_for_all);
    panel.scene->add(std::make_shared<const model::TriangleMesh>(std::move(mesh_knob)), panel.T_map_panel * T_panel_knob(knob));
  }
  if (order.has_clutter) {
    addClutter(*panel.scene, panel, look, random);
  }
  model::TriangleMesh wall = model::makeBox({3.0F, 3.0F, 0.02F});
  wall.materials = {drawMaterial(look.panel_rgb, 0.1, random)};
  panel.scene->add(std::make_shared<const model::TriangleMesh>(std::move(wall)), panel.T_map_panel * Eigen::Translation3d(0.0, 0.0, -0.05));
  panel.scene->commit();
  panel.lighting = drawLight(look, panel.T_map_panel, random);
  return panel;
}

PanelLook trainingLook() {
  PanelLook look;
  look.knobs = trainingKnobs();
  look.panel_rgb = {0xD8D8D8, 0xF2F2F0, 0x303032, 0x1C1C1E, 0xA8ABAD, 0x8C8F91, 0x6E7072, 0xC9C2B4, 0x4A4A4C};
  look.body_rgb = {0x202022, 0x2E2E30, 0xE8E8E6, 0xC4C6C8, 0x9EA1A4, 0x77797B, 0x4C4D4F, 0xF4F4F4, 0xB8B4A8};
  look.mark_rgb = {0xFFFFFF, 0x101010, 0xE0E0E0, 0x2A2A2A, 0xC02020, 0x808080};
  const cv::Mat none(8, 8, CV_8UC3, cv::Scalar::all(255));
  look.body_textures = {none, none, speckles(1, 0.03), speckles(2, 0.05), speckles(5, 0.06)};
  look.panel_textures = {none, none, speckles(1, 0.03), speckles(3, 0.05), speckles(9, 0.05)};
  return look;
}

}  // namespace oikos::recognition
