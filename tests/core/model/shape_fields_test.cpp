// SPDX-License-Identifier: Apache-2.0
#include "core/model/shape_fields.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/model/furniture/furniture.h"
#include "core/model/small_objects.h"

namespace oikos::model {
namespace {

/// What any field can be made from.
struct Anything {
  template <class Value>
  operator Value() const;  // NOLINT(google-explicit-constructor): for counting only
};

template <class Shape, class... Fields>
constexpr std::size_t fieldCount() {
  if constexpr (requires { Shape{Fields{}..., Anything{}}; }) {
    return fieldCount<Shape, Fields..., Anything>();
  } else {
    return sizeof...(Fields);
  }
}

template <class Shape>
class EveryShape : public testing::Test {};
using AllShapes =
    testing::Types<CabinetShape, DrawerUnitShape, FridgeShape, OvenShape, DishwasherShape, RoomDoorShape, TableShape, ChairShape, SofaShape,
                   BedShape, ShelfShape, CounterShape, LampShape, TvShape, RugShape, SinkUnitShape, ToiletShape, BathtubShape,
                   WashbasinShape, CupShape, BowlShape, PlateShape, BottleShape, TinShape, JarShape, BoxShape, CartonShape, BookShape>;
TYPED_TEST_SUITE(EveryShape, AllShapes);

TYPED_TEST(EveryShape, NamesAllOfItsFields) {
  TypeParam shape;
  EXPECT_EQ(listFields(shape).size(), fieldCount<TypeParam>());
}

TEST(ShapeFields, NumbersAreWrittenAsShortAsTheyReadBack) {
  double angle_rad = std::numbers::pi / 2.0;
  EXPECT_EQ((AngleField{&angle_rad}.text()), "90");
  EXPECT_TRUE((AngleField{&angle_rad}.set("-12.5")));
  EXPECT_NEAR(angle_rad, -0.2181661564992912, 1e-16);
  std::uint32_t rgb = 0xA0B;
  EXPECT_EQ((ColorField{&rgb}.text()), "#000A0B");
  EXPECT_TRUE((ColorField{&rgb}.set("#d8CBb2")));
  EXPECT_EQ(rgb, 0xD8CBB2U);
  std::vector<double> lengths_m = {0.1, 2.0};
  EXPECT_EQ((LengthsField{&lengths_m}.text()), "0.1 2");
  EXPECT_TRUE((LengthsField{&lengths_m}.set("")));
  EXPECT_TRUE(lengths_m.empty());
}

TEST(ShapeFields, AWrongTextChangesNothing) {
  double length_m = 0.5;
  EXPECT_FALSE((NumberField{&length_m, "m"}.set("0.6x")));
  EXPECT_EQ(length_m, 0.5);
  int count = 3;
  EXPECT_FALSE((CountField{&count}.set("4.0")));
  EXPECT_EQ(count, 3);
  std::vector<double> lengths_m = {1.0};
  EXPECT_FALSE((LengthsField{&lengths_m}.set("0.6 nan")));
  EXPECT_EQ(lengths_m.size(), 1U);
}

}  // namespace
}  // namespace oikos::model
