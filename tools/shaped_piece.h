// SPDX-License-Identifier: Apache-2.0
// A piece of furniture or a small object by its dimensions, as an element that can be pasted into home.xml.
#pragma once

#include <string>

#include "semantic/model/home.h"

namespace oikos::tools {

/// `cabinet width_m=0.8 door_count=2`; a word without "=" goes on with the value before it, so that a value may be a list:
/// `drawer_unit front_heights_m=0.2 0.3 0.3`. Throws Error{kUsage} at `--shape` for what model::validateShape refuses too.
[[nodiscard]] semantic::Shape parseShape(const std::string& text);

struct PieceText {
  std::string id;
  std::string type;
  std::string pose = "0 0 0 0 0 0";  ///< x y z roll pitch yaw (m, deg): of furniture in the map, of a small object in what carries it
  std::string parent = "room";       ///< of a small object: the id of the piece, part or room that carries it
};

/// Of furniture with its shape, its parts, joints, handles and knobs, all closed, and a parking pose 0.8 m before its front, facing it. Of
/// a small object with its shape and a grasping point in its middle. Throws Error{kUsage} with what home.xml would not take.
[[nodiscard]] std::string pieceXml(const semantic::Shape& shape, const PieceText& piece);

}  // namespace oikos::tools
