// SPDX-License-Identifier: Apache-2.0
// Whatever sizes validate() accepts give sound models whose parts do not run into each other.
#include <gtest/gtest.h>

#include <cstdint>

#include "core/model/furniture/furniture.h"
#include "tests/core/model/furniture/furniture_checks.h"

namespace oikos::model {
namespace {

/// Numbers from a counter (splitmix64), the same on every machine.
class Dice {
 public:
  double between(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) / 9007199254740992.0; }
  int pick(int low, int high) { return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1)); }

 private:
  std::uint64_t next() {
    std::uint64_t z = (++count_) * 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  std::uint64_t count_ = 0;
};

constexpr int kTrials = 200;

TEST(AnySize, Cabinets) {
  Dice dice;
  int made = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    CabinetShape shape;
    shape.width_m = dice.between(0.2, 2.0);
    shape.depth_m = dice.between(0.1, 0.9);
    shape.height_m = dice.between(0.2, 2.5);
    shape.bottom_m = dice.between(0.0, 1.5);
    shape.board_m = dice.between(0.01, 0.04);
    shape.plinth_height_m = dice.pick(0, 1) * dice.between(0.0, 0.2);
    shape.shelf_count = dice.pick(0, 6);
    shape.door_count = dice.pick(0, 2);
    shape.hinge = static_cast<HingeEdge>(dice.pick(0, 3));
    shape.door_gap_m = dice.between(0.001, 0.01);
    shape.door_opening_rad = dice.between(0.5, 3.1);
    shape.handle = static_cast<HandleStyle>(dice.pick(0, 4));
    shape.handle_level = dice.between(0.0, 1.0);
    shape.worktop_thickness_m = dice.pick(0, 1) * dice.between(0.01, 0.06);
    if (!shape.validate().empty()) {
      continue;
    }
    ++made;
    const ArticulatedModel model = makeCabinet(shape);
    SCOPED_TRACE(trial);
    test::expectSound(model);
    test::expectNoCollision(model);
  }
  EXPECT_GT(made, kTrials / 2);
}

TEST(AnySize, DrawerUnits) {
  Dice dice;
  int made = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    DrawerUnitShape shape;
    shape.width_m = dice.between(0.25, 1.5);
    shape.depth_m = dice.between(0.2, 0.9);
    shape.height_m = dice.between(0.3, 1.5);
    shape.board_m = dice.between(0.01, 0.03);
    shape.plinth_height_m = dice.pick(0, 1) * dice.between(0.0, 0.2);
    shape.drawer_count = dice.pick(1, 5);
    shape.extension_ratio = dice.between(0.2, 1.0);
    shape.handle = static_cast<HandleStyle>(dice.pick(0, 4));
    shape.handle_length_m = dice.between(0.05, 0.2);
    if (!shape.validate().empty()) {
      continue;
    }
    ++made;
    SCOPED_TRACE(trial);
    const ArticulatedModel model = makeDrawerUnit(shape);
    test::expectSound(model);
    test::expectNoCollision(model);
  }
  EXPECT_GT(made, kTrials / 2);
}

TEST(AnySize, Appliances) {
  Dice dice;
  int made = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE(trial);
    FridgeShape fridge;
    fridge.width_m = dice.between(0.4, 1.0);
    fridge.depth_m = dice.between(0.4, 0.8);
    fridge.height_m = dice.between(0.6, 2.0);
    fridge.hinge = static_cast<HingeEdge>(dice.pick(0, 1));
    fridge.freezer = static_cast<FreezerPlace>(dice.pick(0, 2));
    fridge.freezer_height_m = dice.between(0.2, 0.8);
    fridge.handle_length_m = dice.between(0.1, 0.5);
    OvenShape oven;
    oven.width_m = dice.between(0.4, 1.0);
    oven.depth_m = dice.between(0.4, 0.8);
    oven.height_m = dice.between(0.5, 1.0);
    oven.window_ratio = dice.between(0.0, 0.9);
    oven.hob_plate_count = dice.pick(0, 4);
    oven.knob_count = dice.pick(0, 8);
    for (const bool is_fridge : {true, false}) {
      if (is_fridge ? fridge.validate().empty() : oven.validate().empty()) {
        ++made;
        const ArticulatedModel model = is_fridge ? makeFridge(fridge) : makeOven(oven);
        test::expectSound(model);
        test::expectNoCollision(model);
      }
    }
  }
  EXPECT_GT(made, kTrials / 2);
}

}  // namespace
}  // namespace oikos::model
