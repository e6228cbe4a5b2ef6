// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/recollection.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

constexpr std::int64_t kHour_ns = 3'600'000'000'000;
constexpr std::int64_t kEver = std::numeric_limits<std::int64_t>::max();

Event placed(EventKind kind, const std::string& parent, std::int64_t time_ns, double confidence = 0.9) {
  Event event;
  event.kind = kind;
  event.subject = "cup";
  event.time_ns = time_ns;
  event.confidence = confidence;
  event.after = Placement{parent, Relation::kOn, {}};
  return event;
}

BeliefPrior prior() {
  return {{{"table", Relation::kOn, {}}, {"shelf", Relation::kOn, {}}}, 24.0 * 3600.0};
}

class RecollectionTest : public testing::Test {
 protected:
  void happens(Event event) {
    event.number = history_.append(std::vector{event});
    recollection_.take(event);
  }
  [[nodiscard]] std::shared_ptr<const Recalled> recall() { return recollection_.recall("cup", prior); }
  [[nodiscard]] Recalled readAgain() const {
    const BeliefPrior before = prior();
    return recallAt(&history_, "cup", &before, kEver);
  }

  test::TemporaryFolder folder_;
  History history_{folder_.path() / "history.sqlite", HistoryAccess::kAppend};
  Recollection recollection_{history_};
};

void expectSame(const Recalled& a, const Recalled& b) {
  EXPECT_EQ(a.newest_ns, b.newest_ns);
  EXPECT_EQ(a.missed.has_value() ? a.missed->time_ns : -1, b.missed.has_value() ? b.missed->time_ns : -1);
  ASSERT_EQ(a.state.has_value(), b.state.has_value());
  if (a.state) {
    EXPECT_EQ(a.state->number, b.state->number);
  }
  ASSERT_EQ(a.belief.has_value(), b.belief.has_value());
  if (!a.belief) {
    return;
  }
  const std::int64_t now_ns = a.belief->newest_ns().value() + 5 * kHour_ns;
  const Belief one = a.belief->at(now_ns);
  const Belief other = b.belief->at(now_ns);
  EXPECT_NEAR(one.elsewhere, other.elsewhere, 1e-12);
  ASSERT_EQ(one.places.size(), other.places.size());
  for (std::size_t i = 0; i < one.places.size(); ++i) {
    EXPECT_EQ(one.places[i].place, other.places[i].place);
    EXPECT_NEAR(one.places[i].probability, other.places[i].probability, 1e-12);
  }
}

TEST_F(RecollectionTest, NothingIsKnownOfWhatWasNeverSeen) {
  EXPECT_FALSE(recall()->state);
  EXPECT_FALSE(recall()->belief);
}

TEST_F(RecollectionTest, WhatHomeXmlHasSeenCountsUntilTheHistorySaysSomething) {
  BeliefPrior seen = prior();
  seen.first_seen = placed(EventKind::kSighted, "table", 1);
  ASSERT_TRUE(recallAt(nullptr, "cup", &seen, 2).belief);
  EXPECT_EQ(recallAt(nullptr, "cup", &seen, 2).belief->at(2).expected_at, (Place{"table", Relation::kOn}));
  EXPECT_FALSE(recallAt(nullptr, "cup", &seen, 0).belief) << "seen later";
  happens(placed(EventKind::kSighted, "shelf", 3));
  EXPECT_EQ(recallAt(&history_, "cup", &seen, kEver).belief->at(3).expected_at, (Place{"shelf", Relation::kOn}));
}

TEST_F(RecollectionTest, IsAsReadFromTheHistoryWhateverComesInWhateverOrder) {
  std::mt19937_64 random(5);
  const std::vector<EventKind> kinds{EventKind::kSighted, EventKind::kSighted, EventKind::kMissed, EventKind::kCorrected};
  const std::vector<std::string> parents{"table", "shelf", "floor"};
  for (int i = 0; i < 300; ++i) {
    const auto time_ns = static_cast<std::int64_t>(random() % 7 == 0 ? random() % 100 : 100 + static_cast<std::uint64_t>(i)) * kHour_ns;
    Event event = placed(kinds[random() % kinds.size()], parents[random() % parents.size()], time_ns, random() % 2 == 0 ? 0.9 : 0.4);
    event.recording = "drive-" + std::to_string(random() % 5);
    if (random() % 20 == 0) {
      event.kind = EventKind::kReverted;
    }
    happens(event);
    if (random() % 3 != 0) {  // now and then nobody asks
      expectSame(*recall(), readAgain());
    }
  }
}

TEST_F(RecollectionTest, AMissCountsUntilSomethingIsHeardOfThePlace) {
  EXPECT_FALSE(recall()->missed);
  happens(placed(EventKind::kSighted, "table", 1));
  happens(placed(EventKind::kMissed, "table", 2));
  ASSERT_TRUE(recall()->missed);
  EXPECT_EQ(recall()->missed->time_ns, 2);
  EXPECT_EQ(recall()->state.value().time_ns, 1) << "it changes no state";
  happens(placed(EventKind::kSighted, "table", 3));
  EXPECT_FALSE(recall()->missed);
}

TEST_F(RecollectionTest, ForgottenEvidenceIsNotRecalled) {
  Event seen = placed(EventKind::kSighted, "table", 1);
  seen.evidence = "evidence/a.jpg";
  happens(seen);
  EXPECT_EQ(recall()->state.value().evidence, "evidence/a.jpg");
  Event forgotten;
  forgotten.kind = EventKind::kForgotten;
  forgotten.subject = "other";
  forgotten.time_ns = 2;
  forgotten.evidence = "evidence/a.jpg";
  happens(forgotten);
  EXPECT_EQ(recall()->state.value().evidence, "");
}

TEST_F(RecollectionTest, LongHistoriesCountFromTheirNewestEventsOn) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < 3 * kMostRecalled; ++i) {
    events.push_back(placed(EventKind::kSighted, i < kMostRecalled ? "table" : "shelf", static_cast<std::int64_t>(i)));
  }
  history_.append(events);
  const Belief belief = recall()->belief->at(static_cast<std::int64_t>(events.size()));
  EXPECT_EQ(belief.expected_at, (Place{"shelf", Relation::kOn}));
  EXPECT_GT(belief.places.front().probability, 0.99);
}

TEST_F(RecollectionTest, OfManyThingsOnlySomeAreKept) {
  for (int i = 0; i < 20'000; ++i) {
    EXPECT_FALSE(recollection_.recall("thing-" + std::to_string(i), {})->state);
  }
}

TEST_F(RecollectionTest, AReaderNeverKeepsWhatAnEventHasOutdated) {
  constexpr int kEvents = 60;
  std::atomic<bool> done = false;
  std::vector<std::jthread> readers;
  for (int r = 0; r < 3; ++r) {
    readers.emplace_back([&] {
      while (!done) {
        (void)recall();
        recollection_.clear();
      }
    });
  }
  for (int i = 0; i < kEvents; ++i) {
    happens(placed(EventKind::kSighted, i % 2 == 0 ? "table" : "shelf", i));
    ASSERT_EQ(recall()->newest_ns, i);
  }
  done = true;
}

}  // namespace
}  // namespace oikos::semantic
