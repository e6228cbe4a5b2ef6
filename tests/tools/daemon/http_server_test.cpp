// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/http_server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tests/support/http_client.h"
#include "tools/daemon/listen_address.h"

namespace oikos::daemon {
namespace {

using namespace std::chrono_literals;
using test::getRequest;
using test::HttpAnswer;
using test::HttpConnection;
using test::postRequest;

/// Answers with the target, `/long` with four megabytes, `/events` with a stream, `/wait` from a worker once it is let go on.
class Echo : public RequestHandler {
 public:
  Admission admit(const Request& request) override {
    if (request.target == "/forbidden") {
      return {failure(403, "forbidden", "not this one"), false};
    }
    return {std::nullopt, request.target == "/wait" || request.method == "POST"};
  }
  Response respond(const Request& request) override {
    if (request.target == "/wait") {
      std::unique_lock lock(mutex_);
      ++waiting_;
      changed_.notify_all();
      changed_.wait(lock, [this] { return let_go_; });
    }
    Response response{200, "text/plain", request.target + "|" + request.body, {}, {}};
    if (request.target == "/long") {
      response.body.assign(4 << 20, 'x');
    } else if (request.target == "/events") {
      response = {200, "text/event-stream", "", {}, request.last_event_id.empty() ? 0 : std::stoll(request.last_event_id)};
    }
    return response;
  }
  EventBatch eventsAfter(std::int64_t number) override {
    const std::lock_guard lock(mutex_);
    EventBatch batch{"", number};
    while (batch.last < last_event_) {
      batch.text += "id: " + std::to_string(++batch.last) + "\ndata: {}\n\n";
    }
    return batch;
  }
  void finished(const Exchange& exchange) override {
    const std::lock_guard lock(mutex_);
    statuses_.push_back(exchange.status);
    changed_.notify_all();
  }

  void waitForWaiting(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ >= count; });
  }
  void waitForFinished(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return statuses_.size() >= count; });
  }
  void letGo() {
    const std::lock_guard lock(mutex_);
    let_go_ = true;
    changed_.notify_all();
  }
  void setLastEvent(std::int64_t number) {
    const std::lock_guard lock(mutex_);
    last_event_ = number;
  }
  std::vector<int> statuses() {
    const std::lock_guard lock(mutex_);
    return statuses_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool let_go_ = false;
  int waiting_ = 0;
  std::int64_t last_event_ = 0;
  std::vector<int> statuses_;
};

struct Running {
  explicit Running(const HttpServerConfig& config = {}) : server(listenAt(address), echo, config) {}
  ~Running() { echo.letGo(); }
  ListenAddress address{"127.0.0.1", 0};
  Echo echo;
  HttpServer server;
};

HttpServerConfig shortDeadlines() {
  HttpServerConfig config;
  config.connections.waiting = 300ms;
  config.connections.request = 300ms;
  config.connections.stalled = 300ms;
  config.tick = 10ms;
  return config;
}

TEST(HttpServer, AnswersManyRequestsOnOneConnection) {
  Running running;
  HttpConnection connection(running.address.port);
  for (int i = 0; i < 100; ++i) {
    const HttpAnswer answer = connection.ask(getRequest("/a?b=" + std::to_string(i)));
    ASSERT_EQ(answer.status, 200);
    ASSERT_EQ(answer.body, "/a?b=" + std::to_string(i) + "|");
    ASSERT_EQ(answer.headers.at("x-content-type-options"), "nosniff");
    ASSERT_EQ(answer.headers.count("access-control-allow-origin"), 0U);
  }
  for (int i = 0; i < 100; ++i) {
    const HttpAnswer answer = connection.ask(postRequest("/p", "body " + std::to_string(i)));
    ASSERT_EQ(answer.body, "/p|body " + std::to_string(i));
  }
  EXPECT_EQ(connection.ask(getRequest("/long")).body.size(), 4U << 20);
}

TEST(HttpServer, RefusesInJsonWhatIsTooLargeOrNotAdmitted) {
  Running running;
  const int port = running.address.port;
  EXPECT_EQ(test::httpGet(port, "/forbidden").body, R"({"code":"forbidden","message":"not this one"})");
  const HttpAnswer target = test::httpGet(port, "/" + std::string(5000, 'a'));
  EXPECT_EQ(target.status, 414);
  EXPECT_NE(target.body.find("\"code\":\"target_too_long\""), std::string::npos) << target.body;
  const HttpAnswer headers = test::httpGet(port, "/", "X: " + std::string(20000, 'a') + "\r\n");
  EXPECT_EQ(headers.status, 431);
  EXPECT_NE(headers.body.find("\"code\":\"headers_too_large\""), std::string::npos) << headers.body;
  HttpConnection announcing(port);
  const HttpAnswer announced = announcing.ask("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1048577\r\n\r\n");
  EXPECT_EQ(announced.status, 413);
  EXPECT_NE(announced.body.find("\"code\":\"too_large\""), std::string::npos) << announced.body;
  HttpConnection chunked(port);
  std::string request = "POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (int i = 0; i < 17; ++i) {
    request += "10000\r\n" + std::string(0x10000, 'b') + "\r\n";
  }
  EXPECT_EQ(chunked.ask(request + "0\r\n\r\n").status, 413);
  HttpConnection full(port);
  EXPECT_EQ(full.ask(postRequest("/", std::string(1 << 20, 'b'))).body.size(), (1U << 20) + 2);
}

