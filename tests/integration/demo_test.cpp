// SPDX-License-Identifier: Apache-2.0
// `oikos demo` as a whole: simulate, map into a copy of the home, ask, and the page and picture to look at.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "core/base/read_file.h"
#include "core/metrics/trajectory_error.h"
#include "core/recording/image_codec.h"
#include "core/recording/trajectory.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSmallPictures = R"(
[camera]
width = 320
height = 240
fx = 262.5
fy = 262.5
cx = 159.5
cy = 119.5
)";

/// From the dock a little into the hall and about.
constexpr const char* kScene = R"(start = "2026-03-02T08:00:00Z"
rate_hz = 6
sensor = "kinect1"
[path]
waypoints = ["1.1 0.1", "1.1 0.1 yaw 120", "1.1 0.1 yaw -120", "0 0 yaw 0"]
speed_mps = 0.8
acceleration_mps2 = 0.8
turn_rate_dps = 60
turn_acceleration_dps2 = 120
)";

/// The kitchen's door was opened meanwhile.
constexpr const char* kThen = R"(start = "2026-03-02T09:00:00Z"
rate_hz = 6
sensor = "kinect1"
changes = ["kitchen-door-door-joint 60 deg"]
[path]
start = [0.4, 0.0, 10.0]
waypoints = ["0.6 0.0 yaw 60"]
speed_mps = 0.4
)";

class Demo : public testing::Test {
 protected:
  Demo() {
    fs::create_directories(home() / "scenes");
    fs::copy_file(fs::path(OIKOS_SOURCE_DIR) / "homes/demo/home.xml", home() / "home.xml");
    (void)folder_.write("home/scenes/short.toml", std::string(kScene) + kSmallPictures);
    (void)folder_.write("home/scenes/then.toml", std::string(kThen) + kSmallPictures);
  }
  [[nodiscard]] fs::path home() const { return folder_.path() / "home"; }
  [[nodiscard]] fs::path out() const { return folder_.path() / "out"; }
  [[nodiscard]] ProcessResult run(const std::string& scene, const std::string& then = "") const {
    return runOikos({"demo", "--home", home().string(), "--scene", scene, "--then", then, "--out", out().string()});
  }

  TemporaryFolder folder_;
};

/// Of the pixels that are not as the first one: of a picture of nothing, none.
double shareDrawn(const cv::Mat& picture) {
  const cv::Vec3b corner = picture.at<cv::Vec3b>(0, 0);
  cv::Mat same;
  cv::inRange(picture, corner, corner, same);
  return 1.0 - static_cast<double>(cv::countNonZero(same)) / static_cast<double>(picture.total());
}

TEST_F(Demo, SimulatesMapsAsksAndShows) {
  const std::string before = base::readFile(home() / "home.xml");
  const ProcessResult result = run("short", "then");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("> Where is the blue cup?\n2 things fit: the blue cup on the kitchen table in the kitchen"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("Go to the fridge"), std::string::npos) << result.out;

  const metrics::TrajectoryError error = metrics::evaluateTrajectory(recording::readTrajectory(out() / "home/map/trajectory.txt"),
                                                                     recording::readTrajectory(out() / "drive/groundtruth.txt"), {});
  EXPECT_GT(error.association_count, 80);
  EXPECT_LT(error.absolute_m.rmse, 0.02);
  for (const char* made : {"cloud.ply", "mesh.ply", "octomap.bt", "grid.pgm", "report.html", "rooms/hall.ply"}) {
    EXPECT_TRUE(fs::exists(out() / "home/map" / made)) << made;
  }
  const cv::Mat floor = recording::decodeColorImage(base::readFile(out() / "floor.png"), "floor.png");
  EXPECT_GT(shareDrawn(floor), 0.05);
  const std::string page = base::readFile(out() / "report.html");
  EXPECT_NE(result.out.find("  kitchen-door-door-joint opened 0.0 deg -> "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("before: No recording has been read yet.\nafter:  The kitchen door"), std::string::npos) << result.out;
  EXPECT_GT(shareDrawn(recording::decodeColorImage(base::readFile(out() / "floor-later.png"), "floor-later.png")), 0.05);
  for (const char* part : {"Where is the blue cup?", "2 things fit", "kitchen-door-door-joint opened", "what shows it",
                           "data:image/png;base64,", "data:image/jpeg;base64,", "ATE RMSE"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(base::readFile(home() / "home.xml"), before) << "the demo works on a copy";
  EXPECT_FALSE(fs::exists(home() / "map"));
}

TEST_F(Demo, SaysWhichSceneIsMissing) {
  const ProcessResult result = run("nowhere");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("has no scene 'nowhere'; it has: short, then"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(out()));
  const ProcessResult second = run("short", "nowhere");
  EXPECT_EQ(second.exit_code, 2) << second.err;
  EXPECT_NE(second.err.find("has no scene 'nowhere'"), std::string::npos) << second.err;
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Demo, SaysWhatIsNoHome) {
  fs::remove(home() / "home.xml");
  const ProcessResult result = run("short");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("has no home.xml"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(out() / "drive"));
}

}  // namespace
}  // namespace oikos::test
