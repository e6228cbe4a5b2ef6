// SPDX-License-Identifier: Apache-2.0
#include "bench/knobs/belief.h"

#include <numbers>
#include <string>

#include "bench/knobs/trials.h"
#include "core/base/degrees.h"
#include "core/geometry/se3.h"

namespace oikos::bench {

recognition::KnobDescription believe(const recognition::DrawnKnob& drawn, double zero_rad, recognition::Random& random) {
  recognition::KnobSize size = drawn.size;
  size.radius_m *= static_cast<float>(1.0 + 0.02 * random.normal());
  size.height_m *= static_cast<float>(1.0 + 0.04 * random.normal());
  size.mark_scale *= static_cast<float>(1.0 + 0.1 * random.normal());
  recognition::KnobDescription knob;
  knob.name = "knob";
  knob.axis_knob = -Eigen::Vector3d::UnitZ();
  knob.mesh_knob = std::make_shared<const model::TriangleMesh>(meshOf(drawn, size));
  for (int i = 0; i < kStates; ++i) {
    knob.states.push_back({std::to_string(i), zero_rad + 2.0 * std::numbers::pi * i / kStates});
  }
  return knob;
}

Eigen::Isometry3d drawMisplacement(recognition::Random& random) {
  geometry::Vector6d off;
  for (int i = 0; i < 6; ++i) {
    off[i] = (i < 3 ? 0.003 : base::kRadPerDeg) * random.normal();
  }
  return geometry::expSe3(off);
}

}  // namespace oikos::bench
