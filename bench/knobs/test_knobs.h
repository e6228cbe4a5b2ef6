// SPDX-License-Identifier: Apache-2.0
// Knobs, materials and lights that no training has seen.
#pragma once

#include <string>
#include <vector>

#include "recognition/knobs/training/panel.h"

namespace oikos::bench {

struct NamedKnob {
  std::string name;
  recognition::KnobMaker maker;
};

[[nodiscard]] const std::vector<NamedKnob>& testKnobs();
[[nodiscard]] recognition::PanelLook testLook();

}  // namespace oikos::bench
