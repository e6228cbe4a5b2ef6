// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/metrics.h"

#include <algorithm>

#include "core/base/number_text.h"

namespace oikos::daemon {

namespace {

constexpr double kSecondsPerNs = 1e-9;
constexpr std::array<const char*, 6> kClassNames{"broken", "1xx", "2xx", "3xx", "4xx", "5xx"};

std::string headOf(std::string_view name, std::string_view type, std::string_view help) {
  std::string text = "# HELP ";
  text.append(name).append(" ").append(help).append("\n# TYPE ").append(name).append(" ").append(type).append("\n");
  return text;
}

}  // namespace

RequestMetrics::RequestMetrics(std::vector<std::string> routes) : routes_(routes.size() + 1) {
  for (std::size_t i = 0; i < routes.size(); ++i) {
    routes_[i].name = std::move(routes[i]);
  }
  routes_.back().name = "other";
}

void RequestMetrics::count(std::size_t route, int status, std::chrono::nanoseconds took) {
  const double took_s = static_cast<double>(took.count()) * kSecondsPerNs;
  const std::size_t bucket = static_cast<std::size_t>(std::lower_bound(kBounds_s.begin(), kBounds_s.end(), took_s) - kBounds_s.begin());
  const auto status_class = static_cast<std::size_t>(std::clamp(status / 100, 0, static_cast<int>(kStatusClasses) - 1));
  routes_[std::min(route, routes_.size() - 1)].requests[status_class].fetch_add(1, std::memory_order_relaxed);
  took_[bucket].fetch_add(1, std::memory_order_relaxed);
  took_ns_.fetch_add(took.count(), std::memory_order_relaxed);
}

std::string RequestMetrics::text() const {
  std::string text = headOf("oikos_http_requests_total", "counter", "Requests by route and class of the answer's status.");
  for (const Route& route : routes_) {
    for (std::size_t i = 0; i < kStatusClasses; ++i) {
      const std::int64_t count = route.requests[i].load(std::memory_order_relaxed);
      if (count > 0) {
        text += "oikos_http_requests_total{route=\"" + route.name + "\",status=\"" + kClassNames[i] + "\"} " + base::toText(count) + '\n';
      }
    }
  }
  const std::string name = "oikos_http_request_duration_seconds";
  text += headOf(name, "histogram", "From the request's line to the end of its answer.");
  std::int64_t total = 0;
  for (std::size_t i = 0; i < took_.size(); ++i) {
    total += took_[i].load(std::memory_order_relaxed);
    const std::string bound = i < kBounds_s.size() ? base::toText(kBounds_s[i]) : "+Inf";
    text.append(name).append("_bucket{le=\"").append(bound).append("\"} ").append(base::toText(total)).append("\n");
  }
  text += name + "_sum " + base::toText(static_cast<double>(took_ns_.load(std::memory_order_relaxed)) * kSecondsPerNs) + '\n';
  return text + name + "_count " + base::toText(total) + '\n';
}

std::string metricText(std::string_view name, std::string_view type, std::string_view help, std::int64_t value) {
  return headOf(name, type, help).append(name).append(" ") + base::toText(value) + '\n';
}

}  // namespace oikos::daemon
