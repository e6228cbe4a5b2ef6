// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_setup.h"

#include <gtest/gtest.h>

#include "core/base/config.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::tags {
namespace {

void expectRefused(const std::string& toml, const std::vector<std::string>& parts) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("tags.toml", toml);
  test::expectError(base::ErrorCode::kInput, parts, [&] { (void)readTagSetup(file); });
}

TEST(TagSetup, IsReadAsWritten) {
  TagSetup setup;
  const Eigen::Isometry3d T = Eigen::Translation3d(1.0, -2.0, 2.4) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0);
  setup.T_map_camera = numbersOf(T);
  setup.board.columns = 4;
  const test::TemporaryFolder folder;
  const TagSetup read = readTagSetup(folder.write("tags.toml", base::writeConfig(setup)));
  EXPECT_TRUE(poseOf(read.T_map_camera).isApprox(T, 1e-12));
  EXPECT_TRUE(poseOf(read.T_base_board).isApprox(Eigen::Isometry3d::Identity(), 1e-15));
  EXPECT_EQ(read.board.columns, 4);
}

TEST(TagSetup, SaysWhatIsWrong) {
  const std::string rule = "must be seven finite numbers tx, ty, tz (m), qx, qy, qz, qw, the quaternion of norm 1 (within 0.001)";
  expectRefused("T_map_camera = [1, 2, 3]\n", {"tags.toml:1", "T_map_camera = [1, 2, 3]: " + rule});
  expectRefused("\nT_base_board = []\n", {"tags.toml:2", "T_base_board = []: " + rule});
  expectRefused("T_map_camera = [0, 0, 0, 0, 0, 0, 2]\n", {"tags.toml:1", "[0, 0, 0, 0, 0, 0, 2]: " + rule});
  expectRefused("[board]\ncolums = 3\n", {"tags.toml:2", "board.colums", "board.columns"});
  expectRefused("[board]\ntag_size_m = -1\n", {"tags.toml:2", "board.tag_size_m = -1: must be from 0.01 to 2"});
  test::expectError(base::ErrorCode::kIo, {"none.toml"}, [] { (void)readTagSetup("none.toml"); });
}

}  // namespace
}  // namespace oikos::tags
