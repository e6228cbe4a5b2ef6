// SPDX-License-Identifier: Apache-2.0
// A power cut at any moment of a home's keeping: in a commit, between the history and home.xml, in the renaming. What was acknowledged is
// there afterwards, home.xml is valid and as old or as new as one of its checkpoints, and nothing of it is taken for an edit that was none.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "semantic/xml/home_reader.h"
#include "tests/semantic/history/home_store_fixture.h"
#include "tests/support/power_cut_folder.h"
#include "tests/support/power_cut_vfs.h"

namespace oikos::semantic {
namespace {

constexpr int kBatches = 24;
constexpr std::int64_t kBatchSize = 2;
constexpr int kEditBefore = 13;  // batch
constexpr int kCheckpointEach = 3;
constexpr int kCuts = 100;
constexpr int kCutsInARow = 3;
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

struct Acknowledged {
  std::int64_t events = 0;
  bool edit = false;
};

/// A tenth of a degree an event.
double openingAfter(std::int64_t event) {
  return 0.1 * static_cast<double>(event);
}

double openingOf(const Home& home) {
  return std::get<JointValue>(HomeState(home).findState("fridge-hinge").value()).value / kRadPerDeg;
}

void edit(const std::filesystem::path& file) {
  std::string content = base::readFile(file);
  const std::string name = "name=\"bathroom\"";
  if (const std::size_t at = content.find(name); at != std::string::npos) {
    base::writeFileAtomically(file, content.replace(at, name.size(), "name=\"bath\""));
  }
}

/// From the state that the folder has, until all is done or the power is gone. `events`: what the history has already.
void keepUntilCut(const std::filesystem::path& folder, Acknowledged& acknowledged) {
  try {
    HomeStore store(folder, [] { return std::int64_t{1}; });
    for (int b = 0; b < kBatches; ++b) {
      if (b == kEditBefore && !acknowledged.edit) {
        edit(folder / "home.xml");
        acknowledged.edit = true;
      }
      const std::int64_t number = acknowledged.events;
      (void)store.append({hinge(openingAfter(number + 1), number + 1), hinge(openingAfter(number + 2), number + 2)});
      acknowledged.events += kBatchSize;
      if (b % kCheckpointEach == kCheckpointEach - 1) {
        store.checkpoint();
      }
    }
  } catch (const base::Error&) {  // the power is gone
  }
}

/// Those of the joint; the only other one may be the edit.
std::int64_t countEvents(const HomeStore& store) {
  std::int64_t count = 0;
  for (const Event& event : store.history().eventsAfter(0, 100000)) {
    if (event.kind == EventKind::kJoint) {
      ++count;
      EXPECT_EQ(event.time_ns, count);
    } else {
      EXPECT_EQ(event.kind, EventKind::kEdited);
      EXPECT_EQ(event.subject, "bathroom");
    }
  }
  return count;
}

class HomeStorePowerCut : public HomeStoreTest {
 protected:
  /// How many operations it takes from the folder's state to the end.
  [[nodiscard]] static std::int64_t operationsOfAll() {
    const test::TemporaryFolder folder;
    (void)folder.write("home.xml", base::readFile(kPapers));
    test::PowerCutVfs disk(kNever);
    const test::PowerCutFolder files(folder.path(), "home.xml", [&] { return disk.operate(); });
    Acknowledged acknowledged;
    keepUntilCut(folder.path(), acknowledged);
    EXPECT_EQ(acknowledged.events, kBatches * kBatchSize);
    return disk.operations();
  }

  void cut(std::int64_t after, bool later_names) {
    test::PowerCutVfs disk(after);
    test::PowerCutFolder files(folder_.path(), "home.xml", [&] { return disk.operate(); });
    keepUntilCut(folder_.path(), acknowledged_);
    disk.restore();
    files.restore(later_names);
  }

  void check(const std::string& when) {
    SCOPED_TRACE(when);
    const Home written = getHome(readHome(file_), file_);  // throws unless it is valid
    EXPECT_LE(written.as_of, acknowledged_.events + kBatchSize + 1);
    open();
    const std::int64_t count = countEvents(*store_);
    EXPECT_GE(count, acknowledged_.events);
    EXPECT_LE(count, acknowledged_.events + kBatchSize);
    EXPECT_EQ(count % kBatchSize, 0);
    EXPECT_NEAR(openingOf(home()), openingAfter(count), 1e-9);
    const double steps = openingOf(written) / openingAfter(1);
    EXPECT_NEAR(steps, std::round(steps), 1e-6);  // it is one of those that there were
    EXPECT_LE(steps, static_cast<double>(count) + 1e-6);
    if (acknowledged_.edit) {
      EXPECT_EQ(home().rooms[1].name, "bath");
    }
    acknowledged_.events = count;
    acknowledged_.edit = home().rooms[1].name == "bath";
    store_.reset();
  }

  Acknowledged acknowledged_;
};

TEST_F(HomeStorePowerCut, NothingThatWasAcknowledgedIsLostAndNoEditIsMadeUp) {
  const std::int64_t operations = operationsOfAll();
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int64_t> moment(1, operations);
  for (int i = 0; i < kCuts; ++i) {
    store_.reset();
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      std::filesystem::remove(entry.path());
    }
    (void)folder_.write("home.xml", base::readFile(kPapers));
    acknowledged_ = {};
    for (int again = 0; again < kCutsInARow; ++again) {
      const std::int64_t after = moment(random);
      const bool later_names = random() % 2 == 0;
      cut(after, later_names);
      check("run " + std::to_string(i) + "." + std::to_string(again) + ", cut after " + std::to_string(after) +
            (later_names ? ", names of the moment" : ", names that were synced"));
      if (HasFailure()) {
        return;
      }
    }
  }
}

}  // namespace
}  // namespace oikos::semantic
