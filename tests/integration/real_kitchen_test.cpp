// SPDX-License-Identifier: Apache-2.0
// The real kitchen, whose doors are closed all the time: a sensor's errors, light and clutter as they are.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kHome = OIKOS_SOURCE_DIR "/homes/kitchen-real";

/// Every third frame of some of the recording, with the camera as it was measured for the home.
std::string linkFrames(const fs::path& kitchen, int begin, int end, const fs::path& folder) {
  fs::create_directories(folder);
  fs::copy_file(fs::path(kHome) / "camera.toml", folder / "camera.toml");
  for (int i = begin; i < end; i += 3) {
    const std::string digits = std::to_string(i);
    const std::string name = "frame-" + std::string(6 - digits.size(), '0') + digits;
    for (const char* kind : {".color.jpg", ".depth.png"}) {
      fs::create_symlink(kitchen / (name + kind), folder / (name + kind));
    }
  }
  return folder.string();
}

TEST(RealKitchen, ClosedDoorsMakeNoEventAndNothingHasChanged) {
  const char* const data = std::getenv("OIKOS_DATA");
  if (data == nullptr || !fs::is_directory(fs::path(data) / "kitchen")) {
    GTEST_SKIP() << "SKIPPED: doors of the real kitchen were NOT tested; set OIKOS_DATA to the folder that holds the recording";
  }
  const TemporaryFolder folder;
  const fs::path kitchen = fs::absolute(data) / "kitchen";
  const std::string home = (folder.path() / "home").string();
  fs::copy(kHome, home, fs::copy_options::recursive);
  const std::string mapped = linkFrames(kitchen, 0, 300, folder.path() / "mapped");
  const std::string asked = linkFrames(kitchen, 300, 600, folder.path() / "asked");
  ASSERT_EQ(runOikos({"map", mapped, "--out", (folder.path() / "fresh").string(), "--quiet"}).exit_code, 0);
  fs::rename(folder.path() / "fresh/map", fs::path(home) / "map");  // the home was measured in this map: it is not to be fitted to it again
  for (const std::string& recording : {mapped, asked}) {
    const ProcessResult result =
        runOikos({"track", home, recording, "--start", "2026-03-02T08:00:00Z", "--changes", "--dry-run", "--json", "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json answer = Json::parse(result.out);
    const Json& read = answer["recordings"][0];
    EXPECT_EQ(read["events"], Json::array()) << recording;
    EXPECT_EQ(read["changes"], Json::array()) << recording;
    int closed = 0;
    for (const Json& piece : read["pieces"]) {
      for (const Json& joint : piece["joints"]) {
        for (const Json& stay : joint["stays"]) {
          closed += stay["status"] == "found" && stay["value_deg"].get<double>() < 2.0 ? 1 : 0;
        }
      }
    }
    EXPECT_GE(closed, 4) << recording;  // of seven doors, those of which enough is seen
  }
}

}  // namespace
}  // namespace oikos::test
