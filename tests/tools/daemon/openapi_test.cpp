// SPDX-License-Identifier: Apache-2.0
// schemas/openapi.yaml against the routes, both ways, and against what the handlers answer. The file is read as it is written: a path, a
// method and a schema's name have a line each at a fixed depth.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/tools/daemon/served_home.h"
#include "tools/daemon/routes.h"

namespace oikos::daemon {
namespace {

using Names = std::set<std::string>;

struct Operation {
  Names parameters;    ///< in the query
  std::string answer;  ///< name of the schema of its 200; empty: no JSON
  bool needs_token = false;
};

struct Description {
  std::map<std::string, Operation> operations;  ///< "GET /v1/home"
  std::map<std::string, Names> required;        ///< of a schema
};

std::string upperCase(std::string text) {
  for (char& c : text) {
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return text;
}

Names split(const std::string& list) {
  Names names;
  const std::regex name("[A-Za-z_]+");
  for (std::sregex_iterator i(list.begin(), list.end(), name), end; i != end; ++i) {
    names.insert(i->str());
  }
  return names;
}

Description readDescription() {
  std::ifstream file(std::filesystem::path(OIKOS_SOURCE_DIR) / "schemas/openapi.yaml");
  const std::regex path("  (/\\S*):");
  const std::regex method("    (get|post):");
  const std::regex query("        - \\{name: ([a-z]+), in: query.*");
  const std::regex page("        - \\$ref: \"#/components/parameters/(offset|limit)\"");
  const std::regex answer("        \"200\".*application/json.*#/components/schemas/([A-Za-z]+)\".*");
  const std::regex schema("    ([A-Z][A-Za-z]+):");
  const std::regex required("      required: \\[(.*)\\]");
  Description description;
  std::string here;
  Operation* operation = nullptr;
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_match(line, match, path) || std::regex_match(line, match, schema)) {
      here = match[1];
    } else if (std::regex_match(line, match, method)) {
      operation = &description.operations[upperCase(match[1]) + " " + here];
    } else if (std::regex_match(line, match, query) || std::regex_match(line, match, page)) {
      operation->parameters.insert(match[1]);
    } else if (std::regex_match(line, match, answer)) {
      operation->answer = match[1];
    } else if (std::regex_match(line, match, required)) {
      description.required[here] = split(match[1]);
    } else if (line == "      security:") {
      operation->needs_token = true;
    }
  }
  return description;
}

TEST(OpenApi, DescribesExactlyTheRoutes) {
  const Description description = readDescription();
  Names described;
  for (const auto& [name, operation] : description.operations) {
    described.insert(name);
  }
  Names served;
  for (const Route& route : routes()) {
    const std::string name = std::string(route.method) + " " + std::string(route.path);
    served.insert(name);
    ASSERT_EQ(description.operations.count(name), 1U) << name;
    EXPECT_EQ(description.operations.at(name).parameters, Names(route.parameters.begin(), route.parameters.end())) << name;
    EXPECT_EQ(description.operations.at(name).needs_token, route.access == Access::kWrite) << name;
  }
  EXPECT_EQ(described, served);
}

TEST(OpenApi, AnswersHaveTheKeysThatAreRequired) {
  const Description description = readDescription();
  const ServedHome home;
  const std::string event = R"({"subject": "fridge-hinge", "kind": "joint", "after": {"value_deg": 45}})";
  std::map<std::string, Response> answers{{"POST /v1/observations", home.post(event)}};
  for (const auto& [route, target] : std::map<std::string, std::string>{{"/v1/ask", "/v1/ask?q=where+is+the+bowl"},
                                                                        {"/v1/changes", "/v1/changes?since=2024-05-17T00:00:00Z"},
                                                                        {"/v1/objects/{id}", "/v1/objects/bowl"},
                                                                        {"/v1/objects/{id}/history", "/v1/objects/fridge/history"}}) {
    answers["GET " + route] = home.get(target);
  }
  for (const auto& [name, operation] : description.operations) {
    const Response response = answers.contains(name) ? answers[name] : home.get(name.substr(name.find(' ') + 1));
    ASSERT_EQ(response.status, 200) << name << response.body;
    if (operation.answer.empty()) {
      EXPECT_NE(response.content_type, "application/json") << name;
      continue;
    }
    const auto json = nlohmann::json::parse(response.body);
    ASSERT_FALSE(description.required.at(operation.answer).empty()) << operation.answer;
    for (const std::string& key : description.required.at(operation.answer)) {
      EXPECT_TRUE(json.contains(key)) << name << ": " << key;
    }
  }
}

TEST(OpenApi, ItemsOfListsHaveTheKeysThatAreRequired) {
  const Description description = readDescription();
  const ServedHome home;
  ASSERT_EQ(home.post(R"({"subject": "fridge-hinge", "kind": "joint", "after": {"value_deg": 45}})").status, 200);
  const auto expectKeys = [&](const nlohmann::json& item, const std::string& schema) {
    for (const std::string& key : description.required.at(schema)) {
      EXPECT_TRUE(item.contains(key)) << schema << ": " << key << "\n" << item;
    }
  };
  const auto objects = home.getJson("/v1/objects")["objects"];
  ASSERT_EQ(objects.size(), 7U);
  for (const auto& object : objects) {
    expectKeys(object, "Object");
    expectKeys(object["pose_map"], "Pose");
  }
  expectKeys(home.getJson("/v1/rooms")["rooms"][0], "Room");
  expectKeys(home.getJson("/v1/changes?since=2024-05-17T00:00:00Z")["events"][0], "Event");
  expectKeys(nlohmann::json::parse(home.get("/nowhere").body), "Failure");
}

}  // namespace
}  // namespace oikos::daemon
