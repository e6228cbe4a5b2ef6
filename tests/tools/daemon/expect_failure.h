// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tools/daemon/http_message.h"

namespace oikos::daemon {

/// An observation that the papers' house takes.
inline constexpr const char* kFridgeOpened =
    R"({"subject": "fridge-hinge", "kind": "joint", "time": "2024-05-17T10:00:00Z", "after": {"value_deg": 45}})";

/// {"code", "message"} and nothing else.
inline void expectFailure(const Response& response, int status, const std::string& code, const std::string& part_of_message) {
  EXPECT_EQ(response.status, status) << response.body;
  EXPECT_EQ(response.content_type, "application/json");
  const auto json = nlohmann::json::parse(response.body);
  EXPECT_EQ(json.size(), 2U) << response.body;
  EXPECT_EQ(json["code"], code);
  EXPECT_NE(json["message"].get<std::string>().find(part_of_message), std::string::npos) << response.body;
}

}  // namespace oikos::daemon
