// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/routes.h"

#include "tools/daemon/handlers.h"

namespace oikos::daemon {

namespace {

/// Whether the path has the pattern's segments; `id` becomes the one that stands for {id}.
bool fits(std::string_view pattern, const std::vector<std::string>& path, std::string& id) {
  std::size_t number = 0;
  while (!pattern.empty()) {
    pattern.remove_prefix(1);
    const std::string_view segment = pattern.substr(0, pattern.find('/'));
    pattern.remove_prefix(segment.size());
    if (number == path.size()) {
      return false;
    }
    if (segment == "{id}") {
      id = path[number];
    } else if (segment != path[number]) {
      return false;
    }
    ++number;
  }
  return number == path.size();
}

}  // namespace

std::span<const Route> routes() {
  static const std::vector<Route> kRoutes{
      {"GET", "/v1/ask", {"q", "at", "now"}, Access::kRead, false, answerAsk},
      {"GET", "/v1/home", {}, Access::kRead, false, answerHome},
      {"GET", "/v1/rooms", {"offset", "limit"}, Access::kRead, true, answerRooms},
      {"GET",
       "/v1/objects",
       {"type", "color", "colour", "room", "relation", "text", "offset", "limit"},
       Access::kRead,
       true,
       answerObjects},
      {"GET", "/v1/objects/{id}", {}, Access::kRead, false, answerObject},
      {"GET", "/v1/objects/{id}/history", {"offset", "limit"}, Access::kRead, true, answerObjectHistory},
      {"GET", "/v1/changes", {"since", "offset", "limit"}, Access::kRead, true, answerChanges},
      {"GET", "/v1/state", {"at", "offset", "limit"}, Access::kRead, true, answerState},
      {"GET", "/v1/events", {}, Access::kRead, false, answerEvents},
      {"POST", "/v1/observations", {}, Access::kWrite, true, takeObservations},
      {"GET", "/healthz", {}, Access::kOpen, false, answerHealth},
      {"GET", "/readyz", {}, Access::kOpen, false, answerReadiness},
      {"GET", "/metrics", {}, Access::kRead, false, answerMetrics},
  };
  return kRoutes;
}

RouteMatch findRoute(std::string_view method, const RequestTarget& target) {
  RouteMatch match;
  for (const Route& route : routes()) {
    if (!fits(route.path, target.path, match.id)) {
      continue;
    }
    match.methods.push_back(route.method);
    if (route.method == method || (route.method == "GET" && method == "HEAD")) {
      match.route = &route;
      return match;
    }
  }
  return match;
}

}  // namespace oikos::daemon
