// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oikos::demo {

/// A question, and its answers before and after a second recording.
struct AnsweredTwice {
  std::string question;
  std::string before;
  std::string after;
};

/// Something that a second recording has changed.
struct DemoEvent {
  std::string text;
  std::string evidence_jpg;  ///< bytes; empty: none
};

/// What a second recording has changed.
struct DemoChanges {
  std::string floor_png;  ///< bytes
  std::vector<DemoEvent> events;
  std::vector<AnsweredTwice> questions;
};

/// What the demo's page shows.
struct DemoPage {
  std::string floor_png;                                       ///< bytes
  std::vector<std::string> frames_jpg;                         ///< bytes, some of the recording
  std::vector<std::pair<std::string, std::string>> facts;      ///< name and value
  std::vector<std::pair<std::string, std::string>> questions;  ///< with their answers
  std::optional<DemoChanges> later;
};

/// One self-contained page.
[[nodiscard]] std::string toHtml(const DemoPage& page);

}  // namespace oikos::demo
