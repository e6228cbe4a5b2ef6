// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/model/articulated_model.h"

namespace oikos::simulate {

/// Gives the materials of a piece what they are made of, by its type and their names: grain, weave, print, gloss. `seed` chooses which.
/// Materials that have a texture keep it.
void dress(model::ArticulatedModel& piece, const std::string& type, std::uint64_t seed);

/// The same for a room's shell (shell.h) by the room's type; a "corridor" is painted and has no pattern anywhere.
void dressShell(model::TriangleMesh& shell, const std::string& room_type, std::uint64_t seed);

/// A number for a name: the same on every machine.
[[nodiscard]] std::uint64_t hashOf(const std::string& name);

}  // namespace oikos::simulate
