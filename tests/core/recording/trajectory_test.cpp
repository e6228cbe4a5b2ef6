// SPDX-License-Identifier: Apache-2.0
#include "core/recording/trajectory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::recording {
namespace {

using base::ErrorCode;
using test::expectError;

class TrajectoryFile : public testing::Test {
 protected:
  void expectRejected(const std::string& text, const std::vector<std::string>& parts) const {
    const auto file = folder_.write("t.txt", text);
    expectError(ErrorCode::kInput, parts, [&] { (void)readTrajectory(file); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(TrajectoryFile, ReadsWhatTheBenchmarkWrites) {
  const auto file = folder_.write("t.txt", "# ground truth\n\n1305031229.528748 1.3 0.7 1.5 -0.6698 -0.5253 -0.0414 0.5232\r\n");
  const Trajectory trajectory = readTrajectory(file);
  ASSERT_EQ(trajectory.size(), 1U);
  EXPECT_EQ(trajectory[0].stamp_ns, 1305031229528748000);
  EXPECT_TRUE(trajectory[0].T_map_camera.translation().isApprox(Eigen::Vector3d(1.3, 0.7, 1.5)));
  const Eigen::Matrix3d R = trajectory[0].T_map_camera.linear();
  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST_F(TrajectoryFile, SurvivesTheRoundTrip) {
  Trajectory trajectory;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 0.1 * i, -0.5).normalized();
    trajectory.push_back(
        {1305031229528748123 + i * 33333333LL, Eigen::Translation3d(0.1 * i, -2.0, 1e-7 * i) * Eigen::AngleAxisd(0.31 * i, axis)});
  }
  const auto file = folder_.path() / "t.txt";
  writeTrajectory(trajectory, file);
  const Trajectory again = readTrajectory(file);
  ASSERT_EQ(again.size(), trajectory.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].stamp_ns, trajectory[i].stamp_ns);
    EXPECT_LT((again[i].T_map_camera.translation() - trajectory[i].T_map_camera.translation()).norm(), 1e-9);
    EXPECT_LT((again[i].T_map_camera.linear() - trajectory[i].T_map_camera.linear()).norm(), 4e-9);
  }
}

TEST_F(TrajectoryFile, RejectsWithFileAndLine) {
  const std::string good = "1 0 0 0 0 0 0 1\n";
  expectRejected(good + "2 0 0 0 0 0 1\n", {"t.txt:2", "7 fields instead of 8"});
  expectRejected(good + "# c\nx 0 0 0 0 0 0 1\n", {"t.txt:3", "'x' is not a stamp"});
  expectRejected(good + "2 0 nan 0 0 0 0 1\n", {"t.txt:2", "'nan' is not a finite number"});
  expectRejected(good + "2 0 0 0 0 0 0 1.01\n", {"t.txt:2", "norm 1"});
  expectRejected(good + "0.5 0 0 0 0 0 0 1\n", {"t.txt:2", "before the one above"});
  expectRejected("# nothing\n", {"t.txt", "no pose"});
  expectError(ErrorCode::kIo, {"absent.txt"}, [&] { (void)readTrajectory(folder_.path() / "absent.txt"); });
}

TEST_F(TrajectoryFile, WritingLeavesNothingBehindOnFailure) {
  const auto target = folder_.path() / "taken";
  std::filesystem::create_directories(target / "inside");
  expectError(ErrorCode::kIo, {"taken"}, [&] { writeTrajectory({StampedPose{}}, target); });
  expectError(ErrorCode::kIo, {"none"}, [&] { writeTrajectory({StampedPose{}}, folder_.path() / "none" / "t.txt"); });
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

}  // namespace
}  // namespace oikos::recording
