// SPDX-License-Identifier: Apache-2.0
// A simulated drive under a ceiling camera, and the robot's path by the tags that it carries.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "core/base/read_file.h"
#include "core/recording/trajectory.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kHome = R"(<apartment id="flat" name="flat" version="1">
  <room id="room" name="room" outline_m="-2 -2 2 -2 2 2 -2 2">
    <largeObject id="box" type="box" pose="1.5 1.5 0 0 0 0" movability="movable" graspable="false">
      <shape kind="box" width_m="0.4" depth_m="0.4" height_m="0.6"/>
      <parkingPose pose="1 0 0 0 0 180" default="true"/>
    </largeObject>
  </room>
</apartment>
)";

/// 0.6 m ahead, then a quarter turn to the left: 9 pictures.
constexpr const char* kScene = R"(rate_hz = 1.5
[camera]
width = 64
height = 48
fx = 50
fy = 50
cx = 31.5
cy = 23.5
[path]
start = [-0.2, 0.1, 0]
waypoints = ["0.4 0.1 yaw 90"]
stand_s = 0.2
)";

constexpr const char* kCeiling = R"([ceiling_camera]
position_m = [-1.6, -1.4, 2.4]
look_at_m = [0.1, 0.1, 0.5]
)";

class Tags : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    original_ = std::make_unique<TemporaryFolder>();
    (void)record("recording", std::string(kScene) + kCeiling, {"--threads", "1"});
  }
  static void TearDownTestSuite() { original_.reset(); }

  static fs::path record(const std::string& name, const std::string& scene, const std::vector<std::string>& more = {}) {
    (void)original_->write("home/home.xml", kHome);
    const fs::path out = original_->path() / name;
    std::vector<std::string> arguments = {"simulate", original_->write("home/scenes/scene.toml", scene).string(), "--out", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = runOikos(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return out;
  }
  static fs::path recorded() { return original_->path() / "recording"; }
  /// One to be changed.
  fs::path copied() const {
    const fs::path copy = folder_.path() / "recording";
    fs::copy(recorded(), copy, fs::copy_options::recursive);
    return copy;
  }
  static ProcessResult evaluate(const fs::path& recording, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"evaluate", "tags", recording.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runOikos(arguments);
  }
  static void expectRefused(const fs::path& recording, int exit_code, const std::string& message) {
    const ProcessResult result = evaluate(recording);
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }

  static std::unique_ptr<TemporaryFolder> original_;  ///< simulating takes seconds: once for all
  TemporaryFolder folder_;
};

std::unique_ptr<TemporaryFolder> Tags::original_;

TEST_F(Tags, GiveTheRobotsPath) {
  const fs::path recording = recorded();
  const fs::path out = folder_.path() / "tags.txt";
  const ProcessResult result = evaluate(recording, {"--out", out.string(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out);
  const auto truth = recording::readTrajectory(recording / "groundtruth.txt");
  EXPECT_EQ(json["pictures"], truth.size());
  EXPECT_EQ(json["kept"], truth.size());
  for (const char* within : {"error", "error_near"}) {
    EXPECT_EQ(json[within]["poses"], truth.size());
    EXPECT_LT(json[within]["position"]["max_m"], 0.01);
    EXPECT_LT(json[within]["rotation"]["max_deg"], 0.5);
    EXPECT_LE(json[within]["x"]["max_m"], json[within]["position"]["max_m"]);
    EXPECT_LT(json[within]["yaw"]["mean_deg"], 0.2);
  }
  EXPECT_EQ(json["error_near"]["within_m"], 4.0);
  const auto path = recording::readTrajectory(out);
  ASSERT_EQ(path.size(), truth.size());
  EXPECT_LT((path.front().T_map_camera.translation() - Eigen::Vector3d(-0.2, 0.1, 0.0)).norm(), 0.01);
  Eigen::Isometry3d end = Eigen::Isometry3d::Identity();
  end.linear() = Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  end.translation() = Eigen::Vector3d(0.4, 0.1, 0.0);
  EXPECT_LT((path.back().T_map_camera.translation() - end.translation()).norm(), 0.01);
  EXPECT_LT(Eigen::AngleAxisd(path.back().T_map_camera.linear().transpose() * end.linear()).angle(), 0.5 * std::numbers::pi / 180.0);
}

TEST_F(Tags, TheRobotsOwnCameraSeesNoneOfIt) {
  const auto filesOf = [](const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = fs::relative(entry.path(), folder).string();
      if (entry.is_regular_file() && !name.starts_with("ceiling/") && name != "truth/scene.toml") {
        files[name] = base::readFile(entry.path());
      }
    }
    return files;
  };
  EXPECT_EQ(filesOf(recorded()), filesOf(record("without", kScene)));
}

TEST_F(Tags, TheSameBytesForAnyNumberOfThreads) {
  const fs::path one = recorded();
  const fs::path two = record("two", std::string(kScene) + kCeiling, {"--threads", "2"});
  for (const auto& entry : fs::recursive_directory_iterator(one / "ceiling")) {
    if (entry.is_regular_file()) {
      EXPECT_EQ(base::readFile(entry.path()), base::readFile(two / fs::relative(entry.path(), one))) << entry.path();
    }
  }
  EXPECT_EQ(evaluate(one, {"--threads", "1", "--json"}).out, evaluate(two, {"--threads", "2", "--json"}).out);
}

TEST_F(Tags, WithoutTruthThereIsNoError) {
  const fs::path recording = copied();
  fs::remove(recording / "groundtruth.txt");
  const ProcessResult result = evaluate(recording);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("pictures      ")) << result.out;
  EXPECT_EQ(result.out.find("error"), std::string::npos);
  EXPECT_FALSE(Json::parse(evaluate(recording, {"--json"}).out).contains("error"));
}

TEST_F(Tags, ABoardThatIsTooFarIsNoPath) {
  const fs::path recording = recorded();
  const fs::path out = folder_.path() / "tags.txt";
  const ProcessResult result = evaluate(recording, {"--max-distance", "1", "--out", out.string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("kept 0: "), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "oikos: no picture shows all tags of the board near enough; no path\n");
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Tags, SaysWhatIsWrong) {
  expectRefused(folder_.path() / "none", 4, "none: there is no such recording");
  const fs::path recording = copied();
  EXPECT_EQ(evaluate(recording, {"--max-distance", "0"}).exit_code, 2);
  EXPECT_NE(evaluate(recording, {"--max-rms", "-1"}).err.find("max_rms_px = -1: must be > 0"), std::string::npos);
  const std::string camera = base::readFile(recording / "camera.toml");
  (void)folder_.write("recording/groundtruth.txt", "1000 0 0 0 0 0 0 1\n");
  EXPECT_NE(evaluate(recording).err.find("no picture was taken at a time that groundtruth.txt knows"), std::string::npos);
  (void)folder_.write("recording/camera.toml", camera.substr(0, camera.find("T_base_camera")));
  expectRefused(recording, 3, "camera.toml: T_base_camera: is missing: the mount");
  fs::rename(recording / "ceiling", folder_.path() / "elsewhere");
  expectRefused(recording, 3, "recording: has no folder 'ceiling' with the pictures of a camera that watches the robot");
}

}  // namespace
}  // namespace oikos::test
