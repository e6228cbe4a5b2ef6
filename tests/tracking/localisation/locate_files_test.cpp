// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/locate_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/read_file.h"
#include "core/recording/trajectory.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"
#include "tests/support/temporary_folder.h"

namespace oikos::tracking {
namespace {

std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::istringstream text(base::readFile(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    lines.push_back(line);
  }
  return lines;
}

LocatedPose foundPose() {
  LocatedPose pose;
  pose.frame = 3;
  pose.stamp_ns = 1'500'000'000;
  pose.source = PoseSource::kLandmarks;
  pose.T_map_camera.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
  pose.T_map_camera_before = Eigen::Isometry3d(Eigen::Translation3d(1.1, 2.0, 3.0));
  pose.covariance.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  pose.covariance(0, 5) = pose.covariance(5, 0) = 0.25;
  pose.landmarks.emplace();
  pose.landmarks->status = registration::RefinementStatus::kRefined;
  pose.landmarks->landmarks.push_back({"fridge", registration::LandmarkVerdict::kChanged, 900, 800, 1.0, 0.5, {"door", "drawer"}});
  return pose;
}

TEST(LocateFiles, FoundAndLostFrames) {
  const test::TemporaryFolder folder;
  LocatedPose lost;
  lost.frame = 4;
  lost.stamp_ns = 1'600'000'000;
  const Eigen::Isometry3d T_base_camera(Eigen::Translation3d(0.0, 0.0, 1.0));
  writeLocated({foundPose(), lost}, T_base_camera, folder.path() / "out.txt");
  const recording::Trajectory found = recording::readTrajectory(folder.path() / "out.txt");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].stamp_ns, 1'500'000'000);
  EXPECT_TRUE(found[0].T_map_camera.translation().isApprox(Eigen::Vector3d(1.0, 2.0, 3.0)));
  EXPECT_TRUE(
      recording::readTrajectory(folder.path() / "out.base.txt")[0].T_map_camera.translation().isApprox(Eigen::Vector3d(1.0, 2.0, 2.0)));
  EXPECT_TRUE(
      recording::readTrajectory(folder.path() / "out.before.txt")[0].T_map_camera.translation().isApprox(Eigen::Vector3d(1.1, 2.0, 3.0)));
  const std::vector<std::string> csv = linesOf(folder.path() / "out.csv");
  ASSERT_EQ(csv.size(), 3U);
  for (const std::string& line : csv) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(csv[0].begin(), csv[0].end(), ',')) << line;
  }
  EXPECT_EQ(csv[1],
            "1.500000,3,landmarks,no "
            "place,0,refined,1,2,3,0,0,0,1,1,0,0,0,0,0.25,0,2,0,0,0,0,0,0,3,0,0,0,0,0,0,4,0,0,0,0,0,0,5,0,0.25,0,0,0,0,6");
  EXPECT_TRUE(csv[2].starts_with("1.600000,4,none,no place,0,,,"));
  const std::vector<std::string> landmarks = linesOf(folder.path() / "out.landmarks.csv");
  ASSERT_EQ(landmarks.size(), 2U);
  EXPECT_EQ(landmarks[1], "1.500000,3,fridge,changed,900,800,1,0.5,door drawer");
}

TEST(LocateFiles, WithoutFurnitureAndMountThereAreFewer) {
  const test::TemporaryFolder folder;
  LocatedPose pose = foundPose();
  pose.landmarks.reset();
  writeLocated({pose}, std::nullopt, folder.path() / "out.txt");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.before.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.landmarks.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.base.txt"));
}

TEST(PoseSource, HasNames) {
  test::checkEnumTable(PoseSource::kLandmarks);
}

TEST(LocaliseConfig, RulesAreChecked) {
  EXPECT_EQ(base::validateConfig(LocaliseConfig{}), std::vector<std::string>());
  LocaliseConfig config;
  config.prior_sigma_m = 0.0;
  EXPECT_EQ(config.validate(), std::vector<std::string>{"prior_sigma_m = 0: must be > 0"});
}

}  // namespace
}  // namespace oikos::tracking
