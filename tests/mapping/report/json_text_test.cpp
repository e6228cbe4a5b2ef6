// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/json_text.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace oikos::mapping {
namespace {

using Json = nlohmann::ordered_json;

TEST(JsonText, MembersOnLinesRowsOnOne) {
  const Json json = {{"b", 1}, {"a", {1, 2.5, nullptr}}, {"rows", {{0.5, "x", {1, 2, 3}}, {1.5, "y", nullptr}}}, {"none", Json::array()}};
  EXPECT_EQ(jsonText(json),
            "{\n \"b\": 1,\n \"a\": [1,2.5,null],\n \"rows\": [\n  [0.5,\"x\",[1,2,3]],\n  [1.5,\"y\",null]\n ],\n \"none\": []\n}\n");
}

TEST(JsonText, ReadsBackAsTheSame) {
  const Json json = {{"text", "a \"b\"\n<c> é"}, {"number", 0.1}, {"big", 9007199254740993}, {"list", {{{"k", "v"}}, {{"k", true}}}}};
  EXPECT_EQ(Json::parse(jsonText(json)), json);
}

TEST(JsonText, BytesThatAreNoTextAndNumbersThatAreNone) {
  const std::string text = jsonText({{"name", "caf\xC3"}, {"value", std::numeric_limits<double>::quiet_NaN()}});
  const Json read = Json::parse(text);
  EXPECT_EQ(read["name"], "caf\xEF\xBF\xBD");
  EXPECT_TRUE(read["value"].is_null());
}

}  // namespace
}  // namespace oikos::mapping
