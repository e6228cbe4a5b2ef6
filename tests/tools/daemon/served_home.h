// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tools/daemon/api.h"

namespace oikos::daemon {

/// A copy of one of the homes, the papers' house if none is named, that is served without a socket. Its clock stands at
/// 2024-05-17T12:00:00Z.
struct ServedHome {
  static constexpr std::int64_t kNow_ns = 1'715'947'200'000'000'000;

  explicit ServedHome(const std::string& home = "papers", AccessRules rules = {"127.0.0.1", "the-token", false}) {
    std::filesystem::copy(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes" / home / "home.xml", folder.path() / "home.xml");
    service = std::make_unique<Service>(folder.path(),
                                        Service::Hooks{[] { return kNow_ns; },
                                                       [this](const std::string& line) {
                                                         ++reports;
                                                         last_report = line;
                                                       }},
                                        ServiceConfig{.quick_index = std::chrono::minutes(1)});  // never old, however slow the test runs
    api = std::make_unique<Api>(*service, std::move(rules), nullptr);
  }

  [[nodiscard]] Response get(const std::string& target) const {
    return api->handle({"GET", target, "localhost:7777", "", "", "", "127.0.0.1"});
  }
  [[nodiscard]] nlohmann::json getJson(const std::string& target) const { return nlohmann::json::parse(get(target).body); }
  [[nodiscard]] Response post(const std::string& body, const std::string& authorization = "Bearer the-token") const {
    return api->handle({"POST", "/v1/observations", "localhost", authorization, "", body, "127.0.0.1"});
  }

  test::TemporaryFolder folder;
  std::atomic<int> reports = 0;
  std::string last_report;
  std::unique_ptr<Service> service;
  std::unique_ptr<Api> api;
};

}  // namespace oikos::daemon
