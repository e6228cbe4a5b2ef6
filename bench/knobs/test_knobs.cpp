// SPDX-License-Identifier: Apache-2.0
#include "bench/knobs/test_knobs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace oikos::bench {

namespace {

using namespace recognition;
constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kPaint = 0.015F;  // how far a mark stands out, in radii

float within(Random& random, double low, double high) {
  return static_cast<float>(random.between(low, high));
}

Rim markTop(const KnobSize& size, float z_m) {
  return {z_m + kPaint * size.radius_m, 1.0F};
}

/// A circle with a flat side behind the mark, a dot before it.
model::TriangleMesh dShaped(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float flat = within(random, 0.45, 0.7);
  const Outline outline = polarOutline([&](float angle) {
    const float behind = -std::cos(angle);
    return behind > flat ? r * flat / behind : r;
  });
  solid.addBevelled(outline, {0.0F, 1.0F}, {size.height_m, 1.0F}, 0.05F * r, kBody);
  const float dot = within(random, 0.12, 0.17) * r * size.mark_scale;
  solid.addPrism(moved(circleOutline(dot, 16), {0.62F * r, 0.0F}), {size.height_m, 1.0F}, markTop(size, size.height_m), kMark);
  return solid.build();
}

/// A drop with its point at the mark.
model::TriangleMesh drop(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float round = within(random, 0.68, 0.78);
  const Outline outline = polarOutline([&](float angle) {
    const float tip = std::acos(round);
    const float off = std::abs(std::remainder(angle, 2.0F * kPi));
    return off < tip ? r * round / std::cos(tip - off) : r * round;
  });
  solid.addPrism(outline, {0.0F, 1.0F}, {size.height_m, within(random, 0.88, 0.98)}, kBody);
  solid.addPrism(barOutline({within(random, 0.0, 0.3) * r, 0.72F * r, within(random, 0.1, 0.16) * r * size.mark_scale}),
                 {size.height_m, 1.0F}, markTop(size, size.height_m), kMark);
  return solid.build();
}

/// A skirt and on it a bar that is broad behind and narrow at the mark.
model::TriangleMesh chickenHead(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float base = within(random, 0.15, 0.3) * size.height_m;
  solid.addPrism(circleOutline(0.8F * r), {0.0F, 1.0F}, {base, 0.95F}, kSkirt);
  const float broad = within(random, 0.35, 0.5) * r;
  const Outline head = {{-0.75F * r, -broad}, {0.2F * r, -0.7F * broad}, {r, -0.16F * r},
                        {r, 0.16F * r},       {0.2F * r, 0.7F * broad},  {-0.75F * r, broad}};
  solid.addPrism(head, {base, 1.0F}, {size.height_m, 0.9F}, kBody);
  solid.addPrism(barOutline({0.3F * r, 0.88F * r, 0.13F * r * size.mark_scale}), {size.height_m, 1.0F}, markTop(size, size.height_m),
                 kMark);
  return solid.build();
}

/// A flat skirt that carries the mark, and a round grip.
model::TriangleMesh skirted(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float base = within(random, 0.1, 0.2) * size.height_m;
  const float grip = within(random, 0.5, 0.62);
  solid.addPrism(circleOutline(r), {0.0F, 1.0F}, {base, 1.0F}, kSkirt);
  solid.addBevelled(circleOutline(grip * r), {base, 1.0F}, {size.height_m, 0.92F}, 0.05F * r, kBody);
  const float breadth = within(random, 0.14, 0.2) * r * size.mark_scale;
  solid.addPrism(barOutline({grip * r, 0.95F * r, breadth}), {base, 1.0F}, markTop(size, base), kMark);
  solid.addPrism(barOutline({0.1F * r, 0.9F * grip * r, breadth}), {size.height_m, 1.0F}, markTop(size, size.height_m), kMark);
  return solid.build();
}

/// A notch in the rim with a painted floor.
model::TriangleMesh notched(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float half = within(random, 0.17, 0.24) * size.mark_scale;
  const float deep = within(random, 0.55, 0.7);
  const Outline outline = polarOutline([&](float angle) { return std::abs(std::remainder(angle, 2.0F * kPi)) < half ? deep * r : r; }, 120);
  solid.addPrism(outline, {0.0F, 1.0F}, {size.height_m, 1.0F}, kBody);
  const float floor = within(random, 0.5, 0.8) * size.height_m;
  solid.addPrism(barOutline({0.4F * r, 0.97F * r, 2.0F * half * r}), {0.0F, 1.0F}, {floor, 1.0F}, kMark);
  return solid.build();
}

/// Rings that narrow like a dome, a line over them.
model::TriangleMesh domed(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float half_width = within(random, 0.07, 0.1) * r * size.mark_scale;
  constexpr int kRings = 7;
  const float wall = 0.4F * size.height_m;
  const auto rimAt = [&](int ring) {
    const float angle = 0.5F * kPi * static_cast<float>(ring) / kRings;
    return Rim{wall + (size.height_m - wall) * std::sin(angle), std::max(0.02F, std::cos(angle))};
  };
  const Outline circle = circleOutline(r);
  solid.addWall(circle, {0.0F, 1.0F}, {wall, 1.0F}, kBody);
  for (int ring = 0; ring < kRings; ++ring) {
    solid.addWall(circle, rimAt(ring), rimAt(ring + 1), kBody);
  }
  for (int ring = 0; ring + 2 < kRings; ++ring) {
    const Rim low = rimAt(ring);
    const Rim high = rimAt(ring + 1);
    const float inner = high.scale * r;
    solid.addPrism(barOutline({inner, low.scale * r, 2.0F * half_width}), {low.z_m, 1.0F}, {high.z_m + 0.01F * r, 1.0F}, kMark);
  }
  return solid.build();
}

/// A disc with half a grip on it, on the side away from the mark.
model::TriangleMesh halfMoon(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float base = within(random, 0.35, 0.6) * size.height_m;
  solid.addPrism(circleOutline(r), {0.0F, 1.0F}, {base, 0.97F}, kBody);
  const Outline moon = polarOutline([&](float angle) {
    const float ahead = std::cos(angle);
    return ahead > 0.15F ? 0.88F * r * 0.15F / ahead : 0.88F * r;
  });
  solid.addPrism(moon, {base, 1.0F}, {size.height_m, 0.95F}, random.chance(0.5) ? kSkirt : kBody);
  const float spread = within(random, 0.16, 0.22) * r * size.mark_scale;
  solid.addPrism({{0.35F * r, -spread}, {0.85F * r, 0.0F}, {0.35F * r, spread}}, {base, 1.0F}, markTop(size, base), kMark);
  return solid.build();
}

/// Three lobes, the mark on one of them.
model::TriangleMesh trefoil(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float depth = within(random, 0.06, 0.12);
  const Outline outline = polarOutline([&](float angle) { return r * (1.0F - depth + depth * std::cos(3.0F * angle)); });
  solid.addBevelled(outline, {0.0F, 1.0F}, {size.height_m, within(random, 0.9, 1.0)}, 0.07F * r, kBody);
  solid.addPrism(barOutline({within(random, 0.1, 0.5) * r, 0.82F * r, within(random, 0.11, 0.18) * r * size.mark_scale, true}),
                 {size.height_m, 1.0F}, markTop(size, size.height_m), kMark);
  return solid.build();
}

/// Shades that repeat: grain along one direction, or speckles.
cv::Mat shades(Random& random, double along_px, double across_px, double depth) {
  cv::Mat noise(128, 128, CV_32FC1);
  for (int v = 0; v < noise.rows; ++v) {
    for (int u = 0; u < noise.cols; ++u) {
      noise.at<float>(v, u) = static_cast<float>(random.normal());
    }
  }
  cv::Mat wide;
  cv::repeat(noise, 3, 3, wide);
  cv::GaussianBlur(wide, wide, cv::Size(0, 0), along_px, across_px);
  cv::Mat shade = wide(cv::Rect(128, 128, 128, 128)).clone();
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(shade, mean, deviation);
  shade.convertTo(shade, CV_8U, 255.0 * depth / std::max(1e-6, deviation[0]), 255.0 * (1.0 - 2.0 * depth));
  cv::Mat color;
  cv::cvtColor(shade, color, cv::COLOR_GRAY2BGR);
  return color;
}

}  // namespace

