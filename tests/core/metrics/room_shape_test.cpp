// SPDX-License-Identifier: Apache-2.0
#include "core/metrics/room_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/error.h"
#include "tests/support/config_rules_check.h"

namespace oikos::metrics {
namespace {

using Outline = std::vector<Eigen::Vector2d>;
using Points = std::vector<Eigen::Vector3f>;

/// Points every 2 cm on the walls of an outline, from the floor to 2.5 m, `noise_m` of deviation across them.
Points wallPoints(const Outline& outline, double noise_m) {
  std::mt19937 random(7);
  std::normal_distribution<double> across(0.0, 1.0);
  Points points;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d way = outline[(i + 1) % outline.size()] - outline[i];
    const Eigen::Vector2d normal = Eigen::Vector2d(-way.y(), way.x()).normalized();
    for (double s_m = 0.01; s_m < way.norm(); s_m += 0.02) {
      for (double z_m = 0.01; z_m < 2.5; z_m += 0.02) {
        const Eigen::Vector2d place = outline[i] + s_m * way.normalized() + noise_m * across(random) * normal;
        points.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(z_m));
      }
    }
  }
  return points;
}

const Outline kRoom{{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}, {0.0, 3.0}};

TEST(RoomShape, AnExactRoomHasItsLengths) {
  const RoomShape shape = measureRoom(kRoom, wallPoints(kRoom, 0.0));
  ASSERT_EQ(shape.walls.size(), 4U);
  ASSERT_EQ(shape.between_walls.size(), 2U);
  EXPECT_EQ(shape.between_walls[0].from, 0U);
  EXPECT_EQ(shape.between_walls[0].to, 2U);
  EXPECT_NEAR(shape.between_walls[0].true_m, 3.0, 1e-12);
  EXPECT_NEAR(shape.between_walls[1].true_m, 4.0, 1e-12);
  ASSERT_EQ(shape.between_corners.size(), 6U);
  EXPECT_NEAR(shape.between_corners[1].true_m, 5.0, 1e-12);  // the diagonal
  for (const auto* lengths : {&shape.between_walls, &shape.between_corners}) {
    for (const RoomLength& length : *lengths) {
      EXPECT_NEAR(length.error_m(), 0.0, 1e-6) << length.from << ' ' << length.to;
    }
  }
}

TEST(RoomShape, ARoomThatIsMappedTooLongIsMeasuredTooLong) {
  const Outline mapped{{0.01, -0.01}, {4.03, -0.01}, {4.03, 3.01}, {0.01, 3.01}};
  const RoomShape shape = measureRoom(kRoom, wallPoints(mapped, 0.003));
  // Of some 8000 points of 3 mm deviation the mean is good to 0.03 mm, the slope's end to as much again.
  constexpr double kFit_m = 0.0005;
  EXPECT_NEAR(shape.between_walls.at(0).error_m(), 0.02, kFit_m);
  EXPECT_NEAR(shape.between_walls.at(1).error_m(), 0.02, kFit_m);
  EXPECT_NEAR(shape.between_corners.at(0).error_m(), 0.02, kFit_m);
  EXPECT_NEAR(shape.between_corners.at(1).error_m(), std::hypot(4.02, 3.02) - 5.0, kFit_m);
}

TEST(RoomShape, WallsOutOfSquareMeetWhereTheyDo) {
  const Outline crooked{{0.0, 0.0}, {4.0, 0.03}, {4.02, 3.0}, {-0.01, 2.99}};
  const RoomShape shape = measureRoom(crooked, wallPoints(crooked, 0.002));
  ASSERT_EQ(shape.between_corners.size(), 6U);
  for (const RoomLength& length : shape.between_corners) {
    EXPECT_NEAR(length.error_m(), 0.0, 0.0005);
  }
  for (const RoomLength& length : shape.between_walls) {
    EXPECT_NEAR(length.error_m(), 0.0, 0.0005);
  }
}

