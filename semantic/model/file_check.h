// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "semantic/model/finding.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

/// Warnings for model and cloud files that are not below the home's folder.
[[nodiscard]] std::vector<Finding> checkFiles(const Home& home, const std::filesystem::path& folder);

}  // namespace oikos::semantic
