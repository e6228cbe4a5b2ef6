// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/base_check.h"

#include <gtest/gtest.h>

namespace oikos::tracking {
namespace {

semantic::LargeObject cabinet() {
  semantic::LargeObject object;
  object.id = {"cabinet"};
  object.T_map_object.position_m = {3.0, 1.0, 0.0};
  return object;
}

FurniturePlace placeAside(double way_m) {
  FurniturePlace place;
  place.id = {"cabinet"};
  place.T_map_object = Eigen::Translation3d(3.0 - way_m, 1.0, 0.0);
  return place;
}

PieceReading reading(int in_place, int not_there) {
  PieceReading piece;
  piece.id = {"cabinet"};
  piece.images = in_place + not_there + 1;
  piece.in_place = in_place;
  piece.not_there = not_there;
  return piece;
}

TEST(BaseCheck, WhatManyImagesHaveInItsPlaceHasNotMovedFar) {
  EXPECT_TRUE(isRefuted(placeAside(0.4), cabinet(), {reading(5, 0)}));
  EXPECT_TRUE(isRefuted(placeAside(0.4), cabinet(), {reading(5, 2)}));
  EXPECT_FALSE(isRefuted(placeAside(0.4), cabinet(), {reading(5, 3)}));
  EXPECT_FALSE(isRefuted(placeAside(0.4), cabinet(), {reading(0, 5)}));
  EXPECT_FALSE(isRefuted(placeAside(0.4), cabinet(), {reading(1, 0)}));  // one image is none
}

TEST(BaseCheck, ASmallMoveIsFollowedByTheImages) {
  EXPECT_FALSE(isRefuted(placeAside(0.06), cabinet(), {reading(5, 0)}));
}

TEST(BaseCheck, OfAPieceWithoutDoorsNothingIsKnown) {
  EXPECT_FALSE(isRefuted(placeAside(0.4), cabinet(), {}));
  PieceReading other = reading(5, 0);
  other.id = {"other"};
  EXPECT_FALSE(isRefuted(placeAside(0.4), cabinet(), {other}));
}

}  // namespace
}  // namespace oikos::tracking
