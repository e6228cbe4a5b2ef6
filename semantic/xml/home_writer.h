// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "semantic/model/home.h"

namespace oikos::semantic {

/// The home as a new file. It reads back as an equal home; an angle that no decimal text in degrees gives to the bit (they never came from
/// a file) within 1e-15 rad.
[[nodiscard]] std::string toXml(const Home& home);

/// The element of one piece, with what it carries, as it would stand in a room.
[[nodiscard]] std::string toXml(const LargeObject& object);

/// The element of a small object, as it would stand in what carries it or in a room.
[[nodiscard]] std::string toXml(const SmallObject& object);

/// `bytes`, which readHome reads as `before`, changed so that it reads `after`: only what differs is replaced. Comments, order, quotes and
/// line breaks of everything else stay; an object that moves takes its own along. `bytes` must be UTF-8 and valid.
[[nodiscard]] std::string spliceXml(std::string_view bytes, const Home& before, const Home& after);

/// The same, once the new text has been read back and found valid and equal; `where` names it in errors. Throws Error{kInput} where `after`
/// is no valid home.
[[nodiscard]] std::string spliceVerified(std::string_view bytes, const Home& before, const Home& after, const std::string& where);

}  // namespace oikos::semantic
