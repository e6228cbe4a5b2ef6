// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/answer.h"
#include "tools/daemon/handlers.h"
#include "tools/daemon/query_parameters.h"

namespace oikos::daemon {

Response answerAsk(const Call& call) {
  const std::optional<std::string_view> question = call.target.find("q");
  if (!question || question->empty()) {
    return failure(400, "bad_request", "q: the question is missing, such as /v1/ask?q=where+is+the+blue+cup");
  }
  (void)findRobot(call.target);
  (void)findTime_ns(call.target, "now");
  const std::shared_ptr<const HomeView> view = call.service.view();
  Response response;
  response.status = 200;
  response.body = semantic::toJson(semantic::answerQuestion(view->index, *question));
  return response;
}

}  // namespace oikos::daemon
