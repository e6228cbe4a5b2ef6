// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <utility>

#include "tools/daemon/http_message.h"

namespace oikos::daemon {

/// Bytes that are no UTF-8 are replaced, so that every answer can be read.
[[nodiscard]] inline Response jsonResponse(const nlohmann::ordered_json& json) {
  Response response;
  response.status = 200;
  response.body = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return response;
}

}  // namespace oikos::daemon
