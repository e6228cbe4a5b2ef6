// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/forget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

using Paths = std::vector<std::string>;

constexpr std::int64_t kNow_ns = 1000;

class ForgetTest : public testing::Test {
 protected:
  /// An event with its image on the disk.
  Event seen(const std::string& subject, std::int64_t time_ns, const std::string& recording, const std::string& image) const {
    Event event;
    event.subject = subject;
    event.time_ns = time_ns;
    event.recording = recording;
    event.after = KnobSetting{"on"};
    event.kind = EventKind::kKnob;
    event.evidence = "evidence/" + image;
    (void)home_.write(event.evidence, "jpeg");
    return event;
  }

  void append(const std::vector<Event>& events) { (void)history_.append(events); }
  [[nodiscard]] Forgetting forget(const ForgetSelection& selection) { return forgetEvidence(history_, home_.path(), selection, kNow_ns); }
  [[nodiscard]] bool isThere(const std::string& image) const { return std::filesystem::exists(home_.path() / "evidence" / image); }
  [[nodiscard]] Paths evidenceOf(const std::string& subject) const {
    Paths paths;
    for (const Event& event : history_.eventsOf(subject)) {
      if (event.kind != EventKind::kForgotten) {
        paths.push_back(event.evidence);
      }
    }
    return paths;
  }

  test::TemporaryFolder home_;
  History history_{home_.path() / "history.sqlite", HistoryAccess::kAppend};
};

TEST_F(ForgetTest, OneRecordingsImages) {
  append({seen("cup", 1, "a", "1.jpg"), seen("cup", 2, "b", "2.jpg"), seen("oven", 3, "a", "3.jpg")});
  const Forgetting done = forget({.recording = "a"});
  EXPECT_EQ(done.removed, (Paths{"evidence/1.jpg", "evidence/3.jpg"}));
  EXPECT_TRUE(done.missing.empty());
  EXPECT_FALSE(isThere("1.jpg"));
  EXPECT_TRUE(isThere("2.jpg"));
  EXPECT_EQ(evidenceOf("cup"), (Paths{"", "evidence/2.jpg"}));  // what was seen stays
  const Event tombstone = history_.eventsAfter(3, 1).at(0);
  EXPECT_EQ(tombstone.kind, EventKind::kForgotten);
  EXPECT_EQ(tombstone.subject, "cup");
  EXPECT_EQ(tombstone.evidence, "evidence/1.jpg");
  EXPECT_EQ(tombstone.time_ns, kNow_ns);
  EXPECT_EQ(history_.findStateAt("cup", kNow_ns)->time_ns, 2);
}

TEST_F(ForgetTest, OneObjectsOrThoseBeforeATimeOrAll) {
  append({seen("cup", 1, "a", "1.jpg"), seen("oven", 2, "a", "2.jpg"), seen("oven", 3, "a", "3.jpg")});
  EXPECT_EQ(forget({.subject = "cup"}).removed, Paths{"evidence/1.jpg"});
  EXPECT_EQ(forget({.before_ns = 3}).removed, Paths{"evidence/2.jpg"});
  EXPECT_EQ(forget({}).removed, Paths{"evidence/3.jpg"});
  const std::int64_t last = history_.lastNumber();
  EXPECT_TRUE(forget({}).removed.empty());
  EXPECT_EQ(history_.lastNumber(), last);
}

TEST_F(ForgetTest, WhatWasTakenBackGoesToo) {
  append({seen("cup", 1, "a", "1.jpg")});
  Event reverted = history_.eventsOf("cup").at(0);
  reverted.kind = EventKind::kReverted;
  reverted.evidence = "";
  append({reverted});
  EXPECT_EQ(forget({.recording = "a"}).removed, Paths{"evidence/1.jpg"});
}

TEST_F(ForgetTest, AnImageOfTwoThingsIsForgottenForBoth) {
  append({seen("cup", 1, "a", "1.jpg"), seen("bowl", 1, "a", "1.jpg")});
  EXPECT_EQ(forget({.subject = "cup"}).removed, Paths{"evidence/1.jpg"});
  EXPECT_EQ(evidenceOf("bowl"), Paths{""});
  EXPECT_EQ(history_.eventsOf("bowl").back().kind, EventKind::kForgotten);
}

TEST_F(ForgetTest, AnInterruptedRunIsFinishedByTheNext) {
  append({seen("cup", 1, "a", "1.jpg"), seen("cup", 2, "b", "2.jpg")});
  Event tombstone;
  tombstone.subject = "cup";
  tombstone.kind = EventKind::kForgotten;
  tombstone.evidence = "evidence/1.jpg";
  append({tombstone});
  EXPECT_EQ(forget({.recording = "nothing of this one"}).removed, Paths{"evidence/1.jpg"});
  EXPECT_FALSE(isThere("1.jpg"));
  EXPECT_TRUE(isThere("2.jpg"));
  EXPECT_EQ(history_.lastNumber(), 3);
}

TEST_F(ForgetTest, AnImageThatComesAgainUnderItsNameIsANewOne) {
  append({seen("cup", 1, "a", "1.jpg")});
  EXPECT_EQ(forget({}).removed.size(), 1U);
  append({seen("cup", 2, "a", "1.jpg")});
  EXPECT_EQ(evidenceOf("cup"), (Paths{"", "evidence/1.jpg"}));
  EXPECT_TRUE(forget({.recording = "b"}).removed.empty());
  EXPECT_TRUE(isThere("1.jpg"));
  EXPECT_EQ(forget({.recording = "a"}).removed.size(), 1U);
}

TEST_F(ForgetTest, NeverAFileOutsideTheEvidenceFolder) {
  const auto secret = home_.write("home.xml", "keep me");
  Event absolute = seen("cup", 1, "a", "1.jpg");
  Event upwards = absolute;
  absolute.evidence = secret.string();
  upwards.evidence = "evidence/../home.xml";
  std::filesystem::create_symlink(secret, home_.path() / "evidence/link.jpg");
  Event link = absolute;
  link.evidence = "evidence/link.jpg";
  append({absolute, upwards, link});
  const Forgetting done = forget({});
  EXPECT_TRUE(done.removed.empty());
  EXPECT_EQ(done.untouched.size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(secret));
  EXPECT_EQ(history_.lastNumber(), 3);
}

TEST_F(ForgetTest, AMissingImageIsNotedToo) {
  Event event = seen("cup", 1, "a", "1.jpg");
  std::filesystem::remove(home_.path() / event.evidence);
  append({event});
  const Forgetting done = forget({});
  EXPECT_TRUE(done.removed.empty());
  EXPECT_EQ(done.missing, Paths{"evidence/1.jpg"});
  EXPECT_EQ(evidenceOf("cup"), Paths{""});
}

}  // namespace
}  // namespace oikos::semantic