const std::vector<NamedKnob>& testKnobs() {
  static const std::vector<NamedKnob> knobs = {{"D", dShaped},       {"drop", drop},   {"chicken head", chickenHead}, {"skirted", skirted},
                                               {"notched", notched}, {"domed", domed}, {"half moon", halfMoon},       {"trefoil", trefoil}};
  return knobs;
}

PanelLook testLook() {
  PanelLook look;
  for (const NamedKnob& knob : testKnobs()) {
    look.knobs.push_back(knob.maker);
  }
  look.panel_rgb = {0xB08D57, 0x5A6B7A, 0xE9DFC7, 0x7A2E2E, 0x2F4538, 0xBFC9D1, 0x37302A, 0xD9B9A0};
  look.body_rgb = {0x8A1F1F, 0x24406A, 0xE5D3A8, 0xC79A3B, 0x3D3229, 0x6F8F72, 0xF0EAD8, 0x141A22, 0x9A6B43};
  look.mark_rgb = {0xFFF3C4, 0x0A1020, 0xE8C020, 0x1B5E9A, 0xF05A28, 0xC8D6E0};
  Random random(20261126);
  look.body_textures = {shades(random, 6.0, 0.6, 0.06), shades(random, 0.8, 0.8, 0.05), shades(random, 3.0, 3.0, 0.08)};
  look.panel_textures = {shades(random, 12.0, 0.7, 0.05), shades(random, 1.0, 1.0, 0.04), shades(random, 5.0, 5.0, 0.06)};
  look.max_gloss = 0.45;
  look.max_lamps = 3;
  look.max_tint = 0.15;
  look.least_lamp_height = 0.25;
  return look;
}

}  // namespace oikos::bench
