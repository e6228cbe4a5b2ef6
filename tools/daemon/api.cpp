// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/api.h"

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "semantic/history/event_json.h"

namespace oikos::daemon {

namespace {

std::vector<std::string> namesOfRoutes() {
  std::vector<std::string> names;
  for (const Route& route : routes()) {
    names.push_back(std::string(route.method) + " " + std::string(route.path));
  }
  return names;
}

Response noRoute(const RouteMatch& match) {
  if (match.methods.empty()) {
    return failure(404, "not_found", "there is nothing at this path; GET /v1/ask?q=... answers questions");
  }
  std::string allowed;
  for (const std::string_view method : match.methods) {
    allowed += (allowed.empty() ? "" : ", ") + std::string(method);
  }
  Response response = failure(405, "method_not_allowed", "this path takes " + allowed + " only");
  response.headers.emplace_back("Allow", allowed);
  return response;
}

std::optional<Response> unknownParameter(const Route& route, const RequestTarget& target) {
  const std::vector<std::string> known(route.parameters.begin(), route.parameters.end());
  for (const auto& [name, value] : target.query) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string shown = name.substr(0, 64);
      return failure(400, "bad_request", "no parameter '" + shown + "'" + base::didYouMean(shown, known));
    }
  }
  return std::nullopt;
}

Response unauthorized() {
  Response response =
      failure(401, "unauthorized", "this needs the header 'Authorization: Bearer TOKEN' with the token of the daemon's token file");
  response.headers.emplace_back("WWW-Authenticate", "Bearer");
  return response;
}

}  // namespace

Api::Api(Service& service, AccessRules rules, AccessLog* log)
    : service_(service), rules_(std::move(rules)), log_(log), metrics_(namesOfRoutes()), metrics_text_([this] { return metricsText(); }) {}

Admission Api::admit(const Request& request) {
  if (!rules_.allowsHost(request.host)) {
    return {
        failure(403, "foreign_host", "the Host header must name this daemon: localhost, an address in digits, or the name it listens at"),
        false};
  }
  const std::optional<RequestTarget> target = parseRequestTarget(request.target);
  if (!target) {
    return {failure(400, "bad_request", "the address is not /PATH?QUERY with % and two hexadecimal digits where it is encoded"), false};
  }
  const RouteMatch match = findRoute(request.method, *target);
  if (match.route == nullptr) {
    return {noRoute(match), false};
  }
  if (!rules_.allows(match.route->access, request.authorization)) {
    return {unauthorized(), false};
  }
  return {unknownParameter(*match.route, *target), match.route->may_wait};
}

Response Api::respond(const Request& request) {
  try {
    const std::optional<RequestTarget> target = parseRequestTarget(request.target);
    OIKOS_CHECK(target.has_value());
    RouteMatch match = findRoute(request.method, *target);
    OIKOS_CHECK(match.route != nullptr);
    return match.route->handle({request, *target, service_, metrics_text_, std::move(match.id)});
  } catch (const base::Error& error) {
    const bool wrong = error.code() != base::ErrorCode::kIo;
    return wrong ? failure(400, "bad_request", error.what()) : failure(503, "unavailable", error.what());
  } catch (const std::bad_alloc&) {
    return failure(503, "unavailable", "the operating system gave no more memory");
  } catch (const std::exception& error) {
    return failure(500, "internal", std::string("internal error, please report it: ") + error.what());
  }
}

EventBatch Api::eventsAfter(std::int64_t number) {
  constexpr std::size_t kMost = 256;
  EventBatch batch{"", number};
  try {
    for (const semantic::Event& event : service_.history().eventsAfter(number, kMost)) {
      batch.text += "id: " + std::to_string(event.number) + "\ndata: " + semantic::toJson(event).dump() + "\n\n";
      batch.last = event.number;
    }
  } catch (const std::exception&) {
    return batch;  // the stream waits until the history can be read again; /readyz says why it cannot
  }
  return batch;
}

void Api::finished(const Exchange& exchange) {
  const std::optional<RequestTarget> target = parseRequestTarget(exchange.request.target);
  const Route* const route = target ? findRoute(exchange.request.method, *target).route : nullptr;
  metrics_.count(route == nullptr ? routes().size() : static_cast<std::size_t>(route - routes().data()), exchange.status, exchange.took);
  if (log_ != nullptr) {
    log_->add(accessLine(exchange, service_.now_ns()));
  }
}

Response Api::handle(const Request& request) {
  Admission admission = admit(request);
  return admission.refusal ? std::move(*admission.refusal) : respond(request);
}

std::string Api::metricsText() const {
  std::string text = metrics_.text();
  if (log_ != nullptr) {
    text += metricText("oikos_access_log_dropped_total", "counter", "Lines of the access log that nobody took in time.", log_->dropped());
  }
  return text + (server_metrics_ ? server_metrics_() : "");
}

}  // namespace oikos::daemon
