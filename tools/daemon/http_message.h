// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oikos::daemon {

/// What a client asks, as it came: nothing is decoded or trusted yet.
struct Request {
  std::string method;
  std::string target;  ///< path and query, percent-encoded
  std::string host;    ///< of the header; empty: none
  std::string authorization;
  std::string last_event_id;
  std::string body;
  std::string peer;  ///< the client's address, for the log
};

struct Response {
  int status = 500;
  std::string content_type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;  ///< beside the content type
  std::optional<std::int64_t> events_after;                  ///< set: no body, but a stream of the events after this number
};

/// {"code", "message"}: what every failure answers. `code` is one word for programs, `message` a sentence for people.
[[nodiscard]] Response failure(int status, std::string_view code, std::string_view message);

}  // namespace oikos::daemon
