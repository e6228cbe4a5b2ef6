// SPDX-License-Identifier: Apache-2.0
#include "tools/demo/demo_home.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/read_file.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"

namespace oikos::demo {
namespace {

using namespace semantic;

double area(const std::vector<Eigen::Vector2d>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& next = outline[(i + 1) % outline.size()];
    twice += outline[i].x() * next.y() - outline[i].y() * next.x();
  }
  return 0.5 * std::abs(twice);
}

TEST(DemoHome, IsTheFileInHomes) {
  EXPECT_EQ(base::readFile(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/demo/home.xml"), toXml(makeDemoHome()))
      << "make_demo_home prints the file anew";
}

TEST(DemoHome, HasNothingToObjectTo) {
  const HomeReading reading = readHomeText(toXml(makeDemoHome()), "demo");
  EXPECT_TRUE(reading.complete);
  for (const Finding& finding : reading.findings) {
    ADD_FAILURE() << finding.line << ": " << finding.element << ": " << finding.found;
  }
}

TEST(DemoHome, IsAWholeApartment) {
  const Home home = makeDemoHome();
  double area_m2 = 0.0;
  int large = 0;
  int articulated = 0;
  int knobs = 0;
  int small = 0;
  for (const Room& room : home.rooms) {
    area_m2 += area(room.outline_map);
    for (const LargeObject& object : room.objects) {
      large += object.type == "picture" ? 0 : 1;
      articulated += object.articulation ? 1 : 0;
      knobs += object.articulation ? static_cast<int>(object.articulation->knobs.size()) : 0;
      small += static_cast<int>(object.small_objects.size());
    }
  }
  EXPECT_GE(area_m2, 55.0);
  EXPECT_GE(large, 25);
  EXPECT_GE(articulated, 10);
  EXPECT_GE(knobs, 5);
  EXPECT_GE(small, 30);
}

}  // namespace
}  // namespace oikos::demo
