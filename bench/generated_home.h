// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace oikos::bench {

/// home.xml of a home with so many small objects, twenty on a table (`t0`, `t1`, …), fifty tables in a room. Three of them are blue cups;
/// an object's id is `o` and its number.
[[nodiscard]] std::string homeXmlOf(int objects);

}  // namespace oikos::bench
