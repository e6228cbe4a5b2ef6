// SPDX-License-Identifier: Apache-2.0
// Families of knobs for training. Those that the bench tests on are others (bench/knobs/test_knobs.cpp).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "recognition/knobs/training/knob_solid.h"

namespace oikos::recognition {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kPaint = 0.015F;  // how far a mark stands out, in radii

float within(Random& random, double low, double high) {
  return static_cast<float>(random.between(low, high));
}

/// A line on a flat top.
void addLine(KnobSolid& solid, const KnobSize& size, float from, float to, float breadth) {
  const float r = size.radius_m;
  solid.addPrism(barOutline({from * r, to * r, breadth * r * size.mark_scale}), {size.height_m, 1.0F}, {size.height_m + kPaint * r, 1.0F},
                 kMark);
}

model::TriangleMesh plain(const KnobSize& size, Random& random) {
  KnobSolid solid;
  solid.addBevelled(circleOutline(size.radius_m), {0.0F, 1.0F}, {size.height_m, 1.0F}, within(random, 0.02, 0.1) * size.radius_m, kBody);
  addLine(solid, size, within(random, 0.0, 0.4), within(random, 0.8, 0.92), within(random, 0.1, 0.2));
  return solid.build();
}

model::TriangleMesh tapered(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float top = within(random, 0.7, 0.85);
  solid.addPrism(circleOutline(size.radius_m), {0.0F, 1.0F}, {size.height_m, top}, kBody);
  addLine(solid, size, within(random, 0.0, 0.3), top * 0.97F, within(random, 0.1, 0.2));
  return solid.build();
}

/// A cone, its mark from the top down the wall.
model::TriangleMesh cone(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float top = within(random, 0.35, 0.6);
  const float bend = within(random, 0.1, 0.5);
  solid.addPrism(circleOutline(r), {0.0F, 1.0F}, {bend * size.height_m, 1.0F}, kBody);
  solid.addPrism(circleOutline(r), {bend * size.height_m, 1.0F}, {size.height_m, top}, kBody);
  addLine(solid, size, 0.0F, top * 0.95F, within(random, 0.1, 0.2));
  return solid.build();
}

model::TriangleMesh bar(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float base = within(random, 0.15, 0.45) * size.height_m;
  solid.addPrism(circleOutline(r), {0.0F, 1.0F}, {base, within(random, 0.9, 1.0)}, random.chance(0.5) ? kSkirt : kBody);
  const float width = within(random, 0.32, 0.5) * r;
  solid.addBevelled(barOutline({-0.95F * r, 0.95F * r, width, true}), {base, 1.0F}, {size.height_m, 1.0F}, 0.05F * r, kBody);
  addLine(solid, size, within(random, 0.1, 0.4), 0.85F, within(random, 0.1, 0.16));
  return solid.build();
}

model::TriangleMesh stepped(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float step = within(random, 0.3, 0.6) * size.height_m;
  solid.addPrism(circleOutline(r), {0.0F, 1.0F}, {step, 1.0F}, kBody);
  solid.addPrism(circleOutline(r), {step, within(random, 0.75, 0.85)}, {size.height_m, 0.74F}, random.chance(0.5) ? kSkirt : kBody);
  const float dot = within(random, 0.11, 0.16) * r * size.mark_scale;
  solid.addPrism(moved(circleOutline(dot, 16), {0.55F * r, 0.0F}), {size.height_m, 1.0F}, {size.height_m + kPaint * r, 1.0F}, kMark);
  return solid.build();
}

model::TriangleMesh polygon(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const auto sides = static_cast<float>(6 + 2 * random.below(3));
  const Outline outline = polarOutline([&](float angle) {
    const float within_side = std::remainder(angle, 2.0F * kPi / sides);
    return r * std::min(1.0F, std::cos(kPi / sides) * 1.03F / std::cos(within_side));
  });
  solid.addBevelled(outline, {0.0F, 1.0F}, {size.height_m, within(random, 0.9, 1.0)}, 0.06F * r, kBody);
  const float half = within(random, 0.16, 0.24) * r * size.mark_scale;
  solid.addPrism({{0.4F * r, -half}, {0.8F * r, 0.0F}, {0.4F * r, half}}, {size.height_m, 1.0F}, {size.height_m + kPaint * r, 1.0F}, kMark);
  return solid.build();
}

model::TriangleMesh wing(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  const float base = within(random, 0.1, 0.25) * size.height_m;
  solid.addPrism(circleOutline(r), {0.0F, 1.0F}, {base, 0.97F}, kSkirt);
  const float slim = within(random, 0.35, 0.6);
  const Outline oval = polarOutline([&](float angle) { return 0.92F * r / std::hypot(std::cos(angle), std::sin(angle) / slim); });
  solid.addPrism(oval, {base, 1.0F}, {size.height_m, 0.9F}, kBody);
  addLine(solid, size, within(random, 0.2, 0.4), 0.78F, within(random, 0.1, 0.18));
  return solid.build();
}

model::TriangleMesh fluted(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const auto flutes = static_cast<float>(8 + random.below(9));
  const float depth = within(random, 0.03, 0.07);
  const Outline outline = polarOutline([&](float angle) { return size.radius_m * (1.0F - depth + depth * std::cos(flutes * angle)); }, 144);
  solid.addPrism(outline, {0.0F, 1.0F}, {size.height_m, within(random, 0.85, 1.0)}, kBody);
  addLine(solid, size, within(random, 0.2, 0.5), 0.76F, within(random, 0.12, 0.2));
  return solid.build();
}

/// The mark lies on the rim and runs down the wall.
model::TriangleMesh edged(const KnobSize& size, Random& random) {
  KnobSolid solid;
  const float r = size.radius_m;
  solid.addPrism(circleOutline(r), {0.0F, 1.0F}, {size.height_m, 1.0F}, kBody);
  const float breadth = within(random, 0.14, 0.22) * r * size.mark_scale;
  solid.addPrism(barOutline({within(random, 0.45, 0.6) * r, (1.0F + kPaint) * r, breadth}), {0.1F * size.height_m, 1.0F},
                 {size.height_m + kPaint * r, 1.0F}, kMark);
  return solid.build();
}

}  // namespace

const std::vector<KnobMaker>& trainingKnobs() {
  static const std::vector<KnobMaker> makers = {plain, tapered, cone, bar, stepped, polygon, wing, fluted, edged};
  return makers;
}

}  // namespace oikos::recognition
