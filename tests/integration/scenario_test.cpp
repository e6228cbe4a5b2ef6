// SPDX-License-Identifier: Apache-2.0
// METHODS S105 from end to end: the demo apartment is mapped once, believed to 5 mm; then twelve short recordings are tracked between
// which, and in which, doors, drawers and knobs are moved. After each the home is as the apartment is, and says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/read_file.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"
#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kDemoHome = OIKOS_SOURCE_DIR "/homes/demo/home.xml";

/// What changes: a joint's value with its unit, a knob's state, or a piece's new pose, as a scene writes it.
struct Change {
  std::string id;
  std::string value;
  double at_s = 0.0;  ///< of the recording; 0: before it
};

struct Visit {
  std::string route;
  std::vector<Change> changes;
};

/// Start and waypoints of a drive through a room.
struct Route {
  std::string start;
  std::string waypoints;
};
const std::map<std::string, Route> kRoutes = {
    {"kitchen", {"1.4, 1.6, 125", R"("1.35 1.75 yaw 118", "1.2 2.1 yaw 65")"}},
    {"oven", {"1.3, 2.3, 85", R"("1.4 2.9 yaw 90", "1.5 2.95 yaw 95")"}},
    {"living room", {"2.1, -1.9, -90", R"("2.2 -2.7 look 40", "1.9 -2.6 yaw -165")"}},
};

const std::vector<Visit> kVisits = {
    {"kitchen", {{"fridge-door-joint", "70 deg"}, {"drawers-drawer_0-joint", "0.25 m"}}},
    {"oven", {{"oven-knob_2", "4"}, {"dishwasher-door-joint", "50 deg"}}},
    {"living room", {{"chest-drawer_1-joint", "0.2 m"}, {"sideboard-left_door-joint", "60 deg"}}},
    {"kitchen", {{"fridge-door-joint", "0 deg", 1.6}, {"drawers-drawer_1-joint", "0.3 m"}}},
    {"oven", {{"oven-knob_2", "0"}, {"oven-knob_0", "3", 3.2}}},
    {"living room", {}},
    {"kitchen", {{"drawers-drawer_0-joint", "0 m"}, {"oven-door-joint", "60 deg"}}},
    {"oven", {{"dishwasher-door-joint", "0 deg"}, {"oven-door-joint", "0 deg"}, {"oven-knob_4", "6"}, {"oven-knob_0", "9"}}},
    {"living room", {{"chest-drawer_1-joint", "0 m"}, {"chest-drawer_2-joint", "0.15 m"}}},
    {"kitchen", {{"fridge-freezer_door-joint", "90 deg", 1.6}, {"drawers-drawer_1-joint", "0.1 m"}}},
    {"oven", {{"oven-knob_0", "0"}, {"oven-knob_4", "0"}}},
    {"living room", {{"sideboard-left_door-joint", "0 deg"}, {"sideboard-right_door-joint", "75 deg"}}},
};

const std::vector<std::string> kRoomDoors = {"kitchen-door-door-joint", "bathroom-door-door-joint", "living-door-door-joint",
                                             "bedroom-door-door-joint"};

class Scenario : public ::testing::Test {
 protected:
  void SetUp() override {
    semantic::Home home = semantic::getHome(semantic::readHome(kDemoHome), kDemoHome);
    for (const std::string& door : kRoomDoors) {
      values_[door] = "95 deg";
    }
    for (semantic::Room& room : home.rooms) {
      for (auto& object : room.objects) {
        open(object);
      }
    }
    (void)folder_.write("home/home.xml", semantic::toXml(home));
  }

