// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/config.h"
#include "core/recording/png_encoder.h"
#include "core/tags/tag_setup.h"
#include "tests/core/tags/board_picture.h"
#include "tests/support/enum_table_check.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::tags {
namespace {

constexpr const char* kCamera = "width = 640\nheight = 480\nfx = 525\nfy = 525\ncx = 319.5\ncy = 239.5\ndepth_scale = 1000\n";

/// A camera 2.4 m above the floor that looks straight down, its x along map's x; the board lies on the robot, 0.4 m above the floor.
class TagPath : public testing::Test {
 protected:
  TagPath() {
    setup_.T_map_camera = {0.0, 0.0, 2.4, 1.0, 0.0, 0.0, 0.0};
    setup_.T_base_board = {0.1, 0.0, 0.4, 0.0, 0.0, 0.0, 1.0};
    (void)folder_.write("camera.toml", kCamera);
    writeSetup(setup_);
  }

  void writeSetup(const TagSetup& setup) const { (void)folder_.write("tags.toml", base::writeConfig(setup)); }
  [[nodiscard]] static Eigen::Isometry3d T_map_base(double x_m, double y_m, double yaw_rad) {
    return Eigen::Translation3d(x_m, y_m, 0.0) * Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  }
  [[nodiscard]] cv::Mat pictureOf(const Eigen::Isometry3d& T_map_base) const {
    return takeBoardPicture(setup_.board, plainCamera(), poseOf(setup_.T_map_camera).inverse() * T_map_base * poseOf(setup_.T_base_board));
  }
  void addPicture(const cv::Mat& gray) {
    cv::Mat bgra;
    cv::cvtColor(gray, bgra, cv::COLOR_GRAY2BGRA);
    const std::vector<unsigned char> png = recording::encodePng(bgra, 1);
    const std::string name = std::to_string(count_) + ".png";
    (void)folder_.write(name, std::string(png.begin(), png.end()));
    list_ += std::to_string(count_++) + ".5 " + name + "\n";
    (void)folder_.write("rgb.txt", list_);
  }
  [[nodiscard]] std::vector<TagPicture> read(const TagPathConfig& config = {}) const { return readTagPath(folder_.path(), config); }

  test::TemporaryFolder folder_;
  TagSetup setup_;

 private:
  int count_ = 0;
  std::string list_ = "# stamp file\n";
};

TEST_F(TagPath, IsThePathOfTheBase) {
  // A tilt by 1 rad about the board's middle moves a corner by 0.3 m / 2 m * 0.3 m / 2 m * 525 px = 12 px; edges that lie along the
  // pixels' rows are off by up to 0.12 px, all to one side. The base's origin is 0.4 m below the board.
  constexpr double kTilt_rad = 0.12 / 12.0 * 1.2;
  const std::vector<Eigen::Isometry3d> truth{T_map_base(0.0, 0.0, 0.0), T_map_base(-0.5, 0.3, 1.0), T_map_base(0.4, -0.2, -2.5)};
  for (const Eigen::Isometry3d& T : truth) {
    addPicture(pictureOf(T));
  }
  const std::vector<TagPicture> pictures = read();
  ASSERT_EQ(pictures.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pictures[i].status, TagPictureStatus::kKept) << i;
    EXPECT_EQ(pictures[i].stamp_ns, static_cast<std::int64_t>(i) * 1'000'000'000 + 500'000'000);
    EXPECT_EQ(pictures[i].tags, 6);
    EXPECT_LT((pictures[i].T_map_base.translation() - truth[i].translation()).norm(), 2.0 * kTilt_rad * 0.4) << i;
    EXPECT_LT(Eigen::AngleAxisd(pictures[i].T_map_base.linear().transpose() * truth[i].linear()).angle(), kTilt_rad) << i;
  }
  EXPECT_NEAR(pictures[0].distance_m, std::hypot(2.0, 0.1), 0.004);
  EXPECT_EQ(keptPath(pictures).size(), 3U);
  EXPECT_EQ(keptPath(pictures)[2].T_map_camera.matrix(), pictures[2].T_map_base.matrix());
}

TEST_F(TagPath, ThreadsDoNotChangeIt) {
  for (int i = 0; i < 5; ++i) {
    addPicture(pictureOf(T_map_base(0.1 * i, 0.0, 0.2 * i)));
  }
  TagPathConfig config;
  const std::vector<TagPicture> one = read(config);
  config.threads = 3;
  const std::vector<TagPicture> three = read(config);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].T_map_base.matrix(), three[i].T_map_base.matrix());
  }
}

