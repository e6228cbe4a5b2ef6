// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oikos::daemon {

/// Counters of what was asked, by route. Thread-safe, without a lock.
class RequestMetrics {
 public:
  /// Requests that fit no route are counted under "other".
  explicit RequestMetrics(std::vector<std::string> routes);

  /// `route` is an index into the routes, or their number.
  void count(std::size_t route, int status, std::chrono::nanoseconds took);
  /// In Prometheus' text format.
  [[nodiscard]] std::string text() const;

 private:
  static constexpr std::size_t kStatusClasses = 6;  ///< 0 (broken off), 1xx, … 5xx
  static constexpr std::array<double, 12> kBounds_s{1e-4, 2.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 2.5e-2, 1e-1, 0.25, 1.0, 10.0};
  struct Route {
    std::string name;
    std::array<std::atomic<std::int64_t>, kStatusClasses> requests{};
  };

  std::vector<Route> routes_;
  std::array<std::atomic<std::int64_t>, kBounds_s.size() + 1> took_{};
  std::atomic<std::int64_t> took_ns_ = 0;
};

/// One number with its help line, as Prometheus reads it; `type` is "gauge" or "counter".
[[nodiscard]] std::string metricText(std::string_view name, std::string_view type, std::string_view help, std::int64_t value);

}  // namespace oikos::daemon
