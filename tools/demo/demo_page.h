// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace oikos::demo {

/// What the demo's page shows.
struct DemoPage {
  std::string floor_png;                                       ///< bytes
  std::vector<std::string> frames_jpg;                         ///< bytes, some of the recording
  std::vector<std::pair<std::string, std::string>> facts;      ///< name and value
  std::vector<std::pair<std::string, std::string>> questions;  ///< with their answers
};

/// One self-contained page.
[[nodiscard]] std::string toHtml(const DemoPage& page);

}  // namespace oikos::demo
