// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/read_file.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

const std::string kPapersHouse = (std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers").string();

/// The papers' house with one piece of text replaced.
std::string brokenHouse(const std::string& what, const std::string& by) {
  std::string content = base::readFile(std::filesystem::path(kPapersHouse) / "home.xml");
  content.replace(content.find(what), what.size(), by);
  return content;
}

TEST(Check, AHomeInOrder) {
  const ProcessResult result = runOikos({"check", kPapersHouse});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, kPapersHouse + "/home.xml: 0 errors, 0 warnings\n");
}

TEST(Check, ErrorsExitWith3AndWarningsDoNot) {
  const TemporaryFolder home;
  (void)home.write("home.xml", brokenHouse("current=\"3\"", "current=\"9\""));
  const ProcessResult wrong = runOikos({"check", home.path().string(), "--json"});
  EXPECT_EQ(wrong.exit_code, 3);
  const auto json = nlohmann::json::parse(wrong.out);
  EXPECT_EQ(json["errors"], 1);
  EXPECT_EQ(json["findings"][0]["element"], "knob 'fridge-thermostat'");
  EXPECT_EQ(json["findings"][0]["expected"], "one of off, 1, 2, 3, 4");
  (void)home.write("home.xml", brokenHouse("type=\"bowl\"", "type=\"bowel\""));
  const ProcessResult odd = runOikos({"check", home.path().string()});
  EXPECT_EQ(odd.exit_code, 0);
  EXPECT_NE(odd.out.find("0 errors, 1 warning\n"), std::string::npos) << odd.out;
}

TEST(Check, AFolderThatIsNoHome) {
  const TemporaryFolder folder;
  EXPECT_EQ(runOikos({"check", folder.path().string()}).exit_code, 3);
  EXPECT_EQ(runOikos({"check", (folder.path() / "nowhere").string()}).exit_code, 4);
}

TEST(Ask, AnswersOnStdout) {
  const ProcessResult result = runOikos({"ask", kPapersHouse, "where is the blue cup?"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "The blue cup is on the kitchen table in the kitchen.\n");
  EXPECT_EQ(result.err, "");
}

TEST(Ask, NoAnswerExitsWith1AndABrokenHomeWith3) {
  EXPECT_EQ(runOikos({"ask", kPapersHouse, "where is the green cup"}).exit_code, 1);
  EXPECT_EQ(runOikos({"ask", kPapersHouse, "dance for me"}).exit_code, 1);
  const TemporaryFolder home;
  (void)home.write("home.xml", brokenHouse("current=\"3\"", "current=\"9\""));
  const ProcessResult result = runOikos({"ask", home.path().string(), "where is the blue cup?"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("oikos check"), std::string::npos) << result.err;
}

TEST(Ask, WhereTheRobotIsOrdersItsParkingPoses) {
  const ProcessResult result = runOikos({"ask", kPapersHouse, "where is the blue cup?", "--at", "1.8,1.5,-90", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_DOUBLE_EQ(json["found"][0]["parking_poses_map"][0]["y_m"], 1.0);
  EXPECT_EQ(runOikos({"ask", kPapersHouse, "where is the blue cup?", "--at", "1.8,1.5"}).exit_code, 2);
  EXPECT_EQ(runOikos({"ask", kPapersHouse, "where is the blue cup?", "--now", "today"}).exit_code, 2);
}

TEST(Tell, WhatAPersonSaysCounts) {
  const TemporaryFolder home;
  (void)home.write("home.xml", base::readFile(std::filesystem::path(kPapersHouse) / "home.xml"));
  const ProcessResult told = runOikos({"tell", home.path().string(), "the blue cup is in the bathroom"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_EQ(told.out, "Noted: the blue cup is in the bathroom.\n");
  EXPECT_NE(runOikos({"ask", home.path().string(), "where is the blue cup"}).out.find("in the bathroom"), std::string::npos);
  const ProcessResult before = runOikos({"ask", home.path().string(), "where was the blue cup an hour ago"});
  EXPECT_NE(before.out.find("was on the kitchen table"), std::string::npos) << before.out << before.err;
  EXPECT_EQ(runOikos({"tell", home.path().string(), "the cup is in the bathroom"}).exit_code, 1);
}

}  // namespace
}  // namespace oikos::test
