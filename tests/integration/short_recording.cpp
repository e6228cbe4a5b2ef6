// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/short_recording.h"

#include <cstdlib>
#include <string>

namespace oikos::test {

namespace {

std::string frameName(int number) {
  const std::string digits = std::to_string(number);
  return "frame-" + std::string(6 - digits.size(), '0') + digits;
}

}  // namespace

std::optional<std::filesystem::path> findShortRecording(const TemporaryFolder& folder, int frames) {
  const char* const data = std::getenv("OIKOS_DATA");
  if (data == nullptr || !std::filesystem::is_directory(std::filesystem::path(data) / "kitchen")) {
    return std::nullopt;
  }
  const std::filesystem::path kitchen = std::filesystem::absolute(data) / "kitchen";
  const std::filesystem::path recording = folder.path() / "recording";
  std::filesystem::create_directory(recording);
  std::filesystem::create_symlink(kitchen / "camera.toml", recording / "camera.toml");
  for (int i = 0; i < frames; ++i) {
    for (const char* kind : {".color.jpg", ".depth.png"}) {
      std::filesystem::create_symlink(kitchen / (frameName(i) + kind), recording / (frameName(i) + kind));
    }
  }
  return recording;
}

}  // namespace oikos::test
