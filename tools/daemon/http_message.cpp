// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/http_message.h"

#include <nlohmann/json.hpp>

namespace oikos::daemon {

Response failure(int status, std::string_view code, std::string_view message) {
  using Json = nlohmann::ordered_json;
  Response response;
  response.status = status;
  response.body = Json{{"code", code}, {"message", message}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  return response;
}

}  // namespace oikos::daemon
