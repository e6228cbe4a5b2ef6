// SPDX-License-Identifier: Apache-2.0
// The one list of what the daemon answers. schemas/openapi.yaml describes the same for others; a test holds them against each other.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/daemon/access_rules.h"
#include "tools/daemon/http_message.h"
#include "tools/daemon/request_target.h"
#include "tools/daemon/service.h"

namespace oikos::daemon {

/// What a handler has at hand.
struct Call {
  const Request& request;
  const RequestTarget& target;
  Service& service;
  const std::function<std::string()>& metrics;  ///< the server's, as text
  std::string id;                               ///< what stands for {id} in the path
};

struct Route {
  std::string_view method;
  std::string_view path;  ///< with {id} for one segment
  std::vector<std::string_view> parameters;
  Access access = Access::kWrite;
  bool may_wait = true;                       ///< for the disk, or works through the whole home
  Response (*handle)(const Call&) = nullptr;  ///< throws Error{kInput} for what the client did wrong, Error{kIo} for what the disk did
};

[[nodiscard]] std::span<const Route> routes();

struct RouteMatch {
  const Route* route = nullptr;  ///< null: none has this path and method
  std::string id;
  std::vector<std::string_view> methods;  ///< of the path; empty: there is no such path
};
/// HEAD is a GET.
[[nodiscard]] RouteMatch findRoute(std::string_view method, const RequestTarget& target);

}  // namespace oikos::daemon
