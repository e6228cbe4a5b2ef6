// SPDX-License-Identifier: Apache-2.0
// Takes back what one recording said, by further events.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "semantic/history/history.h"

namespace oikos::semantic {

/// What was taken back.
struct [[nodiscard]] Revert {
  std::int64_t events = 0;            ///< of the recording; 0: it says nothing, nothing was written
  std::vector<std::string> subjects;  ///< that it had said something of, in alphabetical order
  std::vector<std::string> restored;  ///< of these, those whose newest state it had given: they have the state from before again
};

/// Appends an event `reverted` for every subject of the recording, all in one transaction. Its time is that of the recording's last event
/// of the subject. Other processes may have the home open. Throws Error{kIo}.
Revert revertRecording(History& history, const std::string& recording);

}  // namespace oikos::semantic
