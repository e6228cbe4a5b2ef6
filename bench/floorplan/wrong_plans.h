// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "semantic/model/home.h"

namespace oikos::bench {

struct WrongPlan {
  std::string kind;  ///< "mirrored", "scaled", …
  std::string name;
  semantic::Home home;  ///< whose outlines are the plan
};

/// Plans that are wrong for `home`: mirrored, scaled, with each room left out or moved by `moved_m`, and those of the `others`.
[[nodiscard]] std::vector<WrongPlan> wrongPlans(const semantic::Home& home, const std::vector<semantic::Home>& others, double moved_m);

}  // namespace oikos::bench
