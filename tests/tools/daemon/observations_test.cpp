// SPDX-License-Identifier: Apache-2.0
// What POST /v1/observations takes, and where it puts it.
#include <gtest/gtest.h>

#include <string>

#include "tests/tools/daemon/expect_failure.h"
#include "tests/tools/daemon/served_home.h"

namespace oikos::daemon {
namespace {

using Json = nlohmann::json;

/// "x, y, z, 0, 0, yaw" of a thing in map.
Json poseInMap(const ServedHome& home, const std::string& id) {
  const Json pose = home.getJson("/v1/objects/" + id)["pose_map"];
  return {pose["x_m"], pose["y_m"], pose["z_m"], pose["roll_deg"], pose["pitch_deg"], pose["yaw_deg"]};
}

Json sightingInMap(const std::string& subject, const Json& pose_map) {
  return {{"subject", subject}, {"kind", "sighted"}, {"after", {{"pose_map", pose_map}}}};
}

void expectPose(const Json& found, const Json& expected) {
  for (const char* const number : {"x_m", "y_m", "z_m", "roll_deg", "pitch_deg", "yaw_deg"}) {
    EXPECT_NEAR(found[number].get<double>(), expected[number].get<double>(), 1e-5) << number;
  }
}

TEST(Observations, RefusesObservationsThatAreNone) {
  const ServedHome home;
  const std::int64_t before = home.getJson("/v1/home")["as_of"];
  expectFailure(home.post(""), 400, "bad_request", "body: no JSON at byte");
  expectFailure(home.post("[1"), 400, "bad_request", "body: no JSON at byte");
  expectFailure(home.post("[]"), 400, "bad_request", "body: a list of 0 events");
  expectFailure(home.post("7"), 400, "bad_request", "event");
  expectFailure(home.post(std::string(100'000, '[')), 400, "bad_request", "nested more than 8 deep");
  expectFailure(home.post("{\"a\": 1e999}"), 400, "bad_request", "too great for a double");
  expectFailure(home.post(R"([{"subject": "nobody", "kind": "joint", "after": {"value_deg": 1}}])"), 400, "bad_request", "nobody");
  expectFailure(home.post(R"({"subject": "table", "kind": "edited"})"), 400, "bad_request", "'edited' is written by Oikos itself");
  expectFailure(home.post("[" + std::string(kFridgeOpened) + ", {}]"), 400, "bad_request", "events[1]");
  EXPECT_EQ(home.getJson("/v1/home")["as_of"], before);
}

TEST(Observations, PlacesWhatWasSeenInMapByGeometry) {
  const ServedHome home;
  Json pose_map = poseInMap(home, "red-cup");
  pose_map[2] = pose_map[2].get<double>() + 0.01;  // a centimetre too high: still on the table
  const Json before = home.getJson("/v1/objects/red-cup");
  ASSERT_EQ(home.post(sightingInMap("red-cup", pose_map).dump()).status, 200);
  const Json after = home.getJson("/v1/objects/red-cup");
  EXPECT_EQ(after["parent"], "table");
  EXPECT_EQ(after["relation"], "on");
  EXPECT_NEAR(after["pose_parent"]["z_m"].get<double>(), before["pose_parent"]["z_m"].get<double>() + 0.01, 1e-6);
  const Json event = home.getJson("/v1/objects/red-cup/history")["events"][0];
  EXPECT_EQ(event["after"]["parent"], "table");
  EXPECT_FALSE(event["after"].contains("pose_map"));

  ASSERT_EQ(home.post(sightingInMap("red-cup", {0.0, 0.0, 0.0, 0.0, 0.0, 45.0}).dump()).status, 200);
  const Json on_floor = home.getJson("/v1/objects/red-cup");
  EXPECT_EQ(on_floor["parent"], "kitchen");
  EXPECT_EQ(on_floor["pose_map"]["yaw_deg"], 45.0);
}

TEST(Observations, PlacesWhatWasSeenInADrawerThatWasSeenToBeOpen) {
  const ServedHome home("household");
  const Json chest = home.getJson("/v1/objects/chest");
  const std::string inside = chest["small_objects"][0];
  const Json shut = home.getJson("/v1/objects/" + inside);
  const std::string drawer = shut["parent"];
  const Json joint = home.getJson("/v1/objects/" + drawer)["joint"];
  ASSERT_EQ(joint["value_m"], 0.0);
  const Json open{{"subject", joint["id"]}, {"kind", "joint"}, {"after", {{"value_m", joint["upper_m"]}}}};
  ASSERT_EQ(home.post(open.dump()).status, 200);
  const Json pulled_out = home.getJson("/v1/objects/" + inside);  // it went with its drawer
  const Json pose_map = poseInMap(home, inside);
  const Json again{{"subject", joint["id"]}, {"kind", "joint"}, {"after", {{"value_m", 0.0}}}};
  ASSERT_EQ(home.post(again.dump()).status, 200);

  ASSERT_EQ(home.post(Json::array({open, sightingInMap(inside, pose_map)}).dump()).status, 200);
  const Json seen = home.getJson("/v1/objects/" + inside);
  EXPECT_EQ(seen["parent"], drawer);
  EXPECT_EQ(seen["relation"], "in");
  expectPose(seen["pose_parent"], shut["pose_parent"]);
  expectPose(seen["pose_map"], pulled_out["pose_map"]);
}

TEST(Observations, RefusesPosesInMapThatPlaceNothing) {
  const ServedHome home;
  const auto refused = [&](const Json& event, const std::string& message) {
    expectFailure(home.post(event.dump()), 400, "bad_request", message);
  };
  const Json origin{0, 0, 0, 0, 0, 0};
  refused(sightingInMap("red-cup", {100, 0, 0, 0, 0, 0}),
          "event: after: pose_map: expected a pose in map that is at some furniture or in a room");
  refused(sightingInMap("table", origin), "'table' is no small object");
  refused(sightingInMap("nobody", origin), "'nobody' is no small object");
  refused(sightingInMap("red-cup", {1, 2, 3}), "pose_map = [1,2,3]: expected six finite numbers");
  Json two_places = sightingInMap("red-cup", origin);
  two_places["after"]["parent"] = "table";
  refused(Json::array({two_places}), "events[0]: after: unknown key 'parent'");
  EXPECT_EQ(home.getJson("/v1/home")["as_of"], 0);
}

}  // namespace
}  // namespace oikos::daemon
