// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace oikos::model {

// Assimp and urdfdom walk elements and nodes by recursion and end in a crash where these are nested too deep. All throw Error{kInput};
// `where` is for messages.

/// At most 256 open elements.
void checkXmlNesting(std::string_view xml, const std::string& where);
/// At most 256 open lists and objects, and at most 256 nodes below each other, of a glTF's text or a GLB's bytes.
void checkGltfNesting(std::string_view bytes, const std::string& where);

}  // namespace oikos::model
