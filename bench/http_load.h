// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace oikos::bench {

struct Load {
  int port = 0;
  int clients = 8;       ///< connections that are kept
  double rate_hz = 0.0;  ///< requests of all clients together; 0: each asks as soon as it has its answer
  std::chrono::seconds time{3};
  std::function<std::string(int number)> request;  ///< the whole text of the nth
};

struct LoadResult {
  double rate_hz = 0.0;  ///< answers
  double p50_ms = 0.0;   ///< from when the request was due
  double p99_ms = 0.0;
  std::size_t failures = 0;  ///< answers that are no 200
};

/// All clients on one thread, so that they leave the cores to the server.
[[nodiscard]] LoadResult run(const Load& load);

}  // namespace oikos::bench
