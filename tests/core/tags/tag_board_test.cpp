// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_board.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "core/base/error.h"
#include "core/tags/tag_family.h"
#include "tests/support/config_rules_check.h"

namespace oikos::tags {
namespace {

TEST(TagBoard, CornersLieOnTheGrid) {
  const TagBoard board{3, 2, 10, 0.16, 2};  // cells of 2 cm: 8 + 2 a tag, 2 at the end
  EXPECT_NEAR(board.width_m(), 0.64, 1e-12);
  EXPECT_NEAR(board.height_m(), 0.44, 1e-12);
  const auto first = board.findCorners(10);
  ASSERT_TRUE(first);
  EXPECT_TRUE((*first)[0].isApprox(Eigen::Vector3d(-0.28, 0.02, 0.0), 1e-12)) << (*first)[0].transpose();
  EXPECT_TRUE((*first)[1].isApprox(Eigen::Vector3d(-0.12, 0.02, 0.0), 1e-12));
  EXPECT_TRUE((*first)[2].isApprox(Eigen::Vector3d(-0.12, 0.18, 0.0), 1e-12));
  EXPECT_TRUE((*first)[3].isApprox(Eigen::Vector3d(-0.28, 0.18, 0.0), 1e-12));
  const auto last = board.findCorners(15);
  ASSERT_TRUE(last);
  EXPECT_TRUE((*last)[1].isApprox(Eigen::Vector3d(0.28, -0.18, 0.0), 1e-12));
  EXPECT_FALSE(board.findCorners(9));
  EXPECT_FALSE(board.findCorners(16));
}

/// The library's own drawing: a pixel a cell, with one white cell around.
cv::Mat drawnByLibrary(int id) {
  const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(tag36h11_create(), tag36h11_destroy);
  const std::unique_ptr<image_u8_t, void (*)(image_u8_t*)> image(apriltag_to_image(family.get(), id), [](image_u8_t* drawn) {
    std::free(drawn->buf);  // NOLINT: what the library's own function does, which is in another one of its libraries
    std::free(drawn);       // NOLINT
  });
  return cv::Mat(image->height, image->width, CV_8UC1, image->buf, static_cast<std::size_t>(image->stride)).clone();
}

TEST(TagBoard, PictureIsTheLibrarys) {
  const TagBoard board{2, 2, 583, 0.1, 1};
  const cv::Mat picture = drawTagBoard(board, 3);
  ASSERT_EQ(picture.size(), cv::Size(19 * 3, 19 * 3));
  for (int tag = 0; tag < 4; ++tag) {
    const cv::Mat expected = drawnByLibrary(583 + tag);
    for (int row = 0; row < expected.rows; ++row) {
      for (int column = 0; column < expected.cols; ++column) {
        const cv::Point cell(9 * (tag % 2) + column, 9 * (tag / 2) + row);
        EXPECT_EQ(picture.at<cv::Vec3b>(3 * cell.y + 2, 3 * cell.x)[1], expected.at<std::uint8_t>(row, column))
            << tag << " at " << column << ", " << row;
      }
    }
  }
}

TEST(TagBoard, Rules) {
  test::checkConfigRules<TagBoard>({{"columns", "0", "must be from 1 to 24"},
                                    {"rows", "25", "must be from 1 to 24"},
                                    {"tag_size_m", "0", "must be from 0.01 to 2"},
                                    {"gap_cells", "0", "must be from 1 to 8"},
                                    {"first_id", "582", "must be from 0 to 581"}});
  EXPECT_EQ(TagBoard({24, 24, 11, 0.1, 1}).validate().size(), 0U);
  EXPECT_EQ(TagBoard({24, 24, 12, 0.1, 1}).validate().front(), "first_id = 12: must be from 0 to 11");
  EXPECT_THROW((void)drawTagBoard({0, 1, 0, 0.1, 1}, 1), base::ContractViolation);
  EXPECT_EQ(tagFamilySize(), 587);
}

}  // namespace
}  // namespace oikos::tags
