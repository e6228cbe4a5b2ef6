// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "semantic/history/history.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

using semantic::Event;
using semantic::EventKind;
using semantic::History;
using semantic::HistoryAccess;

Event sighting(const std::string& recording, std::int64_t time_ns, const std::string& parent) {
  Event event;
  event.subject = "blue-cup";
  event.time_ns = time_ns;
  event.recording = recording;
  event.after = semantic::Placement{parent, semantic::Relation::kOn, {}};
  event.evidence = "evidence/" + recording + ".jpg";
  return event;
}

class HistoryCommands : public testing::Test {
 protected:
  HistoryCommands() {
    (void)history_.append(std::vector{sighting("monday", 1'000'000'000, "table"), sighting("tuesday", 2'000'000'000, "shelf")});
    (void)home_.write("evidence/monday.jpg", "x");
    (void)home_.write("evidence/tuesday.jpg", "x");
  }

  [[nodiscard]] ProcessResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, home_.path().string());
    return runOikos(arguments);
  }
  [[nodiscard]] bool isThere(const std::string& image) const { return std::filesystem::exists(home_.path() / "evidence" / image); }

  TemporaryFolder home_;
  History history_{home_.path() / "history.sqlite", HistoryAccess::kAppend};  // open all the time, as a daemon has it
};

TEST_F(HistoryCommands, RevertTakesARecordingBackOnce) {
  const ProcessResult first = run({"revert", "tuesday"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, "took back 1 event of 1 thing; 1 has the state from before again\n");
  const auto newest = history_.findStateAt("blue-cup", 3'000'000'000);
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->kind, EventKind::kReverted);
  EXPECT_EQ(std::get<semantic::Placement>(*newest->after).parent, "table");
  const ProcessResult second = run({"revert", "tuesday"});
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_NE(second.err.find("already"), std::string::npos) << second.err;
  EXPECT_EQ(history_.lastNumber(), 3);
}

TEST_F(HistoryCommands, RevertAsJson) {
  const auto json = nlohmann::json::parse(run({"revert", "tuesday", "--json"}).out);
  EXPECT_EQ(json["recording"], "tuesday");
  EXPECT_EQ(json["events"], 1);
  EXPECT_EQ(json["subjects"], nlohmann::json({"blue-cup"}));
  EXPECT_EQ(json["restored"], nlohmann::json({"blue-cup"}));
}

TEST_F(HistoryCommands, AnUnknownRecordingOrObjectIsAnsweredWithTheNearest) {
  const ProcessResult revert = run({"revert", "tuseday"});
  EXPECT_EQ(revert.exit_code, 1);
  EXPECT_NE(revert.err.find("did you mean 'tuesday'?"), std::string::npos) << revert.err;
  const ProcessResult forget = run({"forget", "--object", "blue-cap"});
  EXPECT_EQ(forget.exit_code, 1);
  EXPECT_NE(forget.err.find("did you mean 'blue-cup'?"), std::string::npos) << forget.err;
  EXPECT_EQ(history_.lastNumber(), 2);
}

TEST_F(HistoryCommands, ForgetRemovesTheImagesOfARecording) {
  const ProcessResult first = run({"forget", "--recording", "monday"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, "removed 1 image\n");
  EXPECT_FALSE(isThere("monday.jpg"));
  EXPECT_TRUE(isThere("tuesday.jpg"));
  EXPECT_EQ(run({"forget", "--recording", "monday"}).out, "removed 0 images\n");
}

TEST_F(HistoryCommands, ForgetByTimeOrAllAsJson) {
  const auto before = nlohmann::json::parse(run({"forget", "--before", "1970-01-01T00:00:02Z", "--json"}).out);
  EXPECT_EQ(before["removed"], nlohmann::json({"evidence/monday.jpg"}));
  const auto all = nlohmann::json::parse(run({"forget", "--all", "--json"}).out);
  EXPECT_EQ(all["removed"], nlohmann::json({"evidence/tuesday.jpg"}));
  EXPECT_EQ(history_.eventsOf("blue-cup").back().kind, EventKind::kForgotten);
}

TEST_F(HistoryCommands, ForgetWantsToKnowWhose) {
  EXPECT_EQ(run({"forget"}).exit_code, 2);
  EXPECT_EQ(run({"forget", "--all", "--recording", "monday"}).exit_code, 2);
  EXPECT_EQ(run({"forget", "--before", "yesterday"}).exit_code, 2);
  EXPECT_TRUE(isThere("monday.jpg"));
}

TEST_F(HistoryCommands, AHomeWithoutAHistory) {
  const TemporaryFolder empty;
  EXPECT_EQ(runOikos({"revert", empty.path().string(), "monday"}).exit_code, 3);
  EXPECT_EQ(runOikos({"forget", (empty.path() / "nowhere").string(), "--all"}).exit_code, 4);
  EXPECT_FALSE(std::filesystem::exists(empty.path() / "history.sqlite"));
}

}  // namespace
}  // namespace oikos::test
