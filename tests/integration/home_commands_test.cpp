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

}  // namespace
}  // namespace oikos::test
