// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "core/base/read_file.h"
#include "semantic/history/history.h"
#include "semantic/xml/home_reader.h"
#include "tests/integration/daemon_process.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/http_client.h"

namespace oikos::test {
namespace {

using Json = nlohmann::json;

std::string hingeAt(double value_deg) {
  return R"({"subject": "fridge-hinge", "kind": "joint", "after": {"value_deg": )" + std::to_string(value_deg) + "}}";
}

std::string authorized(const DaemonProcess& daemon) {
  return "Authorization: Bearer " + daemon.token() + "\r\n";
}

double hingeOf_deg(const semantic::Home& home) {
  return home.rooms.at(0).objects.at(2)->articulation->joints.at(0).value / semantic::kRadPerDeg;
}

/// Clients that store observations one after another until the daemon is gone, and remember which numbers they were told.
class Writers {
 public:
  Writers(const DaemonProcess& daemon, int count) {
    const std::string headers = authorized(daemon);
    for (int i = 0; i < count; ++i) {
      auto connection = std::make_shared<HttpConnection>(daemon.port());  // here: a thread may begin after the daemon's end
      threads_.emplace_back([this, headers, connection, i] { write(*connection, headers, i); });
    }
  }
  ~Writers() { join(); }
  Writers(const Writers&) = delete;
  Writers& operator=(const Writers&) = delete;

  void waitForAcknowledged(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return acknowledged_.size() >= count || ended_ == threads_.size(); });
  }
  /// The value that was stored under each number.
  std::map<std::int64_t, double> join() {
    for (std::thread& thread : threads_) {
      if (thread.joinable()) {
        thread.join();
      }
    }
    return acknowledged_;
  }

