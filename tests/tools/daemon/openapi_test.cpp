// SPDX-License-Identifier: Apache-2.0
// schemas/openapi.yaml against the routes, both ways, and against what the handlers answer.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "semantic/query/question.h"
#include "semantic/query/words.h"
#include "tests/support/openapi.h"
#include "tests/tools/daemon/served_home.h"
#include "tools/daemon/routes.h"

namespace oikos::daemon {
namespace {

using Json = nlohmann::json;
using Names = std::set<std::string>;

const std::filesystem::path kSource = OIKOS_SOURCE_DIR;

const test::OpenApi& description() {
  static const test::OpenApi file(kSource / "schemas/openapi.yaml");
  return file;
}

std::string upperCase(std::string text) {
  for (char& c : text) {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return text;
}

/// By "GET /v1/home".
std::map<std::string, Json> operations() {
  std::map<std::string, Json> all;
  for (const auto& [path, methods] : description().document().at("paths").items()) {
    for (const auto& [method, operation] : methods.items()) {
      all[upperCase(method) + " " + path] = operation;
    }
  }
  return all;
}

Names queryParameters(const Json& operation) {
  Names names;
  for (Json parameter : operation.value("parameters", Json::array())) {
    if (parameter.contains("$ref")) {
      parameter = description().document().at(Json::json_pointer(parameter["$ref"].get<std::string>().substr(1)));
    }
    if (parameter["in"] == "query") {
      names.insert(parameter["name"]);
    }
  }
  return names;
}

void expectAsDescribed(const Json& value, const Json& schema, const std::string& what) {
  for (const std::string& fault : description().faultsOf(value, schema)) {
    ADD_FAILURE() << what << ": " << fault;
  }
}

void expectIs(const std::string& schema, const Json& value, const std::string& what) {
  expectAsDescribed(value, description().schema(schema), what);
}

std::string percentEncoded(const std::string& text) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    encoded += std::isalnum(byte) != 0 ? std::string{c} : std::string{'%', kDigits[byte / 16], kDigits[byte % 16]};
  }
  return encoded;
}

std::string readLines(const std::filesystem::path& file, const std::string& separator) {
  std::ifstream input(file);
  std::string all;
  for (std::string line; std::getline(input, line);) {
    all += (all.empty() ? "" : separator) + line;
  }
  return all;
}

TEST(OpenApi, DescribesExactlyTheRoutes) {
  const auto described = operations();
  Names served;
  for (const Route& route : routes()) {
    const std::string name = std::string(route.method) + " " + std::string(route.path);
    served.insert(name);
    ASSERT_TRUE(described.contains(name)) << name;
    EXPECT_EQ(queryParameters(described.at(name)), Names(route.parameters.begin(), route.parameters.end())) << name;
    EXPECT_EQ(described.at(name).contains("security"), route.access == Access::kWrite) << name;
  }
  EXPECT_EQ(described.size(), served.size());
}

TEST(OpenApi, EveryRouteAnswersAsDescribed) {
  const ServedHome home;
  const std::string event = R"({"subject": "fridge-hinge", "kind": "joint", "after": {"value_deg": 45}})";
  std::map<std::string, Response> answers{{"POST /v1/observations", home.post(event)}};
  for (const auto& [route, target] : std::map<std::string, std::string>{{"/v1/ask", "/v1/ask?q=where+is+the+bowl"},
                                                                        {"/v1/changes", "/v1/changes?since=2024-05-17T00:00:00Z"},
                                                                        {"/v1/objects/{id}", "/v1/objects/bowl"},
                                                                        {"/v1/objects/{id}/history", "/v1/objects/fridge/history"}}) {
    answers["GET " + route] = home.get(target);
  }
  for (const auto& [name, operation] : operations()) {
    const Response response = answers.contains(name) ? answers[name] : home.get(name.substr(name.find(' ') + 1));
    ASSERT_EQ(response.status, 200) << name << response.body;
    const Json& content = operation.at("responses").at("200").at("content");
    const std::string type = response.content_type.substr(0, response.content_type.find(';'));
    ASSERT_TRUE(content.contains(type)) << name << ": " << type;
    if (type == "application/json") {
      expectAsDescribed(Json::parse(response.body), content.at(type).at("schema"), name);
    }
  }
  expectIs("Failure", Json::parse(home.get("/nowhere").body), "/nowhere");
}

TEST(OpenApi, EveryThingOfBothHomesIsAsDescribed) {
  Names kinds;
  for (const char* const name : {"papers", "household"}) {
    const ServedHome home(name);
    const auto view = home.service->view();
    for (std::uint32_t i = 0; i < view->index.size(); ++i) {
      const std::string id = view->index.thing(i).id();
      const Json thing = home.getJson("/v1/objects/" + id);
      kinds.insert(thing["kind"]);
      expectIs("Thing", thing, id);
    }
    expectIs("ObjectList", home.getJson("/v1/objects?limit=1000"), name);
    expectIs("RoomList", home.getJson("/v1/rooms"), name);
    expectIs("StateList", home.getJson("/v1/state?limit=1000"), name);
  }
  EXPECT_EQ(kinds, (Names{"room", "furniture", "part", "knob", "small_object"}));
}

/// Names of members that said something.
void noteSaid(const Json& object, Names& said) {
  for (const auto& [name, value] : object.items()) {
    if (!value.is_null() && !(value.is_array() && value.empty())) {
      said.insert(name);
    }
  }
}

Names described(const std::string& schema) {
  Names names;
  for (const auto& [name, member] : description().schema(schema).at("properties").items()) {
    names.insert(name);
  }
  return names;
}

TEST(OpenApi, AnswersToEveryKindOfQuestionAreAsDescribed) {
  const ServedHome papers;
  const ServedHome household("household");
  const ServedHome demo("demo");
  const std::string events = "[" + readLines(kSource / "tests/data/questions/demo_events.jsonl", ",") + "]";
  ASSERT_EQ(household.post(events).status, 200);
  Json picture = Json::parse(R"({"subject": "blue-cup", "kind": "sighted", "time": "2026-03-12T17:00:00Z", "recording": "r", "frame": 7,
                                 "evidence": "evidence/1.jpg", "confidence": 0.9})");
  picture["after"] = {{"parent", "kitchen-table"}, {"relation", "on"}, {"pose", {0.1, 0.1, 0.75, 0, 0, 0}}};
  ASSERT_EQ(household.post(picture.dump()).status, 200);
  std::set<semantic::QuestionKind> kinds;
  std::map<std::string, Names> said;
  Json questions = Json::array();
  for (const char* const table : {"table.json", "people.json", "talk.json", "strangers.json"}) {
    std::ifstream file(kSource / "tests/data/questions" / table);
    for (const Json& row : Json::parse(file)) {
      questions.push_back(row);
    }
  }
  for (const Json& row : questions) {
    const std::string question = row["question"];
    if (const auto parsed = semantic::parseQuestion(semantic::wordsOf(question)); parsed.question) {
      kinds.insert(parsed.question->kind);
    }
    const ServedHome& home = row["home"] == "papers" ? papers : row["home"] == "demo" ? demo : household;
    const Json answer = home.getJson("/v1/ask?at=0,0,0&now=" + row["now"].get<std::string>() + "&q=" + percentEncoded(question));
    expectIs("Answer", answer, question);
    noteSaid(answer, said["Answer"]);
    for (const Json& found : answer["found"]) {
      noteSaid(found, said["FoundThing"]);
      noteSaid(found["evidence"], said["Evidence"]);
    }
  }
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(semantic::QuestionKind::kDistance) + 1);
  for (const auto& [schema, names] : said) {
    EXPECT_EQ(names, described(schema)) << schema;  // else the questions did not try all of it
  }
}

