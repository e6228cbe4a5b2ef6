// SPDX-License-Identifier: Apache-2.0
#include "core/camera/calibration.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::camera {
namespace {

using base::ErrorCode;
using test::expectError;

constexpr const char* kFull = R"(width = 640
height = 480
fx = 525.5
fy = 526
cx = 322.875
cy = 235.875
distortion = [0.1, -0.2, 0.001, 0.002, 0.3]
depth_scale = 5000
start = 2024-05-17T09:30:00.5+02:00
rate_hz = 15
T_base_camera = [0.1, 0.2, 1.2, -0.5, 0.5, -0.5, 0.5]
[depth]
width = 320
height = 240
fx = 290.0
fy = 291.0
cx = 160.0
cy = 120.0
T_color_depth = [-0.032, 0.0076, 0.0, 0.0, 0.0, 0.0, 1.0]
)";

class CalibrationFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& text) const { return folder_.write("camera.toml", text); }
  /// The full file with one text replaced.
  [[nodiscard]] std::filesystem::path writeChanged(const std::string& from, const std::string& to) const {
    std::string text = kFull;
    text.replace(text.find(from), from.size(), to);
    return write(text);
  }
  void expectRejected(const std::string& from, const std::string& to, const std::vector<std::string>& parts) const {
    const auto file = writeChanged(from, to);
    expectError(ErrorCode::kInput, parts, [&] { (void)readCalibration(file); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(CalibrationFile, ReadsEveryKey) {
  const Calibration calibration = readCalibration(write(kFull));
  EXPECT_EQ(calibration.color.width, 640);
  EXPECT_EQ(calibration.color.height, 480);
  EXPECT_EQ(calibration.color.fx, 525.5);
  EXPECT_EQ(calibration.color.fy, 526.0);
  EXPECT_EQ(calibration.color.cx, 322.875);
  EXPECT_EQ(calibration.color.cy, 235.875);
  EXPECT_EQ(calibration.distortion.k1, 0.1);
  EXPECT_EQ(calibration.distortion.k2, -0.2);
  EXPECT_EQ(calibration.distortion.p1, 0.001);
  EXPECT_EQ(calibration.distortion.p2, 0.002);
  EXPECT_EQ(calibration.distortion.k3, 0.3);
  EXPECT_EQ(calibration.depth_scale, 5000.0);
  EXPECT_EQ(calibration.rate_hz, 15.0);
  EXPECT_EQ(calibration.start_ns, 1715931000500000000);
  ASSERT_TRUE(calibration.T_base_camera.has_value());
  EXPECT_TRUE((*calibration.T_base_camera * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1.1, 0.2, 1.2), 1e-12));
  ASSERT_TRUE(calibration.depth.has_value());
  EXPECT_EQ(calibration.depth->pinhole.width, 320);
  EXPECT_EQ(calibration.depth->pinhole.fy, 291.0);
  EXPECT_EQ(calibration.depth->T_color_depth.translation().x(), -0.032);
}

TEST_F(CalibrationFile, DepthsDistortionIsThatOfARealSensorIfNotSaid) {
  const std::string scale = "depth_scale = 5000";
  EXPECT_EQ(readCalibration(write(kFull)).depth_distortion, 0.003);
  EXPECT_EQ(readCalibration(writeChanged(scale, scale + "\ndepth_distortion = 0.008")).depth_distortion, 0.008);
  EXPECT_EQ(readCalibration(writeChanged(scale, scale + "\ndepth_distortion = 0")).depth_distortion, 0.0);
  for (const std::string wrong : {"-0.001", "0.3", "nan", "\"small\""}) {
    expectRejected(scale, scale + "\ndepth_distortion = " + wrong,
                   {"camera.toml:9", "depth_distortion", "a share of the distance from 0 to 0.2"});
  }
}

TEST_F(CalibrationFile, DepthMayBeCorrected) {
  EXPECT_TRUE(readCalibration(write(kFull)).depth->correction.isZero());
  const std::string pose = "T_color_depth = [-0.032, 0.0076, 0.0, 0.0, 0.0, 0.0, 1.0]";
  const DepthCorrection correction =
      readCalibration(writeChanged(pose, pose + "\ncorrection = [-0.01, 0.002, 0.03, -0.04]")).depth->correction;
  EXPECT_EQ(correction.constant, -0.01);
  EXPECT_EQ(correction.per_m, 0.002);
  EXPECT_EQ(correction.across, 0.03);
  EXPECT_EQ(correction.down, -0.04);
  expectRejected(pose, pose + "\ncorrection = [-0.01, 0.002, 0.03]", {"camera.toml:20", "depth.correction", "4 numbers"});
  expectRejected(pose, pose + "\ncorrection = [-0.01, 0.3, 0.03, 0.0]", {"camera.toml:20", "depth.correction", "from -0.2 to 0.2"});
}

TEST_F(CalibrationFile, StartMayBeText) {
  const auto file = writeChanged("2024-05-17T09:30:00.5+02:00", "\"2024-05-17T07:30:00.5Z\"");
  EXPECT_EQ(readCalibration(file).start_ns, 1715931000500000000);
}

TEST_F(CalibrationFile, UnknownKeyNamesTheNearest) {
  expectRejected("depth_scale", "depth_scales", {"camera.toml:8", "depth_scales", "'depth_scale'"});
  expectRejected("T_color_depth", "T_colour_depth", {"camera.toml:19", "'depth.T_color_depth'"});
}

TEST_F(CalibrationFile, BadValuesNameLineAndKey) {
  expectRejected("width = 640", "width = 640.5", {"camera.toml:1", "width = 640.5", "whole number"});
  expectRejected("fx = 525.5", "fx = -525.5", {"camera.toml:3", "fx = -525.5", "> 0"});
  expectRejected("fx = 525.5", "fx = nan", {"camera.toml:3", "finite"});
  expectRejected("fx = 525.5", "fx = \"525\"", {"camera.toml:3", "number"});
  expectRejected("cx = 322.875", "cx = 3228.75", {"camera.toml:5", "inside the image"});
  expectRejected("cy = 235.875\n", "", {"cy", "is missing"});
  expectRejected("depth_scale = 5000\n", "", {"depth_scale", "is missing", "1000"});
  expectRejected("[0.1, -0.2, 0.001, 0.002, 0.3]", "[0.1, -0.2]", {"camera.toml:7", "5 numbers"});
  expectRejected("[0.1, -0.2, 0.001", "[0.1, \"a\", 0.001", {"camera.toml:7", "element 2"});
  expectRejected("rate_hz = 15", "rate_hz = 0", {"camera.toml:10", "rate_hz"});
  expectRejected("2024-05-17T09:30:00.5+02:00", "2024-05-17", {"camera.toml:9", "RFC 3339"});
  expectRejected("0.0, 0.0, 0.0, 1.0]", "0.0, 0.0, 0.0, 1.1]", {"camera.toml:19", "depth.T_color_depth", "norm 1"});
  expectRejected("width = 320", "width = 3", {"camera.toml:13", "depth.width"});
  expectRejected("height = 480", "height = = 480", {"camera.toml:2"});
}

TEST_F(CalibrationFile, DepthMustBeATable) {
  const auto file = write("width = 64\nheight = 48\nfx = 50\nfy = 50\ncx = 30\ncy = 20\ndepth_scale = 1000\ndepth = 3\n");
  expectError(ErrorCode::kInput, {"camera.toml:8", "[depth]"}, [&] { (void)readCalibration(file); });
}

TEST_F(CalibrationFile, MissingFile) {
  expectError(ErrorCode::kIo, {"absent.toml"}, [&] { (void)readCalibration(folder_.path() / "absent.toml"); });
}

TEST(CalibrationPresets, EveryNameIsFound) {
  EXPECT_EQ(calibrationPresetNames().size(), 5U);
  for (const std::string& name : calibrationPresetNames()) {
    const auto preset = findCalibrationPreset(name);
    ASSERT_TRUE(preset.has_value()) << name;
    EXPECT_EQ(preset->color.width, 640) << name;
    EXPECT_GT(preset->color.fy, 0.0) << name;
  }
  EXPECT_EQ(findCalibrationPreset("tum-fr1")->distortion.k3, 1.1633);
  EXPECT_TRUE(findCalibrationPreset("tum-fr3")->distortion.isZero());
  EXPECT_EQ(findCalibrationPreset("kinect1")->depth_scale, 1000.0);
}

TEST(CalibrationPresets, UnknownNameSuggestsTheNearest) {
  EXPECT_FALSE(findCalibrationPreset("tum-fr4").has_value());
  expectError(ErrorCode::kUsage, {"kinect2", "kinect1"}, [] { (void)getCalibration("kinect2"); });
}

}  // namespace
}  // namespace oikos::camera
