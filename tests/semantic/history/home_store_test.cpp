// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/home_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/read_file.h"
#include "semantic/history/home_state.h"
#include "semantic/xml/home_reader.h"
#include "semantic/xml/home_writer.h"
#include "tests/semantic/history/home_store_fixture.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/random_home.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

TEST_F(HomeStoreTest, AnEventIsInTheSnapshotAndSurvivesWithoutACheckpoint) {
  open();
  EXPECT_EQ(store_->append({hinge(30, 5)}), 1);
  EXPECT_NEAR(openingDeg(), 30.0, 1e-9);
  EXPECT_EQ(home().as_of, 1);
  const std::vector<Event> events = store_->history().eventsAfter(0, 10);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].before, State(JointValue{JointType::kRevolute, 0.0}));
  const Home before = home();
  open();
  EXPECT_TRUE(home() == before);
  EXPECT_EQ(text(), base::readFile(kPapers));
}

TEST_F(HomeStoreTest, ACheckpointWritesWhatTheSnapshotSays) {
  open();
  (void)store_->append({hinge(30, 5), sighting("cupboard-body", 6)});
  store_->checkpoint();
  EXPECT_TRUE(onDisk() == home());
  EXPECT_NE(text().find("asOf=\"2\""), std::string::npos);
  EXPECT_NE(text().find("<!-- The two-room test house of the papers"), std::string::npos);
  const std::string first = text();
  store_->checkpoint();
  EXPECT_EQ(text(), first);
  const Home before = home();
  open();
  EXPECT_TRUE(home() == before);
  EXPECT_EQ(store_->history().lastNumber(), 2);  // its own writing is no edit
}

TEST_F(HomeStoreTest, BeforeIsWhatTheEventAheadOfItInTheSameBatchSaid) {
  open();
  (void)store_->append({hinge(30, 5), hinge(60, 6)});
  EXPECT_EQ(store_->history().eventsAfter(1, 1)[0].before, store_->history().eventsAfter(0, 1)[0].after);
}

TEST_F(HomeStoreTest, OneWrongEventRefusesItsBatchOnly) {
  open();
  EXPECT_THROW((void)store_->append({hinge(30, 5), hinge(400, 6)}), base::Error);
  EXPECT_EQ(store_->history().lastNumber(), 0);
  EXPECT_EQ(openingDeg(), 0.0);
  EXPECT_EQ(store_->append({hinge(30, 5)}), 1);
}

TEST_F(HomeStoreTest, OneKeeperAtATime) {
  open();
  try {
    const HomeStore second(folder_.path(), [] { return std::int64_t{0}; });
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kIo);
    EXPECT_NE(std::string(error.what()).find("process " + std::to_string(::getpid())), std::string::npos);
  }
}

TEST_F(HomeStoreTest, SeesWhatOthersCommit) {
  open();
  EXPECT_FALSE(store_->refresh());
  const Event event = hinge(30, 5);
  (void)History(folder_.path() / "history.sqlite", HistoryAccess::kAppend).append({&event, 1});
  EXPECT_EQ(openingDeg(), 0.0);
  EXPECT_TRUE(store_->refresh());
  EXPECT_NEAR(openingDeg(), 30.0, 1e-9);
  (void)History(folder_.path() / "history.sqlite", HistoryAccess::kAppend).append({&event, 1});
  EXPECT_EQ(store_->append({hinge(10, 6)}), 3);
  EXPECT_EQ(home().as_of, 3);
  EXPECT_NEAR(openingDeg(), 10.0, 1e-9);
}

TEST_F(HomeStoreTest, AFullDiskRefusesEventsAndCheckpointsAndReadsGoOn) {
  open();
  (void)store_->append({hinge(30, 5)});
  const Home before = home();
  const std::string old_text = text();
  {
    const test::FileSizeLimit limit(4096);
    EXPECT_THROW((void)store_->append({hinge(40, 6)}), base::Error);
    EXPECT_TRUE(home() == before);
    EXPECT_THROW(store_->checkpoint(), base::Error);
    EXPECT_EQ(store_->history().lastNumber(), 1);
  }
  EXPECT_EQ(text(), old_text);
  EXPECT_EQ(store_->append({hinge(40, 6)}), 2);
  store_->checkpoint();
  EXPECT_TRUE(onDisk() == home());
}

TEST_F(HomeStoreTest, AnyOrderOfEventsEditsCheckpointsAndRestartsGivesTheSameHome) {
  std::mt19937 random(11);
  (void)folder_.write("home.xml", toXml(test::randomHome(17)));
  open();
  Home expected = home();
  std::int64_t time_ns = 1;
  for (unsigned step = 0; step < 150; ++step) {
    now_ns_ = time_ns += 10;
    switch (random() % 4) {
      case 0: {  // events: the states of a changed home
        const Home changed = test::randomlyChanged(expected, step);
        const HomeState wanted(changed);
        std::vector<Event> events;
        HomeState next(expected);
        for (const Room& room : expected.rooms) {
          for (const LargeObject& object : room.objects) {
            if (const auto state = wanted.findState(object.id.value); state && *state != next.findState(object.id.value)) {
              events.push_back(moved(object.id.value, *state, time_ns));
              next.set(object.id.value, *state);
            }
          }
        }
        if (!events.empty()) {
          (void)store_->append(events);
          expected = next.home();
        }
        break;
      }
      case 1:
        store_->checkpoint();
        EXPECT_TRUE(sameButForAsOf(onDisk(), expected)) << step;
        break;
      case 2:
        open();
        break;
      default: {  // a hand edit, after what there was is in the file
        store_->checkpoint();
        const Home before = onDisk();
        expected = test::randomlyChanged(before, step);
        const std::string edited = spliceXml(text(), before, expected);
        const bool away = random() % 2 == 0;
        if (away) {
          store_.reset();
        }
        (void)folder_.write("home.xml", edited);
        if (away) {
          open();
        } else {
          (void)store_->reload();
        }
      }
    }
    ASSERT_TRUE(sameButForAsOf(home(), expected)) << "step " << step << "\n" << toXml(home()) << "\n" << toXml(expected);
  }
}

TEST_F(HomeStoreTest, ReadersWritersCheckpointsAndEditsAtOnce) {
  constexpr int kEach = 40;
  open();
  std::atomic<bool> stop = false;
  std::vector<std::jthread> others;
  others.emplace_back([&] {
    while (!stop) {
      const auto snapshot = store_->snapshot();
      EXPECT_EQ(snapshot->home.rooms.size(), 2U);
      EXPECT_LE(snapshot->home.as_of, store_->history().lastNumber());
    }
  });
  others.emplace_back([&] {
    for (int i = 0; !stop; ++i) {
      store_->checkpoint();
      i % 2 == 0 ? replaceInFile("name=\"", "name=\"x") : replaceInFile("name=\"x", "name=\"");
      (void)store_->reload();
    }
  });
  {
    std::vector<std::jthread> writers;
    for (int w = 0; w < 3; ++w) {
      writers.emplace_back([&, w] {
        for (int i = 0; i < kEach; ++i) {
          const std::int64_t number = store_->append({hinge(i, 100 * i + w), sighting(i % 2 == 0 ? "table" : "fridge-body", 100 * i + w)});
          EXPECT_GE(home().as_of, number);
        }
      });
    }
  }
  stop = true;
  others.clear();
  EXPECT_NEAR(openingDeg(), kEach - 1, 1e-9);
  store_->checkpoint();
  const Home last = home();
  EXPECT_TRUE(onDisk() == last);
  open();
  EXPECT_TRUE(home() == last);
}

}  // namespace
}  // namespace oikos::semantic