TEST(RoomShape, PicturesSkirtingAndTheRoomBehindDoNotPull) {
  Points points = wallPoints(kRoom, 0.002);
  for (float x_m = 1.0F; x_m < 2.0F; x_m += 0.02F) {
    for (float z_m = 0.0F; z_m < 1.0F; z_m += 0.02F) {
      points.emplace_back(x_m, 0.03F, 1.0F + z_m);           // a picture on the wall y = 0
      points.emplace_back(2.0F * x_m, 0.012F, 0.07F * z_m);  // its skirting
      points.emplace_back(x_m, -0.12F, z_m);                 // its other side
    }
  }
  const RoomShape shape = measureRoom(kRoom, points);
  EXPECT_NEAR(shape.between_walls.at(0).error_m(), 0.0, 0.0005);
}

TEST(RoomShape, AWallThatWasNotSeenHasNoLength) {
  Points points = wallPoints(kRoom, 0.0);
  std::erase_if(points, [](const auto& point) { return point.x() > 3.99F && point.y() > 0.3F; });  // a strip of wall 1 is left
  const RoomShape shape = measureRoom(kRoom, points);
  EXPECT_FALSE(shape.walls[1]);
  ASSERT_EQ(shape.between_walls.size(), 1U);
  EXPECT_EQ(shape.between_walls[0].from, 0U);
  ASSERT_EQ(shape.between_corners.size(), 1U);  // 0 and 3 have both their walls
  EXPECT_EQ(shape.between_corners[0].to, 3U);
  EXPECT_TRUE(measureRoom(kRoom, {}).between_walls.empty());
}

TEST(RoomShape, ACornerFarFromWhatWasSeenIsNotMeasured) {
  Points points = wallPoints(kRoom, 0.0);
  std::erase_if(points, [](const auto& point) { return point.x() > 3.99F && point.y() > 1.5F; });  // wall 1 ends 1.5 m before corner 2
  const RoomShape shape = measureRoom(kRoom, points);
  ASSERT_TRUE(shape.walls[1]);
  EXPECT_NEAR(shape.walls[1]->to_m, 1.5, 0.02);
  EXPECT_EQ(shape.between_walls.size(), 2U);
  for (const RoomLength& length : shape.between_corners) {
    EXPECT_NE(length.from, 2U);
    EXPECT_NE(length.to, 2U);
  }
  EXPECT_EQ(shape.between_corners.size(), 3U);
}

TEST(RoomShape, OfAnAngledRoomOnlyFacingWallsAreOpposite) {
  const Outline angled{{0.0, 0.0}, {4.0, 0.0}, {4.0, 2.0}, {2.0, 2.0}, {2.0, 4.0}, {0.0, 4.0}};
  for (const bool is_reversed : {false, true}) {
    Outline outline = angled;
    if (is_reversed) {
      std::reverse(outline.begin(), outline.end());
    }
    const RoomShape shape = measureRoom(outline, wallPoints(outline, 0.0));
    std::vector<double> lengths_m;
    for (const RoomLength& length : shape.between_walls) {
      EXPECT_NEAR(length.error_m(), 0.0, 1e-5);
      lengths_m.push_back(std::round(length.true_m));
    }
    std::sort(lengths_m.begin(), lengths_m.end());
    EXPECT_EQ(lengths_m, (std::vector<double>{2.0, 2.0, 4.0, 4.0}));
  }
}

TEST(RoomShape, Rules) {
  test::checkConfigRules<RoomShapeConfig>({{"search_m", "0", "must be > 0"},
                                           {"inlier_m", "-1", "must be > 0"},
                                           {"from_end_m", "-0.1", "must be >= 0"},
                                           {"lowest_m", "nan", "must be >= 0"},
                                           {"highest_m", "0", "must be > 0"},
                                           {"min_points", "1", "must be >= 2"},
                                           {"min_length_m", "0", "must be > 0"},
                                           {"to_corner_m", "0", "must be > 0"}});
  EXPECT_THROW((void)measureRoom({}, {}), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::metrics
