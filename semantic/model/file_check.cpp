// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/file_check.h"

#include <map>
#include <string>
#include <system_error>

#include "semantic/model/check_words.h"

namespace oikos::semantic {

std::vector<Finding> checkFiles(const Home& home, const std::filesystem::path& folder) {
  std::vector<Finding> findings;
  std::map<std::string, bool> is_there;
  const auto check = [&](const std::string& file, const std::string& element, SourceLine line) {
    if (file.empty()) {
      return;
    }
    std::error_code ignored;
    const auto [entry, is_new] = is_there.try_emplace(file, false);
    entry->second = is_new ? std::filesystem::is_regular_file(folder / file, ignored) : entry->second;
    if (!entry->second) {
      findings.push_back({Severity::kWarning, line.number, element, quoted(file) + ", which is missing", "a file below the home's folder"});
    }
  };
  for (const Room& room : home.rooms) {
    check(room.cloud, "room " + quoted(room.id.value), room.line);
    for (const SmallObject& small : room.small_objects) {
      check(small.model, "small object " + quoted(small.id.value), small.line);
    }
    for (const LargeObject& object : room.objects) {
      check(object.model, "object " + quoted(object.id.value), object.line);
      for (const Part& part : object.articulation ? object.articulation->parts : std::vector<Part>{}) {
        check(part.model, "part " + quoted(part.id.value), part.line);
      }
      for (const SmallObject& small : object.small_objects) {
        check(small.model, "small object " + quoted(small.id.value), small.line);
      }
    }
  }
  return findings;
}

}  // namespace oikos::semantic
