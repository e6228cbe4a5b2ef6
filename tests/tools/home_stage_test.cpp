// SPDX-License-Identifier: Apache-2.0
#include "tools/home_stage.h"

#include <gtest/gtest.h>

#include <numbers>

#include <filesystem>
#include <string>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/read_file.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"
#include "tools/interrupts.h"

namespace oikos::tools {
namespace {

namespace fs = std::filesystem;

class HomeStageTest : public ::testing::Test {
 protected:
  void stageMap(const std::string& content, bool commit = true) {
    HomeStage stage(home_, interrupts_);
    EXPECT_TRUE(fs::is_empty(stage.mapFolder()));
    base::writeFileAtomically(stage.mapFolder() / "config.toml", content);
    if (commit) {
      stage.commit();
    }
  }
  [[nodiscard]] std::string map() const { return base::readFile(home_ / "map/config.toml"); }
  [[nodiscard]] static std::ptrdiff_t countEntries(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  }

  test::TemporaryFolder folder_;
  Interrupts interrupts_;
  fs::path home_ = folder_.path() / "new/home";
};

TEST_F(HomeStageTest, NewHomeAppearsWithItsParentsAndASingleRoom) {
  stageMap("first");
  EXPECT_EQ(map(), "first");
  EXPECT_NE(base::readFile(home_ / "home.xml").find("<room id=\"room\" name=\"Room\"/>"), std::string::npos);
  EXPECT_EQ(countEntries(home_), 2);
  EXPECT_EQ(countEntries(home_.parent_path()), 1);
}

TEST_F(HomeStageTest, ANewHomesDockIsWhereItIsSaidToBe) {
  {
    HomeStage stage(home_, interrupts_);
    base::writeFileAtomically(stage.mapFolder() / "config.toml", "x");
    stage.commit(Eigen::Translation2d(1.5, -0.25) * Eigen::Rotation2Dd(0.5 * std::numbers::pi));
  }
  EXPECT_NE(base::readFile(home_ / "home.xml").find("<dock pose=\"1.500 -0.250 0 0 0 90.00\"/>"), std::string::npos);
  const semantic::Home home = semantic::getHome(semantic::readHome(home_ / "home.xml"), home_ / "home.xml");
  EXPECT_EQ(home.T_map_dock.position_m, Eigen::Vector3d(1.5, -0.25, 0.0));
}

TEST_F(HomeStageTest, SlashAtTheEndDoesNotMatter) {
  home_ = folder_.path() / "home/";
  stageMap("first");
  EXPECT_EQ(map(), "first");
  EXPECT_EQ(countEntries(folder_.path()), 1);
}

TEST_F(HomeStageTest, WithoutCommitNothingHasHappened) {
  stageMap("first", false);
  EXPECT_FALSE(fs::exists(home_));
  EXPECT_EQ(countEntries(home_.parent_path()), 0);
  stageMap("second");
  stageMap("third", false);
  EXPECT_EQ(map(), "second");
  EXPECT_EQ(countEntries(home_), 2);
}

TEST_F(HomeStageTest, MapIsReplacedAndTheRestKept) {
  folder_.write("new/home/home.xml", "<apartment/>");
  stageMap("first");
  stageMap("second");
  EXPECT_EQ(map(), "second");
  EXPECT_EQ(base::readFile(home_ / "home.xml"), "<apartment/>");
  EXPECT_EQ(countEntries(home_), 2);
}

TEST_F(HomeStageTest, EmptyFolderBecomesAHome) {
  fs::create_directories(home_ / "map");
  stageMap("first");
  EXPECT_EQ(map(), "first");
  EXPECT_TRUE(fs::exists(home_ / "home.xml"));
}

TEST_F(HomeStageTest, LinkToAHomeIsFollowed) {
  fs::create_directories(folder_.path() / "real");
  home_ = folder_.path() / "link";
  fs::create_directory_symlink(folder_.path() / "real", home_);
  stageMap("first");
  EXPECT_EQ(base::readFile(folder_.path() / "real/map/config.toml"), "first");
  EXPECT_TRUE(fs::is_symlink(home_));
}

TEST_F(HomeStageTest, FileInTheHomesPlaceIsAUsageError) {
  home_ = folder_.write("file", "x");
  try {
    stageMap("first");
    FAIL() << "nothing was thrown";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kUsage);
  }
}

TEST_F(HomeStageTest, ForeignMapFolderIsNotReplaced) {
  folder_.write("new/home/map/holiday.jpg", "photo");
  EXPECT_THROW(stageMap("first"), base::Error);
  EXPECT_EQ(base::readFile(home_ / "map/holiday.jpg"), "photo");
  EXPECT_EQ(countEntries(home_), 1);
}

TEST_F(HomeStageTest, HomeThatAppearsMeanwhileIsNotTouched) {
  HomeStage stage(home_, interrupts_);
  folder_.write("new/home/home.xml", "other");
  EXPECT_THROW(stage.commit(), base::Error);
  EXPECT_EQ(base::readFile(home_ / "home.xml"), "other");
  EXPECT_EQ(countEntries(home_), 1);
}

}  // namespace
}  // namespace oikos::tools