 private:
  void write(HttpConnection& connection, const std::string& headers, int writer) {
    for (int i = 0;; ++i) {
      const double value_deg = (i % 100) + 0.125 * writer;
      const HttpAnswer answer = connection.ask(postRequest("/v1/observations", hingeAt(value_deg), headers));
      const std::lock_guard lock(mutex_);
      if (answer.status != 200) {
        ++ended_;
        changed_.notify_all();
        return;
      }
      acknowledged_[Json::parse(answer.body)["numbers"][0]] = value_deg;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::int64_t, double> acknowledged_;
  std::size_t ended_ = 0;
  std::vector<std::thread> threads_;
};

void expectStored(const std::filesystem::path& home, const std::map<std::int64_t, double>& acknowledged) {
  const semantic::History history(home / "history.sqlite", semantic::HistoryAccess::kRead);
  std::map<std::int64_t, double> found;
  for (const semantic::Event& event : history.eventsAfter(acknowledged.begin()->first - 1, 1'000'000)) {
    found[event.number] = std::get<semantic::JointValue>(event.after.value()).value / semantic::kRadPerDeg;
  }
  for (const auto& [number, value_deg] : acknowledged) {
    ASSERT_EQ(found.count(number), 1U) << number;
    ASSERT_NEAR(found[number], value_deg, 1e-6) << number;
  }
}

void expectValidHome(const std::filesystem::path& home) {
  const semantic::HomeReading reading = semantic::readHome(home / "home.xml");
  EXPECT_TRUE(reading.complete);
  EXPECT_TRUE(reading.findings.empty());
}

TEST(Serve, AnswersAndKeepsWhatIsObserved) {
  const PapersCopy home;
  DaemonProcess daemon(home.path());
  HttpConnection connection(daemon.port());
  EXPECT_EQ(Json::parse(connection.ask(getRequest("/v1/ask?q=where+is+the+blue+cup")).body)["sentence"],
            "The blue cup is on the kitchen table in the kitchen.");
  EXPECT_EQ(connection.ask(getRequest("/healthz")).status, 200);
  EXPECT_EQ(connection.ask(getRequest("/readyz")).status, 200);
  const HttpAnswer metrics = connection.ask(getRequest("/metrics"));
  EXPECT_NE(metrics.body.find("\noikos_http_connections 1\n"), std::string::npos) << metrics.body;
  EXPECT_EQ(connection.ask(postRequest("/v1/observations", hingeAt(45), authorized(daemon))).status, 200);
  EXPECT_EQ(Json::parse(connection.ask(getRequest("/v1/objects/fridge")).body)["joints"][0]["value_deg"], 45.0);
  daemon.process().send(SIGTERM);
  const ProcessResult result = daemon.process().finish();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 6) << result.err;  // a line a request
  EXPECT_NE(result.err.find(" 127.0.0.1 \"GET /v1/ask?q=where+is+the+blue+cup\" 200 "), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find(daemon.token()), std::string::npos);
  EXPECT_NEAR(hingeOf_deg(semantic::readHome(home.path() / "home.xml").home), 45.0, 1e-6);
}

TEST(Serve, RefusesWhoMayNot) {
  const PapersCopy home;
  DaemonProcess daemon(home.path());
  const int port = daemon.port();
  EXPECT_EQ(HttpConnection(port).ask("GET /v1/home HTTP/1.1\r\nHost: evil.example\r\n\r\n").status, 403);
  EXPECT_EQ(HttpConnection(port).ask("GET /v1/home HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n").status, 200);
  EXPECT_EQ(HttpConnection(port).ask(postRequest("/v1/observations", hingeAt(45))).status, 401);
  EXPECT_EQ(HttpConnection(port).ask(postRequest("/v1/observations", hingeAt(45), "Authorization: Bearer x\r\n")).status, 401);
  EXPECT_EQ(HttpConnection(port).ask(postRequest("/v1/observations", "[1", authorized(daemon))).status, 400);
  EXPECT_EQ(HttpConnection(port)
                .ask("POST /v1/observations HTTP/1.1\r\nHost: localhost\r\n" + authorized(daemon) + "Content-Length: 9999999\r\n\r\n")
                .status,
            413);
  EXPECT_EQ(httpGet(port, "/" + std::string(5000, 'a')).status, 414);
  EXPECT_EQ(httpGet(port, "/", "X: " + std::string(20000, 'a') + "\r\n").status, 431);
  EXPECT_EQ(std::filesystem::status(home.path() / ".token").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(Serve, SaysWhyItCannotStart) {
  const PapersCopy home;
  DaemonProcess daemon(home.path());
  const ProcessResult second = runOikos({"serve", home.path().string(), "--listen", "127.0.0.1:0"});
  EXPECT_EQ(second.exit_code, 4);
  EXPECT_NE(second.err.find(home.path().string()), std::string::npos) << second.err;
  const PapersCopy other;
  const std::string taken = "127.0.0.1:" + std::to_string(daemon.port());
  const ProcessResult bound = runOikos({"serve", other.path().string(), "--listen", taken});
  EXPECT_EQ(bound.exit_code, 4);
  EXPECT_NE(bound.err.find(taken + ": cannot listen"), std::string::npos) << bound.err;
  const ProcessResult open = runOikos({"serve", other.path().string(), "--listen", "0.0.0.0:0"});
  EXPECT_EQ(open.exit_code, 2);
  EXPECT_NE(open.err.find("--token-file"), std::string::npos) << open.err;
  std::filesystem::permissions(home.path() / ".token", std::filesystem::perms::others_read, std::filesystem::perm_options::add);
  daemon.process().send(SIGTERM);
  EXPECT_EQ(daemon.process().finish().exit_code, 0);
  const ProcessResult readable = runOikos({"serve", home.path().string(), "--listen", "127.0.0.1:0"});
  EXPECT_EQ(readable.exit_code, 3);
  EXPECT_NE(readable.err.find("chmod 600"), std::string::npos) << readable.err;
  other.edit("current=\"3\"", "current=\"9\"");
  EXPECT_EQ(runOikos({"serve", other.path().string(), "--listen", "127.0.0.1:0"}).exit_code, 3);
}

TEST(Serve, KilledAHundredTimesItHasEveryAcknowledgedEvent) {
  constexpr int kKills = 100;
  const PapersCopy home;
  std::size_t acknowledged = 0;
  for (int i = 0; i < kKills; ++i) {
    DaemonProcess daemon(home.path(), {"--access-log", "/dev/null", "--checkpoint", "0.01"});
    Writers writers(daemon, 4);
    writers.waitForAcknowledged(static_cast<std::size_t>(5 + i % 20));
    daemon.process().send(SIGKILL);
    daemon.process().finish();
    const auto stored = writers.join();
    ASSERT_FALSE(stored.empty());
    acknowledged += stored.size();
    expectStored(home.path(), stored);
    expectValidHome(home.path());
    if (testing::Test::HasFatalFailure()) {
      return;
    }
  }
  EXPECT_GE(acknowledged, 500U);
}

TEST(Serve, EndsInTwoSecondsUnderLoadAndWritesHomeXml) {
  const PapersCopy home;
  DaemonProcess daemon(home.path(), {"--access-log", "/dev/null"});
  Writers writers(daemon, 8);
  HttpConnection stream(daemon.port());
  stream.send(getRequest("/v1/events"));
  HttpConnection dripping(daemon.port());
  dripping.send("GET / HTTP/1.1\r\nX: ");
  writers.waitForAcknowledged(200);
  daemon.process().send(SIGTERM);
  EXPECT_TRUE(daemon.process().hasEndedWithin(std::chrono::seconds(2)));
  const ProcessResult ended = daemon.process().finish();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  expectStored(home.path(), writers.join());
  const semantic::HomeReading reading = semantic::readHome(home.path() / "home.xml");
  EXPECT_TRUE(reading.complete && reading.findings.empty());
  EXPECT_EQ(reading.home.as_of, semantic::History(home.path() / "history.sqlite", semantic::HistoryAccess::kRead).lastNumber());
}

TEST(Serve, TakesAValidEditOnHangUpAndRefusesAnInvalidOne) {
  const PapersCopy home;
  const std::filesystem::path log = home.path() / "access.log";
  DaemonProcess daemon(home.path(), {"--access-log", log.string()});
  HttpConnection stream(daemon.port());
  stream.send(getRequest("/v1/events"));
  stream.receiveUntil("retry: 1000\n\n");
  home.edit("current=\"3\"", "current=\"4\"");
  daemon.process().send(SIGHUP);
  const std::string event = stream.receiveUntil("}\n\n");
  EXPECT_NE(event.find("\"edited\""), std::string::npos) << event;
  EXPECT_EQ(Json::parse(httpGet(daemon.port(), "/v1/objects/fridge-thermostat").body)["setting"], "4");
  home.edit("current=\"4\"", "current=\"9\"");
  daemon.process().send(SIGHUP);
  daemon.process().send(SIGTERM);  // handled after the hang-up: both wait, and a hang-up has the lower number
  const ProcessResult result = daemon.process().finish();
  EXPECT_NE(result.err.find("home.xml was not taken"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("fridge-thermostat"), std::string::npos) << result.err;
}

TEST(Serve, SeesWhatAnotherProcessCommits) {
  const PapersCopy home;
  DaemonProcess daemon(home.path(), {"--access-log", "/dev/null"});
  HttpConnection stream(daemon.port());
  stream.send(getRequest("/v1/events"));
  stream.receiveUntil("retry: 1000\n\n");
  semantic::Event event;
  event.subject = "fridge-hinge";
  event.time_ns = 1;
  event.recording = "evening";
  event.kind = semantic::EventKind::kJoint;
  event.after = semantic::JointValue{semantic::JointType::kRevolute, 0.5};
  semantic::History(home.path() / "history.sqlite", semantic::HistoryAccess::kAppend).append(std::vector{event});
  EXPECT_NE(stream.receiveUntil("}\n\n").find("\"evening\""), std::string::npos);
}

TEST(Serve, AnswersWhileTwoHundredClientsDrip) {
  const PapersCopy home;
  DaemonProcess daemon(home.path(), {"--access-log", "/dev/null"});
  std::string many;
  for (int i = 0; i < 200; ++i) {
    many += getRequest("/v1/objects");
  }
  std::list<HttpConnection> clients;
  for (int i = 0; i < 200; ++i) {
    HttpConnection& client = clients.emplace_back(daemon.port(), 4096);
    client.send(i % 3 == 0 ? "GET / HTTP/1.1\r\nHost: localhost\r\nX-Drip: "
                : i % 3 == 1
                    ? "POST /v1/observations HTTP/1.1\r\nHost: localhost\r\n" + authorized(daemon) + "Content-Length: 1000\r\n\r\n["
                    : many.substr(0, 8000));
  }
  for (int round = 0; round < 5; ++round) {
    for (HttpConnection& client : clients) {
      client.send("x");
    }
    EXPECT_EQ(httpGet(daemon.port(), "/healthz").status, 200);
    EXPECT_EQ(httpGet(daemon.port(), "/v1/ask?q=where+is+the+blue+cup").status, 200);
  }
}

TEST(Serve, RefusesTheSeventeenthEventStream) {
  const PapersCopy home;
  DaemonProcess daemon(home.path(), {"--access-log", "/dev/null"});
  std::list<HttpConnection> streams;
  for (int i = 0; i < 16; ++i) {
    streams.emplace_back(daemon.port()).send(getRequest("/v1/events"));
    EXPECT_NE(streams.back().receiveUntil("retry: 1000\n\n").find(" 200 "), std::string::npos);
  }
  EXPECT_EQ(httpGet(daemon.port(), "/v1/events").status, 503);
  const std::string post = postRequest("/v1/observations", hingeAt(45), authorized(daemon));
  EXPECT_EQ(HttpConnection(daemon.port()).ask(post).status, 200);
  for (HttpConnection& stream : streams) {
    EXPECT_NE(stream.receiveUntil("}\n\n").find("\"fridge-hinge\""), std::string::npos);
  }
}

TEST(Serve, AFullDiskRefusesEventsAndGoesOnReading) {
  const PapersCopy home;
  std::map<std::int64_t, double> acknowledged;
  {
    std::unique_ptr<DaemonProcess> daemon;
    {
      const FileSizeLimit full(300'000);
      daemon = std::make_unique<DaemonProcess>(home.path(), std::vector<std::string>{"--access-log", "/dev/null"});
    }
    HttpConnection connection(daemon->port());
    HttpAnswer answer{200, {}, {}};
    for (int i = 0; answer.status == 200 && i < 100'000; ++i) {
      answer = connection.ask(postRequest("/v1/observations", hingeAt(i % 100), authorized(*daemon)));
      if (answer.status == 200) {
        acknowledged[Json::parse(answer.body)["numbers"][0]] = i % 100;
      }
    }
    EXPECT_EQ(answer.status, 507) << answer.body;
    EXPECT_EQ(Json::parse(answer.body)["code"], "not_stored");
    EXPECT_EQ(connection.ask(getRequest("/v1/ask?q=where+is+the+blue+cup")).status, 200);
    EXPECT_EQ(Json::parse(connection.ask(getRequest("/v1/objects/fridge")).body)["joints"][0]["value_deg"], acknowledged.rbegin()->second);
    EXPECT_EQ(connection.ask(getRequest("/v1/changes?since=2024-01-01T00:00:00Z")).status, 200);
  }
  ASSERT_FALSE(acknowledged.empty());
  expectStored(home.path(), acknowledged);
  DaemonProcess again(home.path(), {"--access-log", "/dev/null"});
  EXPECT_EQ(HttpConnection(again.port()).ask(postRequest("/v1/observations", hingeAt(45), authorized(again))).status, 200);
}

}  // namespace
}  // namespace oikos::test
