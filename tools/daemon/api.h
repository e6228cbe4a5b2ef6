// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "tools/daemon/access_log.h"
#include "tools/daemon/http_server.h"
#include "tools/daemon/metrics.h"
#include "tools/daemon/routes.h"

namespace oikos::daemon {

/// The daemon without its socket: who may ask, which handler answers, what is logged and counted. Thread-safe.
class Api : public RequestHandler {
 public:
  /// `log` may be null: no access log. All must outlive the Api.
  Api(Service& service, AccessRules rules, AccessLog* log);

  [[nodiscard]] Admission admit(const Request& request) override;
  /// Of a request that was admitted.
  [[nodiscard]] Response respond(const Request& request) override;
  [[nodiscard]] EventBatch eventsAfter(std::int64_t number) override;
  void finished(const Exchange& exchange) override;

  /// admit() and respond().
  [[nodiscard]] Response handle(const Request& request);

  /// Further lines for /metrics: what only the server knows. Not thread-safe.
  void addMetrics(std::function<std::string()> text) { server_metrics_ = std::move(text); }

 private:
  [[nodiscard]] std::string metricsText() const;

  Service& service_;
  const AccessRules rules_;
  AccessLog* const log_;
  RequestMetrics metrics_;
  std::function<std::string()> server_metrics_;
  const std::function<std::string()> metrics_text_;
};

}  // namespace oikos::daemon
