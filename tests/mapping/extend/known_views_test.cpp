// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/known_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "tests/support/analytic_room.h"

namespace oikos::mapping {
namespace {

const Eigen::Vector3d kEye(-0.6, 0.2, 1.3);

/// A camera there that looks at a heading, a little down.
Eigen::Isometry3d looking(double heading_deg, const Eigen::Vector3d& eye = kEye) {
  const double yaw_rad = heading_deg * std::numbers::pi / 180.0;
  return test::lookAt(eye, eye + Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), -0.3));
}

struct Room {
  std::vector<Eigen::Isometry3d> poses;  ///< by frame
  int blind_frame = -1;

  [[nodiscard]] std::vector<char> known(int earlier, int threads = 1) const {
    const camera::PinholeCamera camera = test::smallCamera();
    const auto read = [&](int frame, bool) {
      camera::RgbdFrame image = test::AnalyticRoom::furnished().render(camera, poses[static_cast<std::size_t>(frame)]);
      if (frame == blind_frame) {
        image.depth_m.setTo(std::nanf(""));
      }
      return image;
    };
    std::vector<View> before;
    std::vector<View> fresh;
    for (int frame = 0; frame < static_cast<int>(poses.size()); ++frame) {
      (frame < earlier ? before : fresh).push_back({frame, poses[static_cast<std::size_t>(frame)]});
    }
    return findKnownViews(before, fresh, {camera, read, threads, {}}, {});
  }
};

TEST(KnownViews, WhatWasSeenFromHereIsKnownAndWhatIsBesideItIsNot) {
  const Room room{
      {looking(0.0), looking(25.0), looking(3.0, kEye + Eigen::Vector3d(0.05, 0.05, 0.0)), looking(12.0), looking(90.0), looking(50.0)}};
  EXPECT_EQ(room.known(2), (std::vector<char>{1, 1, 0, 0}));
  EXPECT_EQ(room.known(2, 3), room.known(2));
}

/// The table's far side, seen across it, is what it is: but from behind it looks like nothing that was seen.
TEST(KnownViews, FromTheOtherSideAPlaceIsNew) {
  const Room room{{looking(0.0), looking(180.0, {1.7, 0.2, 1.3})}};
  EXPECT_EQ(room.known(1), std::vector<char>{0});
}

TEST(KnownViews, NothingIsKnownOfNothingAndNothingIsNewInTheDark) {
  Room room{{looking(0.0), looking(0.0)}};
  EXPECT_EQ(room.known(0), (std::vector<char>{0, 0}));
  room.blind_frame = 1;
  EXPECT_EQ(room.known(1), std::vector<char>{1});
  EXPECT_TRUE(Room{}.known(0).empty());
}

}  // namespace
}  // namespace oikos::mapping
