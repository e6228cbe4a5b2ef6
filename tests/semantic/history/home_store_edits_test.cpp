// SPDX-License-Identifier: Apache-2.0
// home.xml between the person who edits it and the store that writes it.
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/read_file.h"
#include "semantic/history/home_store.h"
#include "tests/semantic/history/home_store_fixture.h"
#include "tests/support/file_calls.h"

namespace oikos::semantic {
namespace {

TEST_F(HomeStoreTest, AnEditWhileNobodyLooksBecomesAnEvent) {
  open();
  (void)store_->append({hinge(30, 5)});
  store_->checkpoint();
  (void)store_->append({sighting("cupboard-body", 6)});
  store_.reset();
  replaceInFile("value_deg=\"30\"", "value_deg=\"45\"");
  replaceInFile("name=\"bathroom\"", "name=\"bath\"");
  open();
  EXPECT_NEAR(openingDeg(), 45.0, 1e-9);
  EXPECT_EQ(home().rooms[1].name, "bath");
  EXPECT_EQ(std::get<Placement>(HomeState(home()).findState("blue-cup").value()).parent, "cupboard-body");
  const std::vector<Event> edits = store_->history().eventsAfter(2, 10);
  ASSERT_EQ(edits.size(), 2U);
  EXPECT_EQ(edits[0].subject, "bathroom");
  EXPECT_EQ(edits[1].kind, EventKind::kEdited);
  EXPECT_EQ(edits[1].time_ns, now_ns_);
  open();
  EXPECT_EQ(store_->history().lastNumber(), 4);  // noticed once
  store_->checkpoint();
  EXPECT_TRUE(onDisk() == home());
}

TEST_F(HomeStoreTest, AnEditIsTakenUpByReloadAndACheckpointNeverWritesOverOne) {
  open();
  EXPECT_FALSE(store_->reload());
  (void)store_->append({hinge(30, 5)});
  replaceInFile("name=\"bathroom\"", "name=\"bath\"");
  EXPECT_TRUE(store_->reload());
  EXPECT_EQ(home().rooms[1].name, "bath");
  EXPECT_NEAR(openingDeg(), 30.0, 1e-9);
  EXPECT_EQ(store_->snapshot()->structure, 1);
  replaceInFile("name=\"kitchen\"", "name=\"cuisine\"");
  store_->checkpoint();
  EXPECT_EQ(home().rooms[0].name, "cuisine");
  EXPECT_TRUE(onDisk() == home());
}

TEST_F(HomeStoreTest, AnInvalidEditIsRefusedAndTheOldOneKept) {
  open();
  (void)store_->append({hinge(30, 5)});
  const Home before = home();
  replaceInFile("id=\"blue-cup\"", "id=\"red-cup\"");
  const std::string edited = text();
  try {
    (void)store_->reload();
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kInput);
    EXPECT_NE(std::string(error.what()).find("used already"), std::string::npos);
  }
  EXPECT_THROW(store_->checkpoint(), base::Error);
  EXPECT_TRUE(home() == before);
  EXPECT_EQ(text(), edited);
  EXPECT_EQ(store_->append({hinge(31, 6)}), 2);
  store_.reset();
  EXPECT_THROW(open(), base::Error);
}

TEST_F(HomeStoreTest, ACrashBetweenCheckpointAndFileIsNoEdit) {
  open();
  const std::string old_text = text();
  (void)store_->append({hinge(30, 5)});
  store_->checkpoint();
  const Home before = home();
  store_.reset();
  (void)folder_.write("home.xml", old_text);  // as if the renaming had never reached the disk
  open();
  EXPECT_TRUE(sameButForAsOf(home(), before));
  EXPECT_EQ(store_->history().lastNumber(), 1);
}

/// Names the bathroom `bathroom1`, `bathroom2`, … at each of the first `times` attempts to replace the file, which then put it back.
class EditAtRenaming {
 public:
  EditAtRenaming(std::filesystem::path file, int times)
      : file_(std::move(file)), times_(times), hook_(file_, [this] {
          if (calls_++ % 2 == 0 && edits_ < times_) {
            edit();
          }
          return 0;
        }) {}

  [[nodiscard]] int edits() const { return edits_; }

 private:
  void edit() {
    std::string content = base::readFile(file_);
    const std::size_t at = content.find("name=\"bathroom") + std::string("name=\"bathroom").size();
    content.replace(at, content.find('"', at) - at, std::to_string(++edits_));
    base::writeFileAtomically(file_, content);
  }

  std::filesystem::path file_;
  int times_;
  int calls_ = 0;
  int edits_ = 0;
  test::RenameHook hook_;
};

TEST_F(HomeStoreTest, AnEditAtTheVeryMomentOfTheRenamingIsTakenUp) {
  open();
  (void)store_->append({hinge(30, 5)});
  {
    const EditAtRenaming edit(file_, 1);
    store_->checkpoint();
    EXPECT_EQ(edit.edits(), 1);
  }
  EXPECT_EQ(home().rooms[1].name, "bathroom1");
  EXPECT_NEAR(openingDeg(), 30.0, 1e-9);
  EXPECT_TRUE(onDisk() == home());
  const std::vector<Event> events = store_->history().eventsAfter(0, 10);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].kind, EventKind::kEdited);
  EXPECT_EQ(events[1].subject, "bathroom");
  const Home before = home();
  open();
  EXPECT_TRUE(home() == before);
  EXPECT_EQ(store_->history().lastNumber(), 2);
}

TEST_F(HomeStoreTest, AFileThatIsEditedAllTheTimeIsLeftForLater) {
  constexpr int kTimes = 1000;
  open();
  (void)store_->append({hinge(30, 5)});
  std::string last;
  {
    const EditAtRenaming edit(file_, kTimes);
    EXPECT_THROW(store_->checkpoint(), base::Error);
    last = "bathroom" + std::to_string(edit.edits());
    EXPECT_LT(edit.edits(), kTimes);
  }
  EXPECT_EQ(onDisk().rooms[1].name, last);
  store_->checkpoint();
  EXPECT_EQ(onDisk().rooms[1].name, last);
  EXPECT_TRUE(onDisk() == home());
  EXPECT_NEAR(openingDeg(), 30.0, 1e-9);
}

TEST_F(HomeStoreTest, CheckpointsThatCannotBeWrittenAreNoEdits) {
  open();
  const std::string old_text = text();
  {
    const test::RenameHook hook(file_, [] { return EIO; });
    for (int i = 1; i <= 3; ++i) {
      (void)store_->append({hinge(10 * i, i)});
      EXPECT_THROW(store_->checkpoint(), base::Error);
    }
  }
  EXPECT_EQ(text(), old_text);
  const Home before = home();
  open();
  EXPECT_TRUE(sameButForAsOf(home(), before));
  EXPECT_EQ(store_->history().lastNumber(), 3);
  store_->checkpoint();
  EXPECT_TRUE(onDisk() == home());
}

TEST_F(HomeStoreTest, SeveralCrashesBetweenCheckpointAndFileAreNoEdits) {
  open();
  const std::string old_text = text();
  for (int i = 1; i <= 3; ++i) {
    (void)store_->append({hinge(10 * i, i)});
    store_->checkpoint();
    const Home before = home();
    store_.reset();
    (void)folder_.write("home.xml", old_text);
    open();
    EXPECT_TRUE(sameButForAsOf(home(), before)) << i;
    EXPECT_EQ(store_->history().lastNumber(), i);
  }
}

}  // namespace
}  // namespace oikos::semantic
