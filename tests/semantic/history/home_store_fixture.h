// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/read_file.h"
#include "semantic/history/home_state.h"
#include "semantic/history/home_store.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {

inline const std::filesystem::path kPapers = std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml";

inline Event hinge(double degrees, std::int64_t time_ns, const std::string& subject = "fridge-hinge") {
  Event event;
  event.kind = EventKind::kJoint;
  event.subject = subject;
  event.time_ns = time_ns;
  event.after = JointValue{JointType::kRevolute, degrees * kRadPerDeg};
  return event;
}

inline Event moved(const std::string& subject, const State& pose, std::int64_t time_ns) {
  Event event;
  event.kind = EventKind::kMoved;
  event.subject = subject;
  event.time_ns = time_ns;
  event.after = pose;
  return event;
}

inline Event sighting(const std::string& parent, std::int64_t time_ns) {
  Event event;
  event.kind = EventKind::kSighted;
  event.subject = "blue-cup";
  event.time_ns = time_ns;
  event.after = Placement{parent, Relation::kOn, {.position_m = {0.1, 0.1, 0.1}}};
  event.confidence = 0.5;
  return event;
}

inline bool sameButForAsOf(Home a, const Home& b) {
  a.as_of = b.as_of;
  return a == b;
}

/// A copy of the papers' house in a folder of its own.
class HomeStoreTest : public testing::Test {
 protected:
  HomeStoreTest() { (void)folder_.write("home.xml", base::readFile(kPapers)); }

  void open() {
    store_.reset();
    store_ = std::make_unique<HomeStore>(folder_.path(), [this] { return now_ns_; });
  }
  [[nodiscard]] Home home() const { return store_->snapshot()->home; }
  [[nodiscard]] Home onDisk() const { return readHome(file_).home; }
  [[nodiscard]] std::string text() const { return base::readFile(file_); }
  [[nodiscard]] double openingDeg() const {
    return std::get<JointValue>(HomeState(home()).findState("fridge-hinge").value()).value / kRadPerDeg;
  }
  void replaceInFile(const std::string& from, const std::string& to) {
    std::string content = text();
    const std::size_t at = content.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    (void)folder_.write("home.xml", content.replace(at, from.size(), to));
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "home.xml";
  std::int64_t now_ns_ = 1'000'000;
  std::unique_ptr<HomeStore> store_;
};

}  // namespace oikos::semantic
