// SPDX-License-Identifier: Apache-2.0
// `oikos locate`: in a map, by furniture, and what it says when it cannot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/read_file.h"
#include "core/recording/trajectory.h"
#include "tests/integration/process.h"
#include "tests/integration/short_recording.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;

const fs::path kDemoHome = fs::path(OIKOS_SOURCE_DIR) / "homes/demo";

/// Half a second in the kitchen of the demo home, small pictures.
constexpr const char* kScene = R"(rate_hz = 10
duration_s = 0.5
sensor = "kinect1"
[camera]
width = 320
height = 240
fx = 262.5
fy = 262.5
cx = 159.5
cy = 119.5
[path]
start = [0.7, 1.5, 90.0]
waypoints = ["0.7 2.0"]
)";

/// A copy of the demo home and a drive through it.
struct DemoDrive {
  DemoDrive() {
    fs::create_directories(home() / "scenes");
    fs::copy_file(kDemoHome / "home.xml", home() / "home.xml");
    (void)folder.write("home/scenes/kitchen.toml", kScene);
    const ProcessResult simulated = runOikos({"simulate", (home() / "scenes/kitchen.toml").string(), "--out", recording().string()});
    EXPECT_EQ(simulated.exit_code, 0) << simulated.err;
  }
  [[nodiscard]] fs::path home() const { return folder.path() / "home"; }
  [[nodiscard]] fs::path recording() const { return folder.path() / "recording"; }
  [[nodiscard]] std::string out() const { return (folder.path() / "out.txt").string(); }

  TemporaryFolder folder;
};

double worstError_m(const fs::path& estimate, const fs::path& truth) {
  const recording::Trajectory found = recording::readTrajectory(estimate);
  const recording::Trajectory known = recording::readTrajectory(truth);
  double worst_m = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].stamp_ns, known[i].stamp_ns);
    worst_m = std::max(worst_m, (found[i].T_map_camera.translation() - known[i].T_map_camera.translation()).norm());
  }
  return worst_m;
}

TEST(Locate, FurnitureCorrectsAPrior) {
  const DemoDrive drive;
  const ProcessResult result = runOikos({"locate", drive.home().string(), drive.recording().string(), "--prior",
                                         (drive.recording() / "prior.txt").string(), "--out", drive.out(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["frames"], json["refined"]);
  EXPECT_EQ(json["relocalised"], 0);
  EXPECT_GE(json["landmarks"].size(), 3U);
  EXPECT_LT(worstError_m(drive.out(), drive.recording() / "groundtruth.txt"), 0.02);
  for (const char* beside : {"out.csv", "out.base.txt", "out.before.txt", "out.landmarks.csv"}) {
    EXPECT_TRUE(fs::exists(drive.folder.path() / beside)) << beside;
  }
}

TEST(Locate, OnePieceOnDemandFromAStart) {
  const DemoDrive drive;
  const ProcessResult result = runOikos({"locate", drive.home().string(), drive.recording().string(), "--from", "0.72,1.47,91", "--object",
                                         "fridge", "--out", drive.out(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json["landmarks"].size(), 1U);
  EXPECT_EQ(json["landmarks"][0]["id"], "fridge");
  EXPECT_LT(worstError_m(drive.out(), drive.recording() / "groundtruth.txt"), 0.03);
}

TEST(Locate, NothingFoundExitsWith1) {
  const DemoDrive drive;
  const ProcessResult result =
      runOikos({"locate", drive.home().string(), drive.recording().string(), "--from", "8,-1,0", "--out", drive.out()});
  EXPECT_EQ(result.exit_code, 1) << result.out;
  EXPECT_NE(result.out.find("0 of "), std::string::npos) << result.out;
}

TEST(Locate, SaysWhatIsMissing) {
  const DemoDrive drive;
  const std::string home = drive.home().string();
  const std::string recording = drive.recording().string();
  const ProcessResult no_map = runOikos({"locate", home, recording, "--out", drive.out()});
  EXPECT_EQ(no_map.exit_code, 2);
  EXPECT_NE(no_map.err.find("oikos map"), std::string::npos) << no_map.err;
  const ProcessResult no_place = runOikos({"locate", home, recording, "--out", drive.out(), "--from", "1,2"});
  EXPECT_EQ(no_place.exit_code, 2);
  EXPECT_NE(no_place.err.find("--from: '1,2' is no place"), std::string::npos) << no_place.err;
  const ProcessResult movable = runOikos({"locate", home, recording, "--out", drive.out(), "--from", "0,0,0", "--object", "kitchen-table"});
  EXPECT_EQ(movable.exit_code, 2);
  EXPECT_NE(movable.err.find("'kitchen-table' is shiftable"), std::string::npos) << movable.err;
  const ProcessResult both = runOikos({"locate", home, recording, "--out", drive.out(), "--from", "0,0,0", "--prior", "p.txt"});
  EXPECT_EQ(both.exit_code, 2);
}

TEST(Locate, EveryFrameOfAMappedDriveIsFoundInItsMap) {
  const TemporaryFolder folder;
  const auto recording = findShortRecording(folder, 40);
  if (!recording) {
    GTEST_SKIP() << "SKIPPED: locating in a map of the real kitchen was NOT tested; set OIKOS_DATA to the folder that holds the recording";
  }
  const std::string home = (folder.path() / "home").string();
  ASSERT_EQ(runOikos({"map", recording->string(), "--out", home}).exit_code, 0);
  const std::string out = (folder.path() / "out.txt").string();
  const ProcessResult result = runOikos({"locate", home, recording->string(), "--out", out, "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["found"], 40);
  EXPECT_LT(worstError_m(out, fs::path(home) / "map/trajectory.txt"), 0.02);
  const std::string first = base::readFile(folder.path() / "out.csv");
  ASSERT_EQ(runOikos({"locate", home, recording->string(), "--out", out, "--threads", "3"}).exit_code, 0);
  EXPECT_EQ(base::readFile(folder.path() / "out.csv"), first);
}

}  // namespace
}  // namespace oikos::test