TEST(HttpServer, ClosesConnectionsThatSendNothingOrDrip) {
  Running running(shortDeadlines());
  HttpConnection silent(running.address.port);
  HttpConnection half(running.address.port);
  half.send("GET / HTT");
  HttpConnection headers(running.address.port);
  headers.send("GET / HTTP/1.1\r\nHost: localhost\r\nX-Drip: ");
  HttpConnection body(running.address.port);
  body.send("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\nx");
  while (!headers.isClosedWithin(5ms)) {  // each byte would be progress enough for a limit of the time between two bytes
    headers.send("x");
    body.send("x");
  }
  EXPECT_TRUE(silent.isClosedByServer());
  EXPECT_TRUE(half.isClosedByServer());
  EXPECT_TRUE(headers.isClosedByServer());
  EXPECT_TRUE(body.isClosedByServer());
  running.echo.waitForFinished(2);
  EXPECT_EQ(running.echo.statuses(), (std::vector<int>{0, 0}));
}

TEST(HttpServer, ClosesConnectionsThatDoNotReadTheirAnswer) {
  Running running(shortDeadlines());
  HttpConnection reader(running.address.port, 4096);
  reader.send(getRequest("/long"));
  running.echo.waitForFinished(1);
  EXPECT_LT(reader.receive().body.size(), 4U << 20);
}

TEST(HttpServer, AnswersWhileHundredsOfConnectionsHoldOn) {
  HttpServerConfig config;
  config.connections.connections = 200;
  Running running(config);
  std::list<HttpConnection> dripping;
  for (int i = 0; i < 300; ++i) {
    HttpConnection& connection = dripping.emplace_back(running.address.port, 4096);
    const std::string target = i % 3 == 0 ? "/long" : "/";
    connection.send(i % 3 == 1 ? "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100\r\n\r\nx"
                               : getRequest(target).substr(0, i % 3 == 0 ? 999 : 20));
    if (i % 50 == 49) {
      EXPECT_EQ(test::httpGet(running.address.port, "/still").body, "/still|");
    }
  }
  EXPECT_LE(running.server.connections(), 200U);
}

TEST(HttpServer, WorkersThatWaitHoldNobodyUp) {
  HttpServerConfig config;
  config.workers = 8;
  Running running(config);
  std::list<HttpConnection> waiting;
  for (int i = 0; i < 20; ++i) {
    waiting.emplace_back(running.address.port).send(getRequest("/wait"));
  }
  running.echo.waitForWaiting(8);
  EXPECT_EQ(test::httpGet(running.address.port, "/a").body, "/a|");
  running.echo.letGo();
  for (HttpConnection& connection : waiting) {
    EXPECT_EQ(connection.receive().body, "/wait|");
  }
}

TEST(HttpServer, SendsEventsAsTheyComeAndResumes) {
  Running running;
  HttpConnection stream(running.address.port);
  stream.send(getRequest("/events"));
  EXPECT_NE(stream.receiveUntil("retry: 1000\n\n").find("text/event-stream"), std::string::npos);
  running.echo.setLastEvent(2);
  running.server.wakeStreams();
  EXPECT_NE(stream.receiveUntil("id: 2\ndata: {}\n\n").find("id: 1\n"), std::string::npos);
  HttpConnection later(running.address.port);
  later.send(getRequest("/events", "Last-Event-ID: 1\r\n"));
  const std::string resumed = later.receiveUntil("id: 2\ndata: {}\n\n");
  EXPECT_EQ(resumed.find("id: 1\n"), std::string::npos);
  for (int number = 3; number < 500; ++number) {
    running.echo.setLastEvent(number);
    running.server.wakeStreams();
  }
  EXPECT_NE(stream.receiveUntil("id: 499\ndata: {}\n\n").find("id: 250\n"), std::string::npos);
}

TEST(HttpServer, RefusesTheSeventeenthStreamUntilOneIsGone) {
  HttpServerConfig config;
  config.tick = 10ms;
  Running running(config);
  std::list<HttpConnection> streams;
  for (int i = 0; i < 16; ++i) {
    streams.emplace_back(running.address.port).send(getRequest("/events"));
    streams.back().receiveUntil("retry: 1000\n\n");
  }
  const HttpAnswer refused = test::httpGet(running.address.port, "/events");
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.body.find("too_many_streams"), std::string::npos) << refused.body;
  EXPECT_EQ(running.server.streams(), 16U);
  streams.pop_front();
  running.echo.waitForFinished(2);
  HttpConnection next(running.address.port);
  next.send(getRequest("/events"));
  EXPECT_NE(next.receiveUntil("retry: 1000\n\n").find("200"), std::string::npos);
}

TEST(HttpServer, AStreamThatTakesNothingEnds) {
  Running running(shortDeadlines());
  running.echo.setLastEvent(1'000'000);
  HttpConnection stream(running.address.port, 4096);
  stream.send(getRequest("/events"));
  running.echo.waitForFinished(1);
  EXPECT_EQ(running.server.streams(), 0U);
}

TEST(HttpServer, StopsWithinItsGraceWhateverClientsDo) {
  HttpServerConfig config;
  config.grace = 200ms;
  Running running(config);
  HttpConnection stream(running.address.port);
  stream.send(getRequest("/events"));
  stream.receiveUntil("retry: 1000\n\n");
  HttpConnection dripping(running.address.port);
  dripping.send("GET / HTTP/1.1\r\nX: ");
  HttpConnection under_way(running.address.port);
  under_way.send(getRequest("/wait"));
  running.echo.waitForWaiting(1);
  running.echo.letGo();
  running.server.stop();
  EXPECT_EQ(under_way.receive().body, "/wait|");
  EXPECT_NE(stream.receiveUntil("0\r\n\r\n"), "");
  EXPECT_TRUE(stream.isClosedByServer());
  EXPECT_TRUE(dripping.isClosedByServer());
  EXPECT_THROW(HttpConnection(running.address.port), std::system_error);
}

}  // namespace
}  // namespace oikos::daemon