TEST_F(TagPath, ATagThatIsHiddenDropsThePicture) {
  cv::Mat picture = pictureOf(T_map_base(0.0, 0.0, 0.0));
  cv::circle(picture, {400, 239}, 25, cv::Scalar(90), -1);
  addPicture(picture);
  addPicture(cv::Mat(480, 640, CV_8UC1, cv::Scalar(100)));
  const std::vector<TagPicture> pictures = read();
  EXPECT_EQ(pictures[0].status, TagPictureStatus::kTagsMissing);
  EXPECT_GE(pictures[0].tags, 4);
  EXPECT_LE(pictures[0].tags, 5);
  EXPECT_EQ(pictures[1].tags, 0);
  EXPECT_TRUE(keptPath(pictures).empty());
}

TEST_F(TagPath, ABoardThatIsTooFarDropsThePicture) {
  addPicture(pictureOf(T_map_base(0.0, 0.0, 0.0)));
  TagPathConfig config;
  config.max_distance_m = 1.9;
  const std::vector<TagPicture> pictures = read(config);
  EXPECT_EQ(pictures[0].status, TagPictureStatus::kTooFar);
  EXPECT_NEAR(pictures[0].distance_m, 2.0, 0.01);
  EXPECT_TRUE(keptPath(pictures).empty());
}

TEST_F(TagPath, TagsThatLieOtherwiseThanSaidAreABadFit) {
  addPicture(pictureOf(T_map_base(0.0, 0.0, 0.0)));
  TagSetup other = setup_;
  other.board.gap_cells = 5;
  writeSetup(other);
  EXPECT_EQ(read()[0].status, TagPictureStatus::kBadFit);
  EXPECT_GT(read()[0].rms_px, 1.5);
}

TEST_F(TagPath, SaysWhatIsWrong) {
  using base::ErrorCode;
  test::expectError(ErrorCode::kInput, {"no rgb.txt"}, [&] { (void)read(); });
  addPicture(cv::Mat(100, 100, CV_8UC1, cv::Scalar(100)));
  test::expectError(ErrorCode::kInput, {"0.png: is 100x100 pixels, but camera.toml says 640x480"}, [&] { (void)read(); });
  std::filesystem::resize_file(folder_.path() / "0.png", 40);
  test::expectError(ErrorCode::kInput, {"0.png"}, [&] { (void)read(); });
  std::filesystem::remove(folder_.path() / "0.png");
  test::expectError(ErrorCode::kIo, {"0.png"}, [&] { (void)read(); });
  (void)folder_.write("tags.toml", "T_map_camera = [1]\n");
  test::expectError(ErrorCode::kInput, {"tags.toml:1", "T_map_camera"}, [&] { (void)read(); });
  (void)folder_.write("camera.toml", "width = 640\n");
  test::expectError(ErrorCode::kInput, {"camera.toml", "height"}, [&] { (void)read(); });
}

TEST(TagPathConfig, Rules) {
  EXPECT_TRUE(TagPathConfig().validate().empty());
  EXPECT_EQ(TagPathConfig({0.0, 1.0, 1}).validate().front(), "max_distance_m = 0: must be > 0");
  EXPECT_EQ(TagPathConfig({1.0, std::nan(""), 1}).validate().front(), "max_rms_px = nan: must be > 0");
  EXPECT_EQ(TagPathConfig({1.0, 1.0, 0}).validate().front(), "threads = 0: must be >= 1");
}

TEST(TagPictureStatus, Names) {
  test::checkEnumTable(TagPictureStatus::kKept);
}

}  // namespace
}  // namespace oikos::tags