  /// The doors of rooms stand open from the start, and the home knows it.
  static void open(semantic::CopyOnWrite<semantic::LargeObject>& object) {
    const semantic::LargeObject& piece = object;
    if (piece.articulation) {
      for (semantic::Joint& joint : object.edit().articulation->joints) {
        if (std::find(kRoomDoors.begin(), kRoomDoors.end(), joint.id.value) != kRoomDoors.end()) {
          joint.value = 95.0 * semantic::kRadPerDeg;
        }
      }
    }
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  void simulate(const std::string& name, const std::string& text) const {
    const std::string belief = "[belief]\ndimension_m = 0.005\nplacement_m = 0.005\nplacement_deg = 0.3\naxis_m = 0.003\naxis_deg = 0.5\n";
    const fs::path file = folder_.write("home/scenes/" + name + ".toml", text + belief);
    const ProcessResult simulated = runOikos({"simulate", file.string(), "--out", path(name), "--quiet"});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  }

  [[nodiscard]] std::string changesText(const std::vector<Change>& changes) const {
    std::string text;
    for (const auto& [id, value] : values_) {
      text += "\"" + id + " " + value + "\", ";
    }
    for (const Change& change : changes) {
      const std::string at = change.at_s > 0.0 ? "@" + base::toFixedText(change.at_s, 1) + " " : "";
      text += "\"" + at + change.id + " " + change.value + "\", ";
    }
    return "changes = [" + text + "]\n";
  }

  void deploy() const {
    simulate("deployment", "start = \"2026-03-02T08:00:00Z\"\nrate_hz = 6\nsensor = \"kinect1\"\n" + changesText({}) +
                               "[path]\nwaypoints = [\"1.1 0.1\", \"1.38 1.6 look -40 yaw 120\", \"1.3 2.6 yaw 90\", \"2.1 -1.7\", "
                               "\"2.2 -2.6 look 60 yaw -160\", \"0.0 0.0 yaw 0\"]\nspeed_mps = 0.6\nturn_rate_dps = 45\n");
    const ProcessResult mapped = runOikos({"map", path("deployment"), "--out", path("home"), "--quiet"});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  }

  /// Tracked, with what it says.
  Json track(int number, const Visit& visit) {
    const Route& route = kRoutes.at(visit.route);
    const std::string name = "visit-" + std::to_string(number);
    simulate(name, "start = \"2026-03-03T" + std::to_string(10 + number) +
                       ":00:00Z\"\nrate_hz = 8\nsensor = \"kinect1\"\nduration_s = 7.9\n" + changesText(visit.changes) +
                       "[path]\nstart = [" + route.start + "]\nwaypoints = [" + route.waypoints +
                       "]\nspeed_mps = 0.6\nturn_rate_dps = 50\nstand_s = 0.4\n");
    for (const Change& change : visit.changes) {
      values_[change.id] = change.value;
    }
    const ProcessResult tracked = runOikos({"track", path("home"), path(name), "--json", "--quiet"});
    EXPECT_EQ(tracked.exit_code, 0) << tracked.err;
    return Json::parse(tracked.out)["recordings"][0];
  }

  [[nodiscard]] Json wrongStates(int number) const {
    const ProcessResult result = runOikos({"evaluate", "states", path("home"), path("visit-" + std::to_string(number)), "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Json answer = Json::parse(result.out);
    EXPECT_GE(answer["states"].size(), 46U);
    Json wrong = Json::array();
    for (const Json& state : answer["states"]) {
      if (!state["right"].get<bool>()) {
        wrong.push_back(state);
      }
    }
    return wrong;
  }

  [[nodiscard]] Json ask(const std::string& question) const {
    const ProcessResult asked = runOikos({"ask", path("home"), question, "--json"});
    EXPECT_EQ(asked.exit_code, 0) << question << ": " << asked.err << asked.out;
    return Json::parse(asked.out);
  }

  /// As the apartment is.
  [[nodiscard]] std::set<std::string> openDoors() const {
    std::set<std::string> open;
    for (const auto& [id, value] : values_) {
      if (value.ends_with(" deg") && value != "0 deg") {
        open.insert(id);
      }
    }
    return open;
  }
  [[nodiscard]] std::map<std::string, std::string> knobs() const {
    std::map<std::string, std::string> settings;
    for (int i = 0; i < 5; ++i) {
      const std::string id = "oven-knob_" + std::to_string(i);
      settings[id] = values_.contains(id) ? values_.at(id) : "0";
    }
    return settings;
  }

  TemporaryFolder folder_;
  std::map<std::string, std::string> values_;  ///< as the apartment is, where that is not closed and 0
};

/// Of the doors that an answer tells of, the joints that stand open.
std::set<std::string> openJointsOf(const Json& answer) {
  std::set<std::string> open;
  for (const Json& thing : answer["found"]) {
    for (const Json& joint : thing["joints"]) {
      if (joint.contains("value_deg") && joint["value_deg"].get<double>() > 2.0) {
        open.insert(joint["id"].get<std::string>());
      }
    }
  }
  return open;
}

TEST_F(Scenario, TheHomeFollowsTwelveRecordings) {
  deploy();
  for (int number = 1; const Visit& visit : kVisits) {
    SCOPED_TRACE("visit " + std::to_string(number) + ", " + visit.route);
    std::set<std::string> changed;
    for (const Change& change : visit.changes) {
      changed.insert(change.id);
    }
    const Json recording = track(number, visit);
    std::set<std::string> told;
    for (const Json& event : recording["events"]) {
      EXPECT_TRUE(told.insert(event["subject"]).second) << event.dump();
      EXPECT_EQ(base::readFile(folder_.path() / "home" / event["evidence"].get<std::string>()).substr(0, 2), "\xFF\xD8");
    }
    EXPECT_EQ(told, changed);
    EXPECT_EQ(wrongStates(number), Json::array());

    EXPECT_EQ(openJointsOf(ask("which doors are open?")), openDoors());
    std::map<std::string, std::string> settings;
    const Json set_to = ask("what is the oven set to?");
    for (const Json& knob : set_to["found"]) {
      settings[knob["id"]] = knob["setting"];
    }
    EXPECT_EQ(settings, knobs());
    std::set<std::string> answered;
    const Json since = ask("what changed since the last recording?");
    for (const Json& change : since["changes"]) {
      answered.insert(change["event"]["subject"]);
    }
    EXPECT_EQ(answered, changed);
    ++number;
  }
  EXPECT_EQ(runOikos({"check", path("home")}).exit_code, 0);
}

}  // namespace
}  // namespace oikos::test
