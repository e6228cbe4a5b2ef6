// SPDX-License-Identifier: Apache-2.0
#include "tools/home_history.h"

#include "core/base/error.h"

namespace oikos::tools {

std::unique_ptr<semantic::History> openHistory(const std::filesystem::path& home) {
  if (!std::filesystem::is_directory(home)) {
    throw base::Error(base::ErrorCode::kIo, "no such folder; a home is a folder with a home.xml", home.string());
  }
  const std::filesystem::path file = home / "history.sqlite";
  if (!std::filesystem::exists(file)) {
    throw base::Error(base::ErrorCode::kInput, "missing: this home has no history yet", file.string());
  }
  return std::make_unique<semantic::History>(file, semantic::HistoryAccess::kAppend);
}

}  // namespace oikos::tools
