// SPDX-License-Identifier: Apache-2.0
// HTTP/1.1 for the daemon. A few threads wait for all connections at once, so that a connection that sends or takes nothing costs a socket
// and no thread; whatever may wait for the disk runs on a pool of workers.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "core/base/posix_file.h"
#include "tools/daemon/connection_watch.h"
#include "tools/daemon/event_streams.h"
#include "tools/daemon/http_message.h"

namespace oikos::daemon {

/// What becomes of a request, decided as soon as its headers are there.
struct Admission {
  std::optional<Response> refusal;  ///< sent without reading the body
  bool may_wait = false;            ///< for the disk: a worker answers
};

/// How a request ended, for the log and the counters.
struct Exchange {
  const Request& request;
  int status = 0;  ///< 0: the connection broke before there was an answer
  std::size_t bytes = 0;
  std::chrono::nanoseconds took{0};
};

/// The server's other side. Called from many threads at a time; nothing here throws.
class RequestHandler {
 public:
  RequestHandler() = default;
  RequestHandler(const RequestHandler&) = delete;
  RequestHandler& operator=(const RequestHandler&) = delete;
  virtual ~RequestHandler() = default;

  [[nodiscard]] virtual Admission admit(const Request& request) = 0;
  [[nodiscard]] virtual Response respond(const Request& request) = 0;
  /// The next events for a stream.
  [[nodiscard]] virtual EventBatch eventsAfter(std::int64_t number) = 0;
  virtual void finished(const Exchange& exchange) = 0;
};

struct HttpServerConfig {
  ConnectionLimits connections;
  std::size_t event_streams = 16;
  std::size_t body_bytes = 1 << 20;
  std::size_t header_bytes = 16 << 10;
  std::size_t target_bytes = 4 << 10;
  int workers = 64;
  int event_threads = 4;
  std::chrono::milliseconds tick{100};    ///< how exactly limits of time are kept
  std::chrono::milliseconds grace{1000};  ///< that requests under way have when the server stops
};

class HttpServer {
 public:
  /// Serves what comes in at a listening socket. The handler must outlive the server. Throws Error{kIo}.
  HttpServer(base::FileDescriptor listening, RequestHandler& handler, const HttpServerConfig& config);
  ~HttpServer();  ///< stops
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Tells the streams that there are events. Thread-safe.
  void wakeStreams();
  /// Takes no more connections, gives requests under way their grace, then closes everything. Not thread-safe.
  void stop();

  [[nodiscard]] std::size_t connections() const;  ///< thread-safe
  [[nodiscard]] std::size_t streams() const;      ///< thread-safe

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace oikos::daemon
