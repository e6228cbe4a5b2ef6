// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "semantic/model/home.h"

namespace oikos::tools {

/// Cuts `map/cloud.ply` by the outlines of the home's rooms into `map/rooms/ID.ply` (S71): each room's own points, its walls with it. A
/// room without an outline has none.
void writeRoomClouds(const semantic::Home& home, const std::filesystem::path& map_folder);

}  // namespace oikos::tools
