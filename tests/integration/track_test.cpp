// SPDX-License-Identifier: Apache-2.0
// `oikos track` on short drives through a kitchen of four pieces, small pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/read_file.h"
#include "semantic/history/history.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"
#include "tests/integration/daemon_process.h"
#include "tests/integration/process.h"
#include "tests/support/http_client.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kDemoHome = OIKOS_SOURCE_DIR "/homes/demo/home.xml";

/// Pieces of the demo home in a row, the robot's dock before them.
semantic::Home smallKitchen() {
  semantic::Home home = semantic::getHome(semantic::readHome(kDemoHome), kDemoHome);
  std::vector<semantic::CopyOnWrite<semantic::LargeObject>> row;
  for (const semantic::Room& room : home.rooms) {
    for (const auto& object : room.objects) {
      const std::vector<std::string> wanted = {"fridge", "drawers", "sink-cupboard", "washstand"};
      const semantic::LargeObject& piece = object;
      if (std::find(wanted.begin(), wanted.end(), piece.id.value) != wanted.end()) {
        row.push_back(object);
        row.back().edit().small_objects.clear();
        row.back().edit().T_map_object = {{2.6, -1.9 + 0.8 * static_cast<double>(row.size()), 0.0},
                                          {0.0, 0.0, 180.0 * semantic::kRadPerDeg}};
      }
    }
  }
  semantic::Room kitchen;
  kitchen.id = {"kitchen"};
  kitchen.name = "kitchen";
  kitchen.type = "kitchen";
  kitchen.outline_map = {{-1.0, -2.0}, {3.0, -2.0}, {3.0, 2.0}, {-1.0, 2.0}};
  kitchen.objects = std::move(row);
  home.rooms = {std::move(kitchen)};
  home.T_map_dock = {};
  return home;
}

std::string scene(const std::string& hour, const std::string& start, const std::string& changes) {
  return "start = \"2026-03-03T" + hour + ":00:00Z\"\nrate_hz = 8\nsensor = \"kinect1\"\nchanges = [" + changes +
         "]\n[camera]\nwidth = 320\nheight = 240\nfx = 262.5\nfy = 262.5\ncx = 159.5\ncy = 119.5\n[path]\nstart = [" + start +
         "]\nwaypoints = [\"0.3 0.1 yaw -28\", \"0.35 0.1 yaw 25\"]\nstand_s = 0.4\nspeed_mps = 0.5\n";
}

/// Every file below a folder but the lock, with its content.
std::map<std::string, std::string> contentOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename() != ".lock") {
      files[fs::relative(entry.path(), folder).string()] = base::readFile(entry.path());
    }
  }
  return files;
}

std::set<std::string> subjectsOf(const std::vector<semantic::Event>& events) {
  std::set<std::string> subjects;
  for (const semantic::Event& event : events) {
    subjects.insert(event.subject);
  }
  return subjects;
}

class Track : public ::testing::Test {
 protected:
  /// What the tests share: drives, and a mapped home that none of them changes.
  static void SetUpTestSuite() {
    shared_ = new TemporaryFolder();
    const std::string home = semantic::toXml(smallKitchen());
    (void)shared_->write("real/home.xml", home);
    simulate("first", scene("08", "0, 0, 0", ""));
    simulate("second", scene("09", "0.05, 0.02, 3", R"("fridge-door-joint 70 deg", "@3.5 drawers-drawer_0-joint 0.25 m")"));
    simulate("third", scene("10", "0.02, -0.05, -2", R"("drawers-drawer_0-joint 0.25 m", "sink-cupboard-left_door-joint 40 deg")"));
    const ProcessResult mapped = runOikos({"map", drive("first"), "--out", (shared_->path() / "mapped").string()});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
    (void)shared_->write("mapped/home.xml", home);  // its frame is that of the drive, which began on the dock
  }
  static void TearDownTestSuite() {
    delete shared_;
    shared_ = nullptr;
  }

  static void simulate(const std::string& name, const std::string& text) {
    const fs::path file = shared_->write("real/scenes/" + name + ".toml", text);
    const ProcessResult simulated = runOikos({"simulate", file.string(), "--out", drive(name)});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  }
  static std::string drive(const std::string& name) { return (shared_->path() / name).string(); }

  void SetUp() override { fs::copy(shared_->path() / "mapped", home_, fs::copy_options::recursive); }

