// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/service.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <filesystem>
#include <latch>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/read_file.h"
#include "semantic/model/pose.h"
#include "semantic/xml/home_reader.h"
#include "tests/tools/daemon/served_home.h"

namespace oikos::daemon {
namespace {

using namespace std::chrono_literals;

semantic::Event hingeAt(double value_deg, std::int64_t time_ns) {
  semantic::Event event;
  event.time_ns = time_ns;
  event.subject = "fridge-hinge";
  event.kind = semantic::EventKind::kJoint;
  event.after = semantic::JointValue{semantic::JointType::kRevolute, value_deg * semantic::kRadPerDeg};
  return event;
}

double hingeOf(const semantic::Home& home) {
  return home.rooms.at(0).objects.at(2)->articulation->joints.at(0).value / semantic::kRadPerDeg;
}

/// Counts calls and lets one wait for them.
class Counter {
 public:
  void add() {
    const std::lock_guard lock(mutex_);
    ++count_;
    changed_.notify_all();
  }
  void waitFor(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return count_ >= count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_ = 0;
};

TEST(Service, AViewHasWhatWasAppendedBefore) {
  const ServedHome home;
  for (int i = 1; i <= 50; ++i) {
    const std::int64_t number = home.service->append({hingeAt(i, ServedHome::kNow_ns + i)});
    const std::shared_ptr<const HomeView> view = home.service->view();
    ASSERT_GE(view->snapshot->home.as_of, number);
    ASSERT_NEAR(hingeOf(view->snapshot->home), i, 1e-9);
    ASSERT_EQ(&view->index.home(), &view->snapshot->home);
  }
}

TEST(Service, TellsItsListenerOfEvents) {
  const ServedHome home;
  Counter told;
  home.service->onEvents([&] { told.add(); });
  (void)home.service->append({hingeAt(10, ServedHome::kNow_ns)});
  told.waitFor(1);
  (void)home.service->append({hingeAt(20, ServedHome::kNow_ns + 1)});
  told.waitFor(2);
}

TEST(Service, SeesWhatAnotherProcessCommits) {
  const ServedHome home;
  Counter told;
  home.service->onEvents([&] { told.add(); });
  semantic::History other(home.folder.path() / "history.sqlite", semantic::HistoryAccess::kAppend);
  const std::int64_t number = other.append(std::vector{hingeAt(30, ServedHome::kNow_ns)});
  told.waitFor(1);
  EXPECT_EQ(home.service->view()->snapshot->home.as_of, number);
  EXPECT_NEAR(hingeOf(home.service->view()->snapshot->home), 30.0, 1e-9);
}

TEST(Service, WritesHomeXmlWhenItCloses) {
  const ServedHome home;
  const std::int64_t number = home.service->append({hingeAt(45, ServedHome::kNow_ns)});
  home.service->close();
  const semantic::HomeReading reading = semantic::readHome(home.folder.path() / "home.xml");
  EXPECT_TRUE(reading.complete && reading.findings.empty());
  EXPECT_NEAR(hingeOf(reading.home), 45.0, 1e-9);
  EXPECT_EQ(reading.home.as_of, number);
}

TEST(Service, RefusesAnInvalidEditAndTakesAValidOne) {
  ServedHome home;
  const std::string original = base::readFile(home.folder.path() / "home.xml");
  const auto edit = [&](const std::string& what, const std::string& by) {
    std::string text = original;
    (void)home.folder.write("home.xml", text.replace(text.find(what), what.size(), by));
  };
  edit("current=\"3\"", "current=\"9\"");
  EXPECT_FALSE(home.service->reload());
  EXPECT_NE(home.last_report.find("one of off, 1, 2, 3, 4"), std::string::npos) << home.last_report;
  EXPECT_EQ(home.getJson("/v1/objects/fridge-thermostat")["setting"], "3");
  edit("current=\"3\"", "current=\"4\"");
  EXPECT_TRUE(home.service->reload());
  EXPECT_EQ(home.getJson("/v1/objects/fridge-thermostat")["setting"], "4");
  EXPECT_EQ(home.getJson("/v1/objects/fridge-thermostat/history")["events"][0]["kind"], "edited");
}

/// For the thread sanitizer: everything that may happen at once does.
TEST(Service, ReadersWritersCheckpointsAndEditsAtOnce) {
  const test::TemporaryFolder folder;
  std::filesystem::copy(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml", folder.path() / "home.xml");
  ServiceConfig config;
  config.refresh = 1ms;
  config.checkpoint = 1ms;
  Service service(folder.path(), {[] { return ServedHome::kNow_ns; }, [](const std::string&) {}}, config);
  Counter told;
  service.onEvents([&] { told.add(); });
  Api api(service, {"127.0.0.1", "the-token", false}, nullptr);
  constexpr int kRounds = 60;
  std::atomic<std::int64_t> last = 0;
  std::vector<std::thread> threads;
  for (int writer = 0; writer < 2; ++writer) {
    threads.emplace_back([&, writer] {
      for (int i = 0; i < kRounds; ++i) {
        last = std::max<std::int64_t>(last, service.append({hingeAt(i, ServedHome::kNow_ns + 2 * i + writer)}));
      }
    });
  }
  for (const char* const target : {"/v1/ask?q=is+the+fridge+open", "/v1/objects", "/v1/state?at=2024-05-17T12:00:00Z", "/metrics"}) {
    threads.emplace_back([&, target] {
      for (int i = 0; i < kRounds; ++i) {
        EXPECT_EQ(api.handle({"GET", target, "localhost", "", "", "", ""}).status, 200);
      }
    });
  }
  threads.emplace_back([&] {
    for (int i = 0; i < kRounds / 10; ++i) {
      EXPECT_TRUE(service.reload());
    }
  });
  for (std::thread& thread : threads) {
    thread.join();
  }
  told.waitFor(1);
  EXPECT_GE(service.view()->snapshot->home.as_of, last);
  service.close();
  EXPECT_TRUE(semantic::readHome(folder.path() / "home.xml").findings.empty());
}

}  // namespace
}  // namespace oikos::daemon
