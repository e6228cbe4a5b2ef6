// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/thing.h"

#include <gtest/gtest.h>

#include "semantic/query/home_index.h"
#include "semantic/query/sentence.h"
#include "semantic/xml/home_reader.h"

namespace oikos::semantic {
namespace {

HomeIndex sampleHome(const std::string& name) {
  return HomeIndex(readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes" / name / "home.xml").home);
}

TEST(Thing, APartWithoutALabelIsCalledByItsId) {
  const HomeIndex index = sampleHome("demo");
  EXPECT_EQ(index.findById("wardrobe-left_door")->name(), "left door of the wardrobe");
  EXPECT_EQ(index.findById("oven-knob_0")->name(), "first knob of the oven");
  EXPECT_EQ(index.findById("oven-knob_4")->name(), "fifth knob of the oven");
  EXPECT_EQ(index.findById("fridge-freezer_door")->name(), "freezer door of the fridge");
  EXPECT_EQ(index.findById("linen-chest-drawer_1")->name(), "second drawer of the linen chest");
}

TEST(Thing, ALabelGoesBeforeTheId) {
  EXPECT_EQ(sampleHome("household").findById("chest-drawer-4")->name(), "bottom drawer of the chest of drawers");
}

TEST(Thing, IsPluralByTheHeadOfItsName) {
  const HomeIndex index = sampleHome("household");
  for (const char* id : {"house-keys", "reading-glasses", "spare-keys"}) {
    EXPECT_TRUE(isPlural(*index.findById(id))) << id;
  }
  for (const char* id : {"chest", "atlas", "water-glass", "pills-box", "bed", "chest-drawer-1"}) {
    EXPECT_FALSE(isPlural(*index.findById(id))) << id;
  }
  EXPECT_TRUE(isPlural(*sampleHome("demo").findById("drawers")));
}

}  // namespace
}  // namespace oikos::semantic
