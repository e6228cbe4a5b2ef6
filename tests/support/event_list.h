// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "semantic/history/event_json.h"

namespace oikos::test {

/// The events of a file with one JSON object a line.
inline std::vector<semantic::Event> readEvents(const std::string& file) {
  std::vector<semantic::Event> events;
  std::ifstream input(file);
  for (std::string line; std::getline(input, line);) {
    events.push_back(semantic::eventFromJson(nlohmann::json::parse(line), file));
  }
  return events;
}

}  // namespace oikos::test
