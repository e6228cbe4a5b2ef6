// SPDX-License-Identifier: Apache-2.0
// A mapped half of a room, and cameras that turn in it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tests/support/textured_recording.h"

namespace oikos::mapping {

/// A drive through the furnished room with a noisy camera.
[[nodiscard]] test::SyntheticRecording recordingOf(const std::vector<Eigen::Isometry3d>& drive, const std::set<int>& blank_frames = {},
                                                   std::uint64_t seed = 1);

/// Keyframes of a turn through half of the room (0 to 180 degrees), where they truly were, saved as `oikos map` saves them.
class SavedRoom {
 public:
  SavedRoom();
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "keyframes.sqlite"; }

  int keyframes = 0;

 private:
  test::TemporaryFolder folder_;
};

/// One for all tests.
[[nodiscard]] const SavedRoom& savedRoom();

}  // namespace oikos::mapping
