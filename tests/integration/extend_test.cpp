// SPDX-License-Identifier: Apache-2.0
// `oikos map --extend` as a program: a corner of the demo home is driven past, things are moved, and it is driven past again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/base/read_file.h"
#include "core/recording/trajectory.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;

const fs::path kDemoHome = fs::path(OIKOS_SOURCE_DIR) / "homes/demo";

/// Past the desk in the living room, small pictures; `first`: the way's beginning, `changes`: what was moved.
std::string scene(const std::string& first, const std::string& changes) {
  return "rate_hz = 8\nsensor = \"kinect1\"\nchanges = [" + changes +
         "]\n[camera]\nwidth = 320\nheight = 240\nfx = 262.5\nfy = 262.5\ncx = 159.5\ncy = 119.5\n"
         "[path]\nstart = [" +
         first + "]\nwaypoints = [\"3.0 -2.2 yaw 0\", \"2.6 -3.2 look 40\"]\nstand_s = 0.2\nspeed_mps = 0.5\n";
}

/// Every file below a folder but the times, with its content.
std::vector<std::pair<std::string, std::string>> contentOf(const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename() != "timing.json") {
      files.emplace_back(fs::relative(entry.path(), folder).string(), base::readFile(entry.path()));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class Extend : public ::testing::Test {
 protected:
  void SetUp() override {
    simulate("first", scene("1.6, -2.4, 0.0", ""));
    simulate("second", scene("1.7, -2.3, 0.0", "\"desk-chair at 3.2 -1.5 0 0 0 40\""));
    const ProcessResult mapped = runOikos({"map", recording("first"), "--out", home_.string()});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  }

  void simulate(const std::string& name, const std::string& text) const {
    fs::create_directories(folder_.path() / "demo/scenes");
    fs::copy_file(kDemoHome / "home.xml", folder_.path() / "demo/home.xml", fs::copy_options::skip_existing);
    const fs::path file = folder_.write("demo/scenes/" + name + ".toml", text);
    const ProcessResult simulated = runOikos({"simulate", file.string(), "--out", recording(name)});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  }
  [[nodiscard]] std::string recording(const std::string& name) const { return (folder_.path() / name).string(); }

  [[nodiscard]] ProcessResult extend(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"map", recording(name), "--out", home_.string(), "--extend"};
    words.insert(words.end(), more.begin(), more.end());
    return runOikos(words);
  }
  /// The command fails, says all of these, and the home is as it was.
  void expectRefused(const std::string& name, int exit_code, const std::vector<std::string>& parts,
                     const std::vector<std::string>& more = {}) const {
    const auto before = contentOf(home_);
    const ProcessResult result = extend(name, more);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    for (const std::string& part : parts) {
      EXPECT_NE(result.err.find(part), std::string::npos) << "'" << part << "' is not in: " << result.err;
    }
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(contentOf(home_) == before);
  }
  void spoil(const char* file, const std::string& content) const { std::ofstream(home_ / "map" / file, std::ios::binary) << content; }

  TemporaryFolder folder_;
  fs::path home_ = folder_.path() / "home";
};

TEST_F(Extend, ASecondDriveJoinsTheMapAndTellsWhatHasChanged) {
  const recording::Trajectory first = recording::readTrajectory(home_ / "map/trajectory.txt");
  const fs::path other = folder_.path() / "other";
  fs::copy(home_, other, fs::copy_options::recursive);
  const ProcessResult result = extend("second", {"--json", "--threads", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  const recording::Trajectory both = recording::readTrajectory(home_ / "map/trajectory.txt");
  ASSERT_EQ(both.size(), first.size() + json["frames"].get<std::size_t>());
  // Both drives in one frame: against the truth of both, seen from the first frame of all.
  const recording::Trajectory truth_first = recording::readTrajectory(fs::path(recording("first")) / "groundtruth.txt");
  const recording::Trajectory truth_second = recording::readTrajectory(fs::path(recording("second")) / "groundtruth.txt");
  const Eigen::Isometry3d T_map_true = both.front().T_map_camera * truth_first.front().T_map_camera.inverse();
  for (std::size_t i = 0; i < truth_second.size(); ++i) {
    const Eigen::Isometry3d T_map_camera = T_map_true * truth_second[i].T_map_camera;
    EXPECT_LT((both[first.size() + i].T_map_camera.translation() - T_map_camera.translation()).norm(), 0.03) << i;
  }
  const auto report = nlohmann::json::parse(base::readFile(home_ / "map/report.json"));
  EXPECT_EQ(report["drives"].size(), 2U);
  EXPECT_EQ(report["changes"].size(), json["changes"].size());
  EXPECT_NE(base::readFile(home_ / "map/report.html").find("What has changed"), std::string::npos);

  ASSERT_EQ(runOikos({"map", recording("second"), "--out", other.string(), "--extend", "--threads", "3"}).exit_code, 0);
  EXPECT_TRUE(contentOf(home_) == contentOf(other));
}

TEST_F(Extend, WhatCannotBeExtendedIsSaidAndKept) {
  simulate("elsewhere",
           "rate_hz = 8\n[camera]\nwidth = 320\nheight = 240\nfx = 262.5\nfy = 262.5\ncx = 159.5\ncy = 119.5\n"
           "[path]\nstart = [7.0, 0.1, 0.0]\nwaypoints = [\"7.6 -0.4\"]\nstand_s = 0.2\n");
  expectRefused("elsewhere", 1, {"no place in the map", "unchanged"});
  expectRefused("second", 3, {"another camera"}, {"--camera", "kinect1"});
  expectRefused("second", 2, {"features are sift"}, {"--features", "orb"});
  expectRefused("second", 2, {"--floorplan"}, {"--floorplan", "plan.svg"});

  const std::string store = base::readFile(home_ / "map/keyframes.sqlite");
  spoil("keyframes.sqlite", store.substr(0, 30000));
  expectRefused("second", 3, {"keyframes.sqlite"});
  spoil("keyframes.sqlite", store);
  spoil("trajectory.txt", "0 0 0 1 0 0 0 1\n");
  expectRefused("second", 3, {"trajectory.txt", "not of one map"});

  fs::remove_all(home_ / "map");
  expectRefused("second", 2, {"map", "no such map to extend", "without --extend"});
  fs::remove_all(home_);
  EXPECT_EQ(extend("second").exit_code, 2);
  EXPECT_FALSE(fs::exists(home_));
}

TEST_F(Extend, GoesOnWithTheMapsOwnParameters) {
  const ProcessResult mapped = runOikos({"map", recording("first"), "--out", home_.string(), "--resolution", "0.1"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  ASSERT_EQ(extend("second").exit_code, 0);
  EXPECT_NE(base::readFile(home_ / "map/config.toml").find("resolution_m = 0.1\n"), std::string::npos);
}

}  // namespace
}  // namespace oikos::test
