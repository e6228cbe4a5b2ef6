// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace oikos::model {

/// Throws Error{kInput} if an <accessor> reaches beyond the array that it names: Assimp 5.2 reads on past the array's end. `where` is for
/// messages.
void checkColladaAccessors(std::string_view xml, const std::string& where);

}  // namespace oikos::model