TEST(OpenApiCheck, FindsWhatIsNotAsDescribed) {
  const auto faults = [](const char* value, const char* schema) {
    return description().faultsOf(Json::parse(value), Json::parse(schema)).size();
  };
  EXPECT_EQ(faults("1", R"({"type": "integer"})"), 0U);
  EXPECT_EQ(faults("1.5", R"({"type": "integer"})"), 1U);
  EXPECT_EQ(faults("null", R"({"type": "string"})"), 1U);
  EXPECT_EQ(faults("null", R"({"type": "string", "nullable": true})"), 0U);
  EXPECT_EQ(faults("2", R"({"maximum": 1})"), 1U);
  EXPECT_EQ(faults("[1, \"a\"]", R"({"items": {"type": "string"}, "maxItems": 1})"), 2U);
  EXPECT_EQ(faults(R"({"a": 1, "b": 2})", R"({"properties": {"a": {}}, "required": ["a", "c"]})"), 2U);
  EXPECT_EQ(faults(R"({"a": 1, "b": "x"})", R"({"properties": {"a": {}}, "additionalProperties": {"type": "string"}})"), 0U);
  EXPECT_EQ(faults(R"("noon")", R"({"format": "date-time"})"), 1U);
  EXPECT_EQ(faults(R"("in")", R"({"enum": ["on"]})"), 1U);
  EXPECT_EQ(faults("1", R"({"oneOf": [{"type": "number"}, {"type": "integer"}]})"), 1U);
  EXPECT_EQ(faults("1", R"({"pattern": "x"})"), 1U);
  EXPECT_EQ(faults(R"({"status": 1})", R"({"$ref": "#/components/schemas/Status"})"), 1U);
}

}  // namespace
}  // namespace oikos::daemon
