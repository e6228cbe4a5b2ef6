// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/api.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/tools/daemon/expect_failure.h"
#include "tests/tools/daemon/served_home.h"

namespace oikos::daemon {
namespace {

using Json = nlohmann::json;

std::vector<std::string> idsOf(const Json& list) {
  std::vector<std::string> ids;
  for (const Json& item : list) {
    ids.push_back(item["id"]);
  }
  return ids;
}

using Ids = std::vector<std::string>;

TEST(Api, AnswersQuestions) {
  const ServedHome home;
  const Json json = home.getJson("/v1/ask?q=where+is+the+blue+cup%3F&at=1,0,90&now=2024-05-17T12:00:00Z");
  EXPECT_EQ(json["status"], "answered");
  EXPECT_EQ(json["sentence"], "The blue cup is on the kitchen table in the kitchen.");
  EXPECT_EQ(json["found"][0]["id"], "blue-cup");
  EXPECT_EQ(home.get("/v1/ask?q=dance+for+me").status, 200);
  EXPECT_EQ(home.get("/v1/ask?q=a%00b%ff").status, 200);
  expectFailure(home.get("/v1/ask"), 400, "bad_request", "q: the question is missing");
  expectFailure(home.get("/v1/ask?q=a&at=1,2"), 400, "bad_request", "at: '1,2' is no x,y,yaw");
  expectFailure(home.get("/v1/ask?q=a&at=nan,2,3"), 400, "bad_request", "at: ");
  expectFailure(home.get("/v1/ask?q=a&now=noon"), 400, "bad_request", "now: 'noon' is no time such as");
  expectFailure(home.get("/v1/ask?question=a"), 400, "bad_request", "no parameter 'question'");
}

TEST(Api, ListsRoomsInPieces) {
  const ServedHome home;
  EXPECT_EQ(home.getJson("/v1/home")["rooms"], 2);
  EXPECT_EQ(home.getJson("/v1/home")["time_zone"], "Europe/Rome");
  const Json first = home.getJson("/v1/rooms?limit=1");
  EXPECT_EQ(idsOf(first["rooms"]), Ids{"kitchen"});
  EXPECT_EQ(first["rooms"][0]["outline_m"][1], Json({3.5, -2.0}));
  EXPECT_EQ(first["rooms"][0]["small_objects"], 4);
  EXPECT_EQ(first["total"], 2);
  EXPECT_EQ(first["next"], 1);
  const Json second = home.getJson("/v1/rooms?limit=1&offset=1");
  EXPECT_EQ(idsOf(second["rooms"]), Ids{"bathroom"});
  EXPECT_TRUE(second["next"].is_null());
  EXPECT_EQ(idsOf(home.getJson("/v1/rooms?offset=9223372036854775807")["rooms"]), Ids{});
  expectFailure(home.get("/v1/rooms?limit=0"), 400, "bad_request", "limit: '0' is no number from 1 to 1000");
  expectFailure(home.get("/v1/rooms?limit=1001"), 400, "bad_request", "limit: ");
  expectFailure(home.get("/v1/rooms?offset=-1"), 400, "bad_request", "offset: '-1' is no whole number");
}

TEST(Api, FiltersObjects) {
  const ServedHome home;
  const std::map<std::string, Ids> expected{
      {"?type=cup", {"red-cup", "blue-cup"}},
      {"?type=cup&color=blue", {"blue-cup"}},
      {"?colour=white", {"bowl"}},
      {"?room=bathroom", {"bathroom-door"}},
      {"?relation=on&offset=1&limit=2", {"bowl", "sugar"}},
      {"?relation=in", {}},
      {"?text=blue+cup", {"blue-cup"}},
      {"?text=cups&color=red", {"red-cup"}},
      {"?text=elephant", {}},
      {"?type=fridge", {"fridge"}},
      {"", {"table", "red-cup", "bowl", "sugar", "blue-cup", "cupboard", "fridge", "bathroom-door"}},
  };
  for (const auto& [query, ids] : expected) {
    EXPECT_EQ(idsOf(home.getJson("/v1/objects" + query)["objects"]), ids) << query;
  }
  EXPECT_EQ(home.getJson("/v1/objects?relation=on&limit=2")["total"], 4);
  const Json cup = home.getJson("/v1/objects?type=cup&color=blue")["objects"][0];
  EXPECT_EQ(cup["parent"], "table");
  EXPECT_EQ(cup["pose_map"]["x_m"], 2.1);
  EXPECT_EQ(cup["pose_map"]["yaw_deg"], 30.0);
  expectFailure(home.get("/v1/objects?relation=near"), 400, "bad_request", "relation: 'near' is none of on, in, under");
}

TEST(Api, SaysAllAboutOneThing) {
  const ServedHome home;
  const Json fridge = home.getJson("/v1/objects/fridge");
  EXPECT_EQ(fridge["joints"][0]["id"], "fridge-hinge");
  EXPECT_EQ(fridge["joints"][0]["open"], false);
  EXPECT_EQ(fridge["joints"][0]["upper_deg"], 120.0);
  EXPECT_EQ(fridge["knobs"][0]["setting"], "3");
  EXPECT_EQ(fridge["parking_poses_map"][0]["x_m"], 1.95);
  const Json cup = home.getJson("/v1/objects/blue-cup");
  EXPECT_EQ(cup["default_places"][1]["parent"], "cupboard-body");
  EXPECT_EQ(cup["properties"]["color"], "blue");
  EXPECT_EQ(cup["pose_parent"]["z_m"], 0.75);
  EXPECT_EQ(home.getJson("/v1/objects/fridge-door")["object"], "fridge");
  EXPECT_EQ(home.getJson("/v1/objects/fridge-thermostat")["states"].size(), 5U);
  EXPECT_EQ(home.getJson("/v1/objects/kitchen")["kind"], "room");
  expectFailure(home.get("/v1/objects/nothing"), 404, "not_found", "'nothing'");
  expectFailure(home.get("/v1/objects/..%2Fhome.xml"), 404, "not_found", "'../home.xml'");
}

TEST(Api, StoresObservationsAndTellsThem) {
  const ServedHome home;
  const Response stored = home.post(kFridgeOpened);
  ASSERT_EQ(stored.status, 200) << stored.body;
  const std::int64_t number = Json::parse(stored.body)["numbers"][0];
  EXPECT_EQ(home.getJson("/v1/home")["as_of"], number);
  EXPECT_EQ(home.getJson("/v1/objects/fridge")["joints"][0]["value_deg"], 45.0);
  EXPECT_EQ(home.getJson("/v1/ask?q=is+the+fridge+open")["status"], "answered");
  const Json history = home.getJson("/v1/objects/fridge/history");
  EXPECT_EQ(history["events"][0]["number"], number);
  EXPECT_EQ(history["events"][0]["after"]["value_deg"], 45.0);
  EXPECT_EQ(home.getJson("/v1/objects/fridge-thermostat/history")["total"], 0);
  EXPECT_EQ(home.getJson("/v1/changes?since=2024-05-17T11:59:00%2B02:00")["total"], 1);
  EXPECT_EQ(home.getJson("/v1/changes?since=2024-05-17T12:01:00+02:00")["total"], 0);
  EXPECT_EQ(home.getJson("/v1/changes?since=2024-05-17T10:00:00.000000001Z")["total"], 0);
  const EventBatch batch = home.api->eventsAfter(number - 1);
  EXPECT_EQ(batch.last, number);
  EXPECT_TRUE(batch.text.starts_with("id: " + std::to_string(number) + "\ndata: {")) << batch.text;
  EXPECT_TRUE(batch.text.ends_with("}\n\n")) << batch.text;
  EXPECT_EQ(home.api->eventsAfter(number).text, "");
  expectFailure(home.get("/v1/objects/nothing/history"), 404, "not_found", "'nothing'");
  expectFailure(home.get("/v1/changes"), 400, "bad_request", "since: the time is missing");
}

TEST(Api, TellsTheStateOfThePast) {
  const ServedHome home;
  ASSERT_EQ(home.post(kFridgeOpened).status, 200);
  const auto hinge = [&](const std::string& query) {
    const Json json = home.getJson("/v1/state" + query);
    for (const Json& state : json["states"]) {
      if (state["subject"] == "fridge-hinge") {
        return state["state"]["value_deg"].get<double>();
      }
    }
    return -1.0;
  };
  EXPECT_DOUBLE_EQ(hinge("?at=2024-05-17T09:59:59Z"), 0.0);
  EXPECT_DOUBLE_EQ(hinge("?at=2024-05-17T10:00:00Z"), 45.0);
  EXPECT_DOUBLE_EQ(hinge(""), 45.0);
  EXPECT_EQ(home.getJson("/v1/state")["at"], "2024-05-17T12:00:00Z");
  EXPECT_EQ(home.getJson("/v1/state")["total"], 13);  // 4 small objects, 4 pieces of furniture, 4 joints, 1 knob
  EXPECT_EQ(home.getJson("/v1/state?limit=2&offset=12")["states"].size(), 1U);
}

TEST(Api, AdmitsOnlyWhoMay) {
  const ServedHome home;
  expectFailure(home.post(kFridgeOpened, ""), 401, "unauthorized", "Bearer");
  expectFailure(home.post(kFridgeOpened, "Bearer the-tokem"), 401, "unauthorized", "Bearer");
  expectFailure(home.api->handle({"GET", "/healthz", "evil.example", "", "", "", ""}), 403, "foreign_host", "Host");
  expectFailure(home.api->handle({"GET", "/healthz", "", "", "", "", ""}), 403, "foreign_host", "Host");
  const Response put = home.api->handle({"PUT", "/v1/home", "localhost", "", "", "", ""});
  expectFailure(put, 405, "method_not_allowed", "GET");
  EXPECT_EQ(put.headers.at(0), (std::pair<std::string, std::string>{"Allow", "GET"}));
  expectFailure(home.get("/v1/nothing"), 404, "not_found", "nothing at this path");
  expectFailure(home.get("/../../etc/passwd"), 404, "not_found", "nothing at this path");
  expectFailure(home.get("/%zz"), 400, "bad_request", "hexadecimal");
  EXPECT_EQ(home.api->handle({"HEAD", "/v1/home", "localhost", "", "", "", ""}).status, 200);
}

TEST(Api, WhereOthersMayAskReadingNeedsTheTokenToo) {
  const ServedHome home("papers", {"0.0.0.0", "the-token", true});
  expectFailure(home.get("/v1/home"), 401, "unauthorized", "Bearer");
  expectFailure(home.get("/metrics"), 401, "unauthorized", "Bearer");
  EXPECT_EQ(home.get("/healthz").status, 200);
  EXPECT_EQ(home.get("/readyz").status, 200);
  EXPECT_EQ(home.api->handle({"GET", "/v1/home", "192.168.0.7:7777", "Bearer the-token", "", "", ""}).status, 200);
}

TEST(Api, StreamsBeginAfterTheGivenEventOrTheLast) {
  const ServedHome home;
  ASSERT_EQ(home.post("[" + std::string(kFridgeOpened) + "," + kFridgeOpened + "]").status, 200);
  const auto stream = [&](const std::string& last_id) { return home.api->handle({"GET", "/v1/events", "localhost", "", last_id, "", ""}); };
  EXPECT_EQ(stream("").events_after, 2);
  EXPECT_EQ(stream("1").events_after, 1);
  EXPECT_EQ(stream("0").events_after, 0);
  EXPECT_EQ(stream("77").events_after, 2);
  expectFailure(stream("-1"), 400, "bad_request", "Last-Event-ID: '-1'");
  expectFailure(stream("1x"), 400, "bad_request", "Last-Event-ID: '1x'");
}

TEST(Api, CountsWhatWasAsked) {
  const ServedHome home;
  const Request request{"GET", "/v1/objects/blue-cup", "localhost", "", "", "", ""};
  home.api->finished({request, 200, 10, std::chrono::microseconds(300)});
  home.api->finished({request, 200, 10, std::chrono::seconds(100)});
  home.api->finished({{"GET", "/elsewhere", "", "", "", "", ""}, 404, 0, {}});
  const std::string text = home.get("/metrics").body;
  for (const char* const line :
       {"oikos_http_requests_total{route=\"GET /v1/objects/{id}\",status=\"2xx\"} 2\n",
        "oikos_http_requests_total{route=\"other\",status=\"4xx\"} 1\n", "oikos_http_request_duration_seconds_bucket{le=\"0.00025\"} 1\n",
        "oikos_http_request_duration_seconds_bucket{le=\"5e-04\"} 2\n", "oikos_http_request_duration_seconds_bucket{le=\"10\"} 2\n",
        "oikos_http_request_duration_seconds_bucket{le=\"+Inf\"} 3\n", "oikos_http_request_duration_seconds_count 3\n",
        "# TYPE oikos_home_things gauge\n", "oikos_ready 1\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
}

}  // namespace
}  // namespace oikos::daemon
