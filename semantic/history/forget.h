// SPDX-License-Identifier: Apache-2.0
// Removes evidence images from a home, and leaves an event that says so.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "semantic/history/history.h"

namespace oikos::semantic {

/// Whose evidence. What is not given excludes nothing.
struct ForgetSelection {
  std::optional<std::string> recording = {};
  std::optional<std::string> subject = {};
  std::optional<std::int64_t> before_ns = {};  ///< events before this time
};

/// What became of the images. Paths are those of the events, in alphabetical order.
struct [[nodiscard]] Forgetting {
  std::vector<std::string> removed;    ///< were there, and are gone
  std::vector<std::string> missing;    ///< were gone already
  std::vector<std::string> untouched;  ///< no files below HOME/evidence: neither removed nor noted
};

/// Commits an event `forgotten` (of no recording, at `now_ns`) for every image of the selected events, those that were taken back included,
/// and every subject that it shows, then removes the images; only files below `home`/evidence that are reached without a symbolic link. An
/// earlier run that was interrupted between the two is finished. Other processes may have the home open. Throws Error{kIo}: call it again.
Forgetting forgetEvidence(History& history, const std::filesystem::path& home, const ForgetSelection& selection, std::int64_t now_ns);

}  // namespace oikos::semantic
