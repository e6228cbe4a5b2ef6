// SPDX-License-Identifier: Apache-2.0
#include "semantic/xml/home_writer.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/random_home.h"

namespace oikos::semantic {
namespace {

const std::string& papersXml() {
  static const std::string text = base::readFile(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml");
  return text;
}

Home reread(const std::string& text) {
  const HomeReading reading = readHomeText(text, "text");
  EXPECT_TRUE(reading.complete);
  for (const Finding& finding : reading.findings) {
    EXPECT_NE(finding.severity, Severity::kError) << finding.line << ": " << finding.element << ": " << finding.found << "\n" << text;
  }
  return reading.home;
}

/// The lines of `text` that `other` lacks.
std::vector<std::string> linesMissingIn(const std::string& other, const std::string& text) {
  std::multiset<std::string> there;
  std::istringstream others(other);
  for (std::string line; std::getline(others, line);) {
    there.insert(line);
  }
  std::vector<std::string> missing;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto found = there.find(line);
    if (found == there.end()) {
      missing.push_back(line);
    } else {
      there.erase(found);
    }
  }
  return missing;
}

TEST(ToXml, EveryRandomHomeReadsBackAsItWas) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Home home = test::randomHome(seed);
    EXPECT_TRUE(reread(toXml(home)) == home) << "seed " << seed << "\n" << toXml(home);
  }
}

TEST(SpliceXml, AnyRandomHomeBecomesAnyOther) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Home before = test::randomHome(seed);
    const Home after = test::randomHome(seed + 1000);
    const std::string text = spliceXml(toXml(before), before, after);
    EXPECT_TRUE(reread(text) == after) << "seed " << seed << "\n" << text;
  }
}

TEST(SpliceXml, ManySmallChangesOneAfterAnother) {
  Home home = reread(papersXml());
  std::string text = papersXml();
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Home after = test::randomlyChanged(home, seed);
    text = spliceXml(text, home, after);
    ASSERT_TRUE(reread(text) == after) << "seed " << seed << "\n" << text;
    home = after;
  }
  EXPECT_NE(text.find("<!-- The two-room test house of the papers"), std::string::npos);
}

TEST(SpliceXml, NothingChangedIsByteForByteTheSame) {
  const Home home = reread(papersXml());
  EXPECT_EQ(spliceXml(papersXml(), home, home), papersXml());
}

TEST(SpliceXml, OneValueChangesOneLine) {
  const Home before = reread(papersXml());
  Home after = before;
  after.rooms[0].objects[2].edit().articulation->joints[0].value = 42.5 * kRadPerDeg;
  const std::string text = spliceXml(papersXml(), before, after);
  const std::vector<std::string> lines = linesMissingIn(papersXml(), text);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("value_deg=\"42.5\""), std::string::npos);
}

TEST(SpliceXml, HandFormattingSurvivesInsideAChangedElement) {
  const std::string xml =
      "<?xml version='1.0'?>\n<!-- before -->\n<apartment id='a'   name=\"x &amp; y\"\n           version='1'><!-- first -->\n"
      "\t<room name='r' id='r'><!-- why --><switch id='s' kind='rotational' pose='0 0 1  0 0 0' ></switch></room>\n</apartment>\n<!-- "
      "after -->\n";
  const Home before = reread(xml);
  Home after = before;
  after.rooms[0].switches[0].T_map_switch.position_m.x() = 2.0;
  after.rooms[0].type = "hall";
  after.as_of = 7;
  EXPECT_EQ(
      spliceXml(xml, before, after),
      "<?xml version='1.0'?>\n<!-- before -->\n<apartment id='a'   name=\"x &amp; y\"\n           version='1' asOf=\"7\"><!-- first -->\n"
      "\t<room name='r' id='r' type=\"hall\"><!-- why --><switch id='s' kind='rotational' pose='2 0 1 0 0 0' ></switch></room>\n"
      "</apartment>\n<!-- after -->\n");
}

TEST(SpliceXml, AnObjectThatMovesTakesItsTextAlong) {
  std::string xml = papersXml();
  const std::string inner = "<defaultPlace parent=\"cupboard-body\"";
  xml.insert(xml.find(inner), "<!-- grandmother's -->\n        ");
  const Home before = reread(xml);
  Home after = before;
  auto& on_table = after.rooms[0].objects[0].edit().small_objects;
  SmallObject cup = on_table[3];
  on_table.erase(on_table.begin() + 3);
  cup.parent = "bathroom";
  after.rooms[1].small_objects.push_back(cup);
  const std::string text = spliceXml(xml, before, after);
  EXPECT_TRUE(reread(text) == after);
  EXPECT_NE(text.find("    <smallObject id=\"blue-cup\" type=\"cup\" parent=\"bathroom\" relation=\"on\""), std::string::npos) << text;
  EXPECT_NE(text.find("      <!-- grandmother's -->\n      <defaultPlace parent=\"cupboard-body\""), std::string::npos) << text;
  EXPECT_EQ(text.find("\n\n\n"), std::string::npos);
}

TEST(SpliceXml, TextThatNeedsEscaping) {
  const Home before = reread(papersXml());
  Home after = before;
  after.rooms[0].name = "a < b & \"c\" 'd' >\n\te";
  after.vocabulary.edit().add(TermKind::kObjectType, {"teapot", {"<pot> & \"lid\""}});
  EXPECT_TRUE(reread(spliceXml(papersXml(), before, after)) == after);
}

TEST(SpliceVerified, RefusesWhatCouldNotBeReadBack) {
  const Home before = reread(papersXml());
  Home after = before;
  after.rooms[0].objects[2].edit().articulation->joints[0].value = 500.0 * kRadPerDeg;
  EXPECT_THROW((void)spliceVerified(papersXml(), before, after, "home"), base::Error);
  after = before;
  after.rooms[0].id.value = "not an id";
  EXPECT_THROW((void)spliceVerified(papersXml(), before, after, "home"), base::Error);
  after = test::randomlyChanged(before, 7);
  EXPECT_EQ(spliceVerified(papersXml(), before, after, "home"), spliceXml(papersXml(), before, after));
}

}  // namespace
}  // namespace oikos::semantic
