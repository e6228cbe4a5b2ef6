// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "semantic/model/home.h"

namespace oikos::simulate {

/// Two rooms side by side (4 m × 3 m each): in `kitchen` a table with a cup and a fridge with a knob, in `study` a chest of drawers and a
/// plain box to stand behind.
[[nodiscard]] std::string smallHomeXml();
[[nodiscard]] semantic::Home smallHome();

/// The piece of furniture with this id; throws without it.
[[nodiscard]] const semantic::LargeObject& pieceOf(const semantic::Home& home, const std::string& id);
/// The value of a joint, wherever it is; throws without it.
[[nodiscard]] const semantic::Joint& jointOf(const semantic::Home& home, const std::string& id);
/// The small object, wherever it is; null: none.
[[nodiscard]] const semantic::SmallObject* findSmall(const semantic::Home& home, const std::string& id);

}  // namespace oikos::simulate
