// SPDX-License-Identifier: Apache-2.0
// Any bytes as a request to the daemon's handlers: "METHOD TARGET", then lines "Name: value" up to an empty one, then the body. Whatever is
// not a stream, a text of metrics or nothing has to be JSON, with code and message if it failed.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"
#include "tools/daemon/api.h"

namespace {

using namespace oikos;

constexpr std::int64_t kNow_ns = 1'700'000'000'000'000'000;

/// The papers' house as it is served, on a copy.
struct Daemon {
  Daemon() {
    std::filesystem::copy(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml", folder.path() / "home.xml");
    service = std::make_unique<daemon::Service>(folder.path(), daemon::Service::Hooks{[] { return kNow_ns; }, [](const std::string&) {}});
    api = std::make_unique<daemon::Api>(*service, daemon::AccessRules{"127.0.0.1", "t", false}, nullptr);
  }
  test::TemporaryFolder folder;
  std::unique_ptr<daemon::Service> service;
  std::unique_ptr<daemon::Api> api;
};

std::string_view takeLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  return line;
}

daemon::Request parse(std::string_view text) {
  daemon::Request request;
  const std::string_view first = takeLine(text);
  const std::size_t space = first.find(' ');
  request.method = first.substr(0, space);
  request.target = space == std::string_view::npos ? std::string_view() : first.substr(space + 1);
  request.host = "localhost";
  for (std::string_view line = takeLine(text); !line.empty(); line = takeLine(text)) {
    for (const auto& [name, value] : {std::pair{std::string_view("Host: "), &request.host},
                                      {"Authorization: ", &request.authorization},
                                      {"Last-Event-ID: ", &request.last_event_id}}) {
      if (line.starts_with(name)) {
        *value = line.substr(name.size());
      }
    }
  }
  request.body = text;
  return request;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Daemon kDaemon;
  const daemon::Request request = parse({reinterpret_cast<const char*>(data), size});
  const daemon::Response response = kDaemon.api->handle(request);
  OIKOS_CHECK(response.status != 500);
  if (response.content_type == "application/json") {
    const auto json = nlohmann::json::parse(response.body);
    OIKOS_CHECK(response.status == 200 || (json.contains("code") && json.contains("message")));
  }
  (void)daemon::accessLine({request, response.status, response.body.size(), {}}, kNow_ns);
  kDaemon.api->finished({request, response.status, response.body.size(), {}});
  return 0;
}
