// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "semantic/query/answer.h"
#include "tools/daemon/handlers.h"
#include "tools/daemon/query_parameters.h"

namespace oikos::daemon {

Response answerAsk(const Call& call) {
  const std::optional<std::string_view> question = call.target.find("q");
  if (!question || question->empty()) {
    return failure(400, "bad_request", "q: the question is missing, such as /v1/ask?q=where+is+the+blue+cup");
  }
  std::optional<semantic::RobotPlace> robot;
  if (const auto T_map_base = findRobot(call.target)) {
    robot = semantic::RobotPlace{T_map_base->translation().head<2>(), std::atan2(T_map_base->linear()(1, 0), T_map_base->linear()(0, 0))};
  }
  const std::int64_t now_ns = findTime_ns(call.target, "now").value_or(call.service.now_ns());
  const std::shared_ptr<const HomeView> view = call.service.view();
  Response response;
  response.status = 200;
  response.body = semantic::toJson(
      semantic::answerQuestion({&view->index, &call.service.history(), now_ns, robot, &call.service.recollection()}, *question));
  return response;
}

}  // namespace oikos::daemon
