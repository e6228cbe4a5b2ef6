// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace oikos::recognition {

/// detector.txt of this folder.
extern const std::string_view kShippedDetector;

}  // namespace oikos::recognition