  [[nodiscard]] ProcessResult track(std::vector<std::string> words) const {
    words.insert(words.begin(), {"track", home_.string()});
    return runOikos(words);
  }
  /// The joints of the home that are not as they were at the drive's end.
  [[nodiscard]] Json wrongStates(const std::string& name) const {
    const ProcessResult result = runOikos({"evaluate", "states", home_.string(), drive(name), "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Json answer = Json::parse(result.out);
    EXPECT_GE(answer["states"].size(), 9U);
    Json wrong = Json::array();
    for (const Json& state : answer["states"]) {
      if (!state["right"].get<bool>()) {
        wrong.push_back(state);
      }
    }
    return wrong;
  }
  [[nodiscard]] std::vector<semantic::Event> events() const {
    return semantic::History(home_ / "history.sqlite", semantic::HistoryAccess::kRead).eventsAfter(0, 1000);
  }

  static inline TemporaryFolder* shared_ = nullptr;
  TemporaryFolder folder_;
  fs::path home_ = folder_.path() / "home";
};

TEST_F(Track, ADryRunSaysAndWritesNothing) {
  const auto before = contentOf(home_);
  const ProcessResult result = track({drive("second"), drive("third"), "--dry-run", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_TRUE(json["dry_run"]);
  ASSERT_EQ(json["recordings"].size(), 2U);
  EXPECT_EQ(json["recordings"][0]["events"].size(), 2U);
  EXPECT_EQ(json["recordings"][1]["events"].size(), 2U);  // against what the first would have left
  EXPECT_EQ(json["recordings"][0]["pieces"].size(), 4U);
  EXPECT_TRUE(contentOf(home_) == before);
  const ProcessResult text = track({drive("second"), "--dry-run"});
  EXPECT_NE(text.out.find("fridge-freezer_door-joint         found"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("2 events would be written"), std::string::npos) << text.out;
}

TEST_F(Track, TheHomeFollowsWhatIsSeen) {
  ASSERT_EQ(track({drive("second")}).exit_code, 0);
  EXPECT_EQ(wrongStates("second"), Json::array());
  const std::vector<semantic::Event> first = events();
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(subjectsOf(first), (std::set<std::string>{"drawers-drawer_0-joint", "fridge-door-joint"}));
  for (const semantic::Event& event : first) {
    EXPECT_EQ(event.recording, "second");
    EXPECT_TRUE(event.subject == "fridge-door-joint" || event.frame == 28) << *event.frame;  // 3.5 s at 8 Hz
    EXPECT_EQ(base::readFile(home_ / event.evidence).substr(0, 3), "\xFF\xD8\xFF") << event.evidence;
    EXPECT_GT(event.confidence, 0.9);
    EXPECT_TRUE(event.before);
  }
  EXPECT_NE(base::readFile(home_ / "home.xml").find("asOf=\"2\""), std::string::npos);
  const ProcessResult asked = runOikos({"ask", home_.string(), "is the fridge open?", "--json"});
  EXPECT_TRUE(Json::parse(asked.out)["sentence"].get<std::string>().starts_with("Yes")) << asked.out;

  ASSERT_EQ(track({drive("third")}).exit_code, 0);
  EXPECT_EQ(wrongStates("third"), Json::array());
  EXPECT_EQ(events().size(), 4U);
  EXPECT_EQ(runOikos({"check", home_.string()}).exit_code, 0);
}

TEST_F(Track, ARecordingCountsOnceUntilItIsTakenBack) {
  ASSERT_EQ(track({drive("second")}).exit_code, 0);
  fs::copy(drive("second"), folder_.path() / "renamed", fs::copy_options::recursive);
  const ProcessResult again = track({(folder_.path() / "renamed").string(), "--json"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out)["recordings"][0]["status"], "tracked before");
  EXPECT_EQ(Json::parse(again.out)["recordings"][0]["name"], "second");
  EXPECT_EQ(events().size(), 2U);
  ASSERT_EQ(runOikos({"revert", home_.string(), "second"}).exit_code, 0);
  EXPECT_EQ(wrongStates("first"), Json::array());
  ASSERT_EQ(track({drive("second")}).exit_code, 0);
  EXPECT_EQ(wrongStates("second"), Json::array());
}

/// Events as they are said, without their numbers.
Json eventsOf(const ProcessResult& result) {
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json answer = Json::parse(result.out);
  Json events = Json::array();
  for (const Json& recording : answer["recordings"]) {
    events.push_back(recording["events"]);
  }
  return events;
}

TEST_F(Track, TheOrderOfTimeCountsForAnyNumberOfJobs) {
  const fs::path other = folder_.path() / "other";
  fs::copy(home_, other, fs::copy_options::recursive);
  const Json one = eventsOf(track({drive("second"), drive("third"), "--jobs", "1", "--json", "--threads", "1"}));
  const Json two = eventsOf(runOikos({"track", other.string(), drive("third"), drive("second"), "--jobs", "2", "--json"}));
  EXPECT_EQ(one, two);
  EXPECT_EQ(one.size(), 2U);
  EXPECT_EQ(base::readFile(home_ / "home.xml"), base::readFile(other / "home.xml"));
}

TEST_F(Track, ABadRecordingIsSaidAndTheOthersGoOn) {
  const fs::path broken = folder_.path() / "broken";
  fs::copy(drive("third"), broken, fs::copy_options::recursive);
  for (const auto& entry : fs::directory_iterator(broken / "depth")) {
    std::ofstream(entry.path(), std::ios::binary) << "no image";
  }
  const ProcessResult result = track({broken.string(), drive("second"), (folder_.path() / "missing").string(), "--json"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("broken/depth"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("missing"), std::string::npos) << result.err;
  const Json json = Json::parse(result.out);
  ASSERT_EQ(json["recordings"].size(), 3U);
  EXPECT_EQ(json["recordings"][0]["status"], "tracked");
  EXPECT_EQ(json["recordings"][1]["status"], "failed");
  EXPECT_EQ(json["recordings"][2]["code"], 4);
  EXPECT_EQ(wrongStates("second"), Json::array());
}

TEST_F(Track, WhatIsKilledGoesOnWhereItStopped) {
  for (const int signal : {SIGKILL, SIGINT}) {
    for (const int wait_ms : {150, 600, 1500}) {
      fs::remove_all(home_);
      SetUp();
      Process run({oikosBinary(), "track", home_.string(), drive("second"), drive("third")});
      if (!run.hasEndedWithin(std::chrono::milliseconds(wait_ms))) {
        run.send(signal);
      }
      const ProcessResult ended = run.finish();
      EXPECT_TRUE(ended.exit_code == 0 || ended.exit_code == (signal == SIGINT ? 130 : -SIGKILL)) << ended.exit_code << ended.err;
      ASSERT_EQ(track({drive("second"), drive("third")}).exit_code, 0);
      const std::vector<semantic::Event> all = events();
      ASSERT_EQ(all.size(), 4U) << signal << " after " << wait_ms << " ms";
      EXPECT_EQ(subjectsOf(all), (std::set<std::string>{"drawers-drawer_0-joint", "fridge-door-joint", "sink-cupboard-left_door-joint"}));
      EXPECT_EQ(wrongStates("third"), Json::array());
    }
  }
}

/// Two programs at once on one home, each with a recording of its own.
TEST_F(Track, WhatTwoTellAtOnceIsAllInTheHistoryOnce) {
  for (const int head_start_ms : {0, 40, 200}) {
    fs::remove_all(home_);
    SetUp();
    Process one({oikosBinary(), "track", home_.string(), drive("second"), "--json"});
    one.hasEndedWithin(std::chrono::milliseconds(head_start_ms));
    Process other({oikosBinary(), "track", home_.string(), drive("third"), "--json"});
    for (Process* const run : {&one, &other}) {
      const ProcessResult result = run->finish();
      ASSERT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(Json::parse(result.out)["recordings"][0]["status"], "tracked") << result.out;
      EXPECT_EQ(Json::parse(result.out)["recordings"][0]["events"].size(), 2U) << result.out;
    }
    std::map<std::string, std::set<std::string>> subjects;
    const std::vector<semantic::Event> all = events();
    for (const semantic::Event& event : all) {
      subjects[event.recording].insert(event.subject);
    }
    EXPECT_EQ(all.size(), 4U) << head_start_ms;
    EXPECT_EQ(subjects["second"], (std::set<std::string>{"drawers-drawer_0-joint", "fridge-door-joint"})) << head_start_ms;
    EXPECT_EQ(subjects["third"].size(), 2U) << head_start_ms;  // which the other is depends on who was first: the drawer, or the fridge
    EXPECT_TRUE(subjects["third"].contains("sink-cupboard-left_door-joint")) << head_start_ms;
    EXPECT_EQ(Json::parse(track({drive("second"), "--json"}).out)["recordings"][0]["status"], "tracked before");
    EXPECT_EQ(runOikos({"check", home_.string()}).exit_code, 0);
  }
}

TEST_F(Track, ARunningDaemonSeesIt) {
  const DaemonProcess daemon(home_);
  HttpConnection stream(daemon.port());
  ASSERT_TRUE(stream.send(getRequest("/v1/events")));
  const ProcessResult result = track({drive("second")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("home.xml is left"), std::string::npos) << result.err;
  std::string told = stream.receiveUntil("fridge-door-joint");
  if (told.find("drawers-drawer_0-joint") == std::string::npos) {  // in the order of their moments
    told += stream.receiveUntil("drawers-drawer_0-joint");
  }
  EXPECT_NE(told.find("fridge-door-joint"), std::string::npos) << told;
  EXPECT_NE(told.find("drawers-drawer_0-joint"), std::string::npos) << told;
}

TEST_F(Track, OnePieceOnDemand) {
  const ProcessResult result = track({drive("second"), "--object", "fridge", "--dry-run", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json recording = Json::parse(result.out)["recordings"][0];
  ASSERT_EQ(recording["pieces"].size(), 1U);
  EXPECT_EQ(recording["pieces"][0]["id"], "fridge");
  EXPECT_EQ(recording["events"].size(), 1U);
}

TEST_F(Track, SaysWhatIsMissing) {
  const ProcessResult unknown = track({drive("second"), "--object", "frigde"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("fridge"), std::string::npos) << unknown.err;
  EXPECT_EQ(track({drive("second"), "--start", "yesterday"}).exit_code, 2);
  EXPECT_EQ(track({drive("second"), drive("third"), "--from", "0,0,0"}).exit_code, 2);

  const fs::path undated = folder_.path() / "undated";
  fs::copy(drive("second"), undated, fs::copy_options::recursive);
  std::string calibration = base::readFile(undated / "camera.toml");
  const std::size_t begin = calibration.find("start =");
  ASSERT_NE(begin, std::string::npos);
  calibration.erase(begin, calibration.find('\n', begin) + 1 - begin);
  std::ofstream(undated / "camera.toml") << calibration;
  const ProcessResult when = track({undated.string()});
  EXPECT_EQ(when.exit_code, 3);
  EXPECT_NE(when.err.find("--start"), std::string::npos) << when.err;
  EXPECT_EQ(track({undated.string(), "--start", "2026-03-03T09:00:00Z"}).exit_code, 0);
  EXPECT_EQ(events().size(), 2U);

  fs::remove_all(home_ / "map");
  const ProcessResult unmapped = track({drive("third")});
  EXPECT_EQ(unmapped.exit_code, 2);
  EXPECT_NE(unmapped.err.find("oikos map"), std::string::npos) << unmapped.err;
  EXPECT_EQ(events().size(), 2U);
}

TEST_F(Track, EvaluateSaysWhatIsWrongAndWhy) {
  const std::string truth = "t,id,value,unit\n0,fridge-door-joint,70,deg\n0,drawers-drawer_0-joint,0.01,m\n0,no-such,1,deg\n";
  const fs::path file = folder_.write("truth/states.csv", truth);
  const ProcessResult result = runOikos({"evaluate", "states", home_.string(), file.parent_path().string(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["joints"]["states"], 2);
  EXPECT_EQ(json["joints"]["right"], 1);  // a drawer that is open by a centimetre is not wrong
  EXPECT_EQ(json["joints"]["wrong_never_observed"], 1);
  EXPECT_EQ(json["joints"]["confident_wrong"], 0);
  EXPECT_EQ(json["not_in_home"], Json::array({"no-such"}));
  const ProcessResult bad =
      runOikos({"evaluate", "states", home_.string(), folder_.write("b.csv", "t,id,value,unit\n0,a,b,deg\n").string()});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_NE(bad.err.find("b.csv:2"), std::string::npos) << bad.err;
  EXPECT_EQ(runOikos({"evaluate", "states", home_.string(), folder_.write("e.csv", "t,id,value,unit\n").string()}).exit_code, 1);
}

}  // namespace
}  // namespace oikos::test
