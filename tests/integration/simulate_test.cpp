// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <sstream>
#include <string>

#include "core/base/read_file.h"
#include "core/recording/depth_png.h"
#include "core/recording/recording.h"
#include "core/recording/trajectory.h"
#include "semantic/xml/home_reader.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using std::chrono::seconds;

constexpr const char* kHome = R"(<apartment id="flat" name="flat" version="1">
  <room id="room" name="room" outline_m="-1 -1.5 4 -1.5 4 1.5 -1 1.5">
    <largeArticulatedObject id="drawers" type="drawer_unit" pose="3 0 0 0 0 180" movability="fixed" graspable="false">
      <shape kind="drawer_unit" width_m="0.6" drawer_count="1" depth_m="0.5" height_m="0.6"/>
      <part id="drawers-body"/>
      <part id="drawers-drawer_0" parent="drawers-body"/>
      <joint id="slide" type="prismatic" parent="drawers-body" child="drawers-drawer_0" origin="0.25 0 0.3 0 0 0" axis="1 0 0"
             lower_m="0" upper_m="0.35" value_m="0"/>
      <parkingPose pose="1 0 0 0 0 180" default="true"/>
      <smallObject id="cup" type="cup" parent="drawers" relation="on" pose="0.1 0 0.6 0 0 0" graspable="false">
        <defaultPlace parent="drawers" relation="on" pose="0.1 0 0.6 0 0 0"/>
        <shape kind="cup" diameter_m="0.2" bottom_diameter_m="0.18" height_m="0.25"/>
      </smallObject>
    </largeArticulatedObject>
  </room>
</apartment>
)";

/// Drives 0.3 m forwards: 1.5 s and the time that it stands.
constexpr const char* kScene = R"(start = "2026-03-02T08:00:00Z"
rate_hz = 4
changes = ["@0.6 slide 0.2 m"]
walkers = ["0 2 2 -1 2 1"]
[camera]
width = 64
height = 48
fx = 50
fy = 50
cx = 31.5
cy = 23.5
height_m = 0.9
tilt_deg = 8
[path]
waypoints = ["0.3 0"]
speed_mps = 0.4
acceleration_mps2 = 0.8
stand_s = 0.25
)";

using Files = std::map<std::string, std::string>;

Files contentOf(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[fs::relative(entry.path(), folder).string()] = base::readFile(entry.path());
    }
  }
  return files;
}

class Simulate : public testing::Test {
 protected:
  Simulate() { (void)folder_.write("home/home.xml", kHome); }

