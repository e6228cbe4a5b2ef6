// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tracking/state/piece_views.h"
#include "tracking/state/state_config.h"

namespace oikos::tracking {

/// The frames that this piece is to be read from: each stay in view is cut into equal times, and of each the frame that shows most of it is
/// taken. Indices of `frames`, which are in the order of time; ascending.
[[nodiscard]] std::vector<int> chooseFrames(const std::vector<SeenFrame>& frames, int piece, const FrameChoiceConfig& config);

/// A frame between these two that sees the piece, as near to the middle in time as can be; nothing: there is none.
[[nodiscard]] std::optional<int> frameBetween(const std::vector<SeenFrame>& frames, int piece, int first, int last);

/// The frame nearest in time to this one that sees the piece and was not read, within the same stay; nothing: there is none.
[[nodiscard]] std::optional<int> frameBeside(const std::vector<SeenFrame>& frames, int piece, const std::vector<int>& read, int frame);

}  // namespace oikos::tracking
