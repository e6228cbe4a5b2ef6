// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/handlers.h"
#include "tools/daemon/json_response.h"
#include "tools/daemon/metrics.h"

namespace oikos::daemon {

Response answerHealth(const Call&) {
  return jsonResponse({{"status", "ok"}});
}

Response answerReadiness(const Call& call) {
  const std::string problem = call.service.problem();
  return problem.empty() ? jsonResponse({{"status", "ready"}}) : failure(503, "not_ready", problem);
}

Response answerMetrics(const Call& call) {
  const std::shared_ptr<const HomeView> view = call.service.view();
  Response response;
  response.status = 200;
  response.content_type = "text/plain; version=0.0.4";
  response.body = call.metrics();
  const auto add = [&](std::string_view name, std::string_view type, std::string_view help, std::int64_t value) {
    response.body += metricText(name, type, help, value);
  };
  add("oikos_home_things", "gauge", "Rooms, furniture, parts, knobs and small objects.", static_cast<std::int64_t>(view->index.size()));
  add("oikos_last_event_number", "gauge", "Of the last event that answers contain.", view->snapshot->home.as_of);
  add("oikos_index_builds_total", "counter", "How often the index was made.", call.service.indexBuilds());
  add("oikos_checkpoints_total", "counter", "How often home.xml was looked after.", call.service.checkpoints());
  add("oikos_checkpoint_failures_total", "counter", "How often home.xml could not be written.", call.service.checkpointFailures());
  add("oikos_ready", "gauge", "1: the home can be read and kept.", call.service.problem().empty() ? 1 : 0);
  return response;
}

}  // namespace oikos::daemon