  fs::path scene(const std::string& text = kScene) const { return folder_.write("home/scenes/scene.toml", text); }
  fs::path out(const std::string& name = "recording") const { return folder_.path() / name; }
  std::vector<std::string> arguments(const fs::path& scene, const fs::path& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"simulate", scene.string(), "--out", out.string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  fs::path recorded(const std::string& name, const std::vector<std::string>& more = {}, const std::string& text = kScene) const {
    const ProcessResult result = runOikos(arguments(scene(text), out(name), more));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return out(name);
  }
  bool hasHiddenEntry() const {
    return std::any_of(fs::directory_iterator(folder_.path()), fs::directory_iterator(),
                       [](const auto& entry) { return entry.path().filename().string().starts_with("."); });
  }

  TemporaryFolder folder_;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// 0.3 m at up to 0.4 m/s: two ramps of 0.5 s over 0.1 m each, 0.25 s between; it stands for 0.25 s before.
double wayAt(double time_s) {
  const double t = std::clamp(time_s - 0.25, 0.0, 1.25);
  if (t < 0.5) {
    return 0.4 * t * t;
  }
  return t < 0.75 ? 0.1 + 0.4 * (t - 0.5) : 0.3 - 0.4 * (1.25 - t) * (1.25 - t);
}

TEST_F(Simulate, MakesARecordingThatIsRead) {
  const auto recording = recording::openRecording(recorded("recording"));
  EXPECT_EQ(recording->format(), "TUM RGB-D");
  ASSERT_EQ(recording->frameCount(), 8);  // 1.75 s at 4 Hz
  EXPECT_EQ(recording->camera().width, 64);
  EXPECT_EQ(recording->startNs(), 1'772'438'400'000'000'000);
  EXPECT_EQ(recording->listing().unmatched_color + recording->listing().unmatched_depth, 0);
  for (int i = 0; i < recording->frameCount(); ++i) {
    EXPECT_EQ(recording->stampNs(i), std::int64_t{250'000'000} * i);
    const camera::RgbdFrame frame = recording->read(i, recording::Channels::kColor);
    EXPECT_EQ(frame.color.cols, 64);
    EXPECT_GT(cv::countNonZero(frame.depth_m == frame.depth_m), 64 * 48 / 3);
  }
}

TEST_F(Simulate, TheTruthIsThePath) {
  const fs::path folder = recorded("recording");
  const recording::Trajectory truth = recording::readTrajectory(folder / "groundtruth.txt");
  ASSERT_EQ(truth.size(), 8U);
  const Eigen::Isometry3d T_base_camera = recording::openRecording(folder)->T_base_camera().value();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Isometry3d expected = Eigen::Translation3d(wayAt(0.25 * static_cast<double>(i)), 0.0, 0.0) * T_base_camera;
    EXPECT_TRUE(truth[i].T_map_camera.isApprox(expected, 1e-6)) << i;
  }
  EXPECT_EQ(recording::readTrajectory(folder / "odometry.txt").size(), 8U);
  EXPECT_EQ(recording::readTrajectory(folder / "prior.txt").size(), 8U);
}

TEST_F(Simulate, AnIdealSensorReadsTheWallsDistance) {
  std::string text = replaced(kScene, "rate_hz = 4", "rate_hz = 4\nsensor = \"ideal\"");
  text = replaced(replaced(text, "walkers = [\"0 2 2 -1 2 1\"]", ""), "tilt_deg = 8", "tilt_deg = 0");
  const fs::path folder = recorded("recording", {}, text);
  const auto recording = recording::openRecording(folder);
  for (const int i : {0, 7}) {
    const camera::RgbdFrame frame = recording->read(i, recording::Channels::kGray);
    // The wall x = 4 m above the drawers; the camera stands 0.1 m before the base.
    EXPECT_NEAR(frame.depth_m.at<float>(10, 31), 4.0 - 0.1 - wayAt(0.25 * i), 0.0006) << i;
  }
}

TEST_F(Simulate, StatesAndObjectsAreLogged) {
  const fs::path folder = recorded("recording");
  EXPECT_EQ(base::readFile(folder / "truth/states.csv"), "t,id,value,unit\n0,slide,0,m\n0.75,slide,0.2,m\n");
  std::istringstream lines(base::readFile(folder / "truth/objects.jsonl"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const Json frame = Json::parse(line);
    EXPECT_EQ(frame["t"], 0.25 * count);
    for (const Json& object : frame["objects"]) {
      EXPECT_EQ(object["id"], "cup");
      const Eigen::Vector3d camera_m(object["T_camera_object"][0], object["T_camera_object"][1], object["T_camera_object"][2]);
      const Eigen::Isometry3d T_map_camera = recording::readTrajectory(folder / "groundtruth.txt").at(count).T_map_camera;
      EXPECT_LT((T_map_camera * camera_m - Eigen::Vector3d(2.9, 0.0, 0.6)).norm(), 1e-5);
    }
  }
  EXPECT_EQ(count, 8);
  const semantic::Home end = semantic::getHome(semantic::readHome(folder / "truth/home.xml"), folder / "truth/home.xml");
  EXPECT_EQ(end.rooms.at(0).objects.at(0)->articulation->joints.at(0).value, 0.2);
}

TEST_F(Simulate, PartImagesSayWhatEachPixelShows) {
  const fs::path folder = recorded("recording", {}, std::string("part_images = true\n") + kScene);
  std::map<std::string, int> numbers;
  std::istringstream table(base::readFile(folder / "truth/parts.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "number,id,part");
  while (std::getline(table, line)) {
    const std::size_t id = line.find(',') + 1;
    numbers[line.substr(id, line.find(',', id) - id)] = std::stoi(line);
  }
  ASSERT_EQ(numbers.count("cup"), 1U);
  std::istringstream frames(base::readFile(folder / "truth/objects.jsonl"));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / "truth/parts")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ASSERT_EQ(files.size(), 8U);
  for (const fs::path& file : files) {
    ASSERT_TRUE(std::getline(frames, line));
    const cv::Mat parts = recording::decodeDepthPng(base::readFile(file), file.string());
    EXPECT_EQ(cv::countNonZero(parts), 64 * 48) << "a closed room";
    cv::Rect seen = {0, 0, 0, 0};
    const cv::Mat is_cup = parts == numbers["cup"];
    for (int v = 0; v < parts.rows; ++v) {
      for (int u = 0; u < parts.cols; ++u) {
        seen = is_cup.at<std::uint8_t>(v, u) != 0 ? seen | cv::Rect(u, v, 1, 1) : seen;
      }
    }
    const Json objects = Json::parse(line)["objects"];
    ASSERT_EQ(objects.size(), seen.empty() ? 0U : 1U);
    if (!seen.empty()) {
      EXPECT_EQ(objects[0]["box_px"], Json::array({seen.x, seen.y, seen.br().x - 1, seen.br().y - 1}));
    }
  }
}

TEST_F(Simulate, TheWrittenSceneMakesTheSameRecording) {
  const fs::path first = recorded("first", {"--seed", "3"});
  const std::string scene = base::readFile(first / "truth/scene.toml");
  EXPECT_TRUE(scene.starts_with("# oikos simulate --seed 3\n")) << scene;
  EXPECT_EQ(contentOf(recorded("second", {"--seed", "3"}, scene)), contentOf(first));
}

TEST_F(Simulate, TheSameBytesForAnyNumberOfThreads) {
  const Files one = contentOf(recorded("one", {"--threads", "1"}));
  EXPECT_EQ(one.size(), 8U * 2 + 10);
  EXPECT_EQ(contentOf(recorded("two", {"--threads", "2"})), one);
  EXPECT_EQ(contentOf(recorded("again", {"--threads", "1"})), one);
}

TEST_F(Simulate, TheTrueHomeDiffersFromTheBelievedOneAsTold) {
  const std::string text = std::string(kScene) +
                           "[belief]\ndimension_m = 0.01\nplacement_m = 0.02\naxis_deg = 0.5\nwall_deg = 0.5\nextra_part_share = 1\n"
                           "clutter = 3\nmount_deg = 0.5\nintrinsics_share = 0.01\n";
  const Files plain = contentOf(recorded("plain"));
  const Files one = contentOf(recorded("one", {"--threads", "1"}, text));
  EXPECT_EQ(contentOf(recorded("two", {"--threads", "2"}, text)), one);
  EXPECT_EQ(one.at("camera.toml"), plain.at("camera.toml"));
  EXPECT_NE(one.at("truth/home.xml"), plain.at("truth/home.xml"));
  EXPECT_NE(one.at("groundtruth.txt"), plain.at("groundtruth.txt"));  // the camera is not where its mount says
  const fs::path file = out("one") / "truth/home.xml";
  const semantic::Home home = semantic::getHome(semantic::readHome(file), file);
  const double shift_m = (home.rooms.at(0).objects.at(0)->T_map_object.position_m - Eigen::Vector3d(3.0, 0.0, 0.0)).norm();
  EXPECT_GT(shift_m, 1e-4);
  EXPECT_LT(shift_m, 0.02 * 6.0);
}

TEST_F(Simulate, AnotherSeedIsAnotherRecording) {
  const Files first = contentOf(recorded("first", {"--seed", "1"}));
  const Files second = contentOf(recorded("second", {"--seed", "2"}));
  for (const char* file : {"rgb/0.000000.jpg", "depth/0.000000.png", "odometry.txt", "prior.txt"}) {
    ASSERT_TRUE(first.contains(file)) << file;
    EXPECT_NE(first.at(file), second.at(file)) << file;
  }
  for (const char* file : {"camera.toml", "groundtruth.txt", "truth/states.csv"}) {
    EXPECT_EQ(first.at(file), second.at(file)) << file;
  }
}

TEST_F(Simulate, LostFramesAreCounted) {
  const std::string text = replaced(replaced(kScene, "rate_hz = 4", "rate_hz = 20"), "tilt_deg = 8", "tilt_deg = 8\nlost_share = 0.4");
  const ProcessResult result = runOikos(arguments(scene(text), out(), {"--json"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["frames"].get<int>() + json["lost_frames"].get<int>(), 36);
  EXPECT_EQ(json["recording"], out().string());
  EXPECT_NEAR(json["lost_frames"].get<double>(), 0.4 * 36, 4.0 * std::sqrt(36 * 0.4 * 0.6));
  EXPECT_EQ(recording::openRecording(out())->frameCount(), json["frames"]);
  EXPECT_EQ(recording::readTrajectory(out() / "odometry.txt").size(), 36U);
}

TEST_F(Simulate, AFolderThatIsThereIsRefused) {
  fs::create_directory(out());
  const ProcessResult result = runOikos(arguments(scene(), out()));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "oikos: " + out().string() + ": is there already: give a new folder, or remove it first\n");
  EXPECT_TRUE(fs::is_empty(out()));
  EXPECT_FALSE(hasHiddenEntry());
}

TEST_F(Simulate, ASceneElsewhereIsRefused) {
  const fs::path elsewhere = folder_.write("scene.toml", kScene);
  const ProcessResult result = runOikos(arguments(elsewhere, out()));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err, "oikos: " + elsewhere.string() +
                            ": a scene lies in the folder scenes of the home that it is about, beside whose home.xml it finds it\n");
  EXPECT_FALSE(fs::exists(out()));
  EXPECT_FALSE(hasHiddenEntry());
}

TEST_F(Simulate, SaysWhatIsWrongWithAScene) {
  const auto expectRefused = [&](const std::string& text, int exit_code, const std::string& message) {
    const ProcessResult result = runOikos(arguments(scene(text), out()));
    EXPECT_EQ(result.exit_code, exit_code);
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(out()));
    EXPECT_FALSE(hasHiddenEntry());
  };
  expectRefused("ratehz = 3\n", 3, "scene.toml:1: ");
  expectRefused("changes = [\"@3 lid 3 deg\"]\n", 3, "scene.toml: changes: 'lid' is no joint of this home");
  expectRefused("[path]\nwaypoints = [\"1e9 0\"]\n", 3, "must be at most a day; give duration_s");
  (void)folder_.write("home/home.xml", replaced(kHome, "movability=\"fixed\"", "movability=\"glued\""));
  expectRefused(kScene, 3, "home.xml:3: ");
}

TEST_F(Simulate, BadUseEndsWith2AndNoSceneWith4) {
  EXPECT_EQ(runOikos({"simulate"}).exit_code, 2);
  EXPECT_EQ(runOikos({"simulate", scene().string()}).exit_code, 2);
  EXPECT_EQ(runOikos(arguments(folder_.path() / "home/scenes/none.toml", out())).exit_code, 4);
  EXPECT_EQ(runOikos(arguments(scene(), folder_.path() / "nowhere/recording")).exit_code, 4);
  EXPECT_FALSE(fs::exists(folder_.path() / "nowhere"));
}

/// One that would take hours.
std::string longScene() {
  return replaced(kScene, "rate_hz = 4", "rate_hz = 30\nduration_s = 10000");
}

void waitForPictures(Process& process, const fs::path& folder) {
  while (!fs::exists(folder) || fs::is_empty(folder)) {
    ASSERT_FALSE(process.hasEndedWithin(std::chrono::milliseconds(20)));
  }
}

TEST_F(Simulate, AnInterruptLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::vector<std::string> command = arguments(scene(longScene()), out());
    command.insert(command.begin(), oikosBinary());
    Process process(command);
    waitForPictures(process, folder_.path() / ".recording.new/recording/rgb");
    process.send(signal);
    ASSERT_TRUE(process.hasEndedWithin(seconds(5)));
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err, "\noikos: interrupted; " + out().string() + " was not made\n");
    EXPECT_FALSE(fs::exists(out()));
    EXPECT_FALSE(hasHiddenEntry());
  }
}

TEST_F(Simulate, KilledItLeavesNoHalfRecording) {
  std::vector<std::string> command = arguments(scene(longScene()), out());
  command.insert(command.begin(), oikosBinary());
  Process process(command);
  waitForPictures(process, folder_.path() / ".recording.new/recording/rgb");
  process.send(SIGKILL);
  EXPECT_EQ(process.finish().exit_code, -SIGKILL);
  EXPECT_FALSE(fs::exists(out()));
  const auto recording = recording::openRecording(recorded("recording"));  // what was left does not hinder the next
  EXPECT_EQ(recording->frameCount(), 8);
  EXPECT_FALSE(hasHiddenEntry());
}

}  // namespace
}  // namespace oikos::test
