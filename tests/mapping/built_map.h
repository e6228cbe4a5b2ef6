// SPDX-License-Identifier: Apache-2.0
// Short drives through the furnished room, and the maps that are built of them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "mapping/mapper.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/textured_recording.h"

namespace oikos::mapping {

inline constexpr double kTilt = 0.45;  ///< metres down a metre ahead

/// A camera at 1.2 m that looks at the floor and the table while it turns.
inline std::vector<Eigen::Isometry3d> shortDrive(int frames, double begin_deg, double turn_deg) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < frames; ++i) {
    const double yaw_rad = (begin_deg + turn_deg * i / frames) * std::numbers::pi / 180.0;
    const Eigen::Vector3d ahead(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    const Eigen::Vector3d eye = Eigen::Vector3d(-0.6, 0.2, 1.2) + 0.2 * ahead;
    poses.push_back(test::lookAt(eye, eye + ahead - kTilt * Eigen::Vector3d::UnitZ()));
  }
  return poses;
}

inline test::SyntheticSensor noisySensor() {
  test::SyntheticSensor sensor;
  sensor.gray_sigma = 2.0;
  sensor.depth_sigma_scale = 1.0;
  return sensor;
}

/// With whatever else a recording may have.
class RichRecording : public test::SyntheticRecording {
 public:
  using SyntheticRecording::SyntheticRecording;
  std::set<int> unreadable;
  std::optional<recording::Trajectory> T_odom_base;
  std::optional<Eigen::Isometry3d> mount;

  [[nodiscard]] camera::RgbdFrame read(int index, recording::Channels channels) const override {
    if (unreadable.contains(index)) {
      throw base::Error(base::ErrorCode::kInput, "the image is cut short", "frame " + std::to_string(index));
    }
    return SyntheticRecording::read(index, channels);
  }
  [[nodiscard]] std::optional<recording::Trajectory> findOdometry() const override { return T_odom_base; }
  [[nodiscard]] std::optional<Eigen::Isometry3d> T_base_camera() const override { return mount; }
};

inline RichRecording richRecording(const std::vector<Eigen::Isometry3d>& drive, const test::SyntheticSensor& sensor = noisySensor()) {
  return {test::TexturedWorld::furnished(), test::texturedCamera(), drive, sensor};
}

/// As the drive has it: the base under the camera, x where it looks to.
inline Eigen::Isometry3d trueMount() {
  const double down_rad = std::atan(kTilt);
  Eigen::Matrix3d R_level_camera;
  R_level_camera << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() = Eigen::AngleAxisd(down_rad, Eigen::Vector3d::UnitY()).toRotationMatrix() * R_level_camera;
  T_base_camera.translation() = Eigen::Vector3d(0.15, 0.0, 1.2);
  return T_base_camera;
}

struct Built {
  test::TemporaryFolder folder;
  MapResult result;

  explicit Built(const recording::Recording& recording, const MapRun& run = {}, const MapConfig& config = {})
      : result(buildMap(recording, config, run, folder.path())) {}

  [[nodiscard]] recording::Trajectory trajectory(const char* name = "trajectory.txt") const {
    return recording::readTrajectory(folder.path() / name);
  }

  /// By name; the timing is the only file that may differ.
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      contents[entry.path().filename().string()] = base::readFile(entry.path());
    }
    return contents;
  }
};

inline void expectSameButForTiming(const Built& a, const Built& b) {
  const auto files_a = a.files();
  const auto files_b = b.files();
  ASSERT_EQ(files_a.size(), files_b.size());
  for (const auto& [name, content] : files_a) {
    if (name != "timing.json") {
      ASSERT_TRUE(files_b.contains(name)) << name;
      EXPECT_TRUE(content == files_b.at(name)) << name << " differs";
    }
  }
}

inline double distance_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}
inline double turn_rad(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

}  // namespace oikos::mapping
