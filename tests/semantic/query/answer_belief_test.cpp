// SPDX-License-Identifier: Apache-2.0
// What time, and having been looked for in vain, make of where a thing is said to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "semantic/query/answer.h"
#include "tests/semantic/papers_house.h"
#include "tests/semantic/query/ask.h"
#include "tests/support/temporary_folder.h"

namespace oikos::semantic {
namespace {

TEST(Answer, WhatWasSeenLongAgoIsLessSureAndMayBeExpectedElsewhere) {
  Home home = papersHouse();
  auto& on_table = home.rooms[0].objects[0].edit().small_objects;
  SmallObject& cup = *std::find_if(on_table.begin(), on_table.end(), [](const SmallObject& small) { return small.id.value == "blue-cup"; });
  constexpr std::int64_t kDay_ns = 86'400'000'000'000;
  cup.last_seen_ns = kNow_ns - kDay_ns;  // a cup's half-life
  cup.confidence = 1.0;
  const FoundThing yesterday = ask(home, "where is the blue cup").found.at(0);
  // It is put away to the table (a usual place, and seen to have come there), the cupboard (a usual place), or elsewhere, as 2 : 1 : 1.
  EXPECT_NEAR(yesterday.confidence.value(), 0.5 + 0.5 * 2 / 4, 1e-9);
  EXPECT_NEAR(yesterday.elsewhere.value(), 0.5 * 1 / 4, 1e-9);
  ASSERT_FALSE(yesterday.expected_at.empty());
  EXPECT_EQ(yesterday.expected_at.front().place.parent, cup.parent);
  home.vocabulary.edit().add(TermKind::kObjectType, {"cup", {}, 24000.0});
  EXPECT_GT(ask(home, "where is the blue cup").found.at(0).confidence.value(), 0.999) << "cups stay longer in this home";
}

TEST(Answer, WhatWasMissedIsSaidToHaveBeenLookedForInVain) {
  const Home home = papersHouse();
  const HomeIndex index(home);
  const test::TemporaryFolder folder;
  History history(folder.path() / "history.sqlite", HistoryAccess::kAppend);
  const SmallObject& cup = home.rooms[0].objects[0]->small_objects[3];
  ASSERT_EQ(cup.id.value, "blue-cup");
  Event missed;
  missed.kind = EventKind::kMissed;
  missed.subject = cup.id.value;
  missed.time_ns = kNow_ns - 3'600'000'000'000;
  missed.after = Placement{cup.parent, cup.relation, cup.T_parent_object};
  missed.confidence = 0.999;
  history.append(std::vector{missed});
  const Answer answer = answerQuestion({&index, &history, kNow_ns, std::nullopt}, "where is the blue cup");
  EXPECT_NE(answer.sentence.find("but was looked for there in vain"), std::string::npos) << answer.sentence;
  EXPECT_EQ(answer.found.at(0).missed_ns, missed.time_ns);
  EXPECT_FALSE(nlohmann::json::parse(toJson(answer))["found"][0]["missed"].is_null());
  const Answer several = answerQuestion({&index, &history, kNow_ns, std::nullopt}, "where are the cups");
  const std::string& both = several.sentence;
  ASSERT_EQ(several.found.size(), 2U) << both;
  EXPECT_EQ(both.find("in vain"), both.rfind("in vain")) << both;
  EXPECT_NE(both.find("in vain", both.find("blue cup")), std::string::npos) << "not of the red one: " << both;
  EXPECT_FALSE(several.found[0].missed_ns);
  EXPECT_EQ(several.found[1].missed_ns, missed.time_ns);
  const auto json = nlohmann::json::parse(toJson(several))["found"];
  EXPECT_TRUE(json[0]["missed"].is_null());
  EXPECT_FALSE(json[1]["missed"].is_null());
  const Answer changes = answerQuestion({&index, &history, kNow_ns, std::nullopt}, "what has changed today");
  ASSERT_EQ(changes.changes.size(), 1U) << changes.sentence;
  EXPECT_NE(changes.sentence.find("not where it was expected"), std::string::npos) << changes.sentence;

  Event again = missed;
  again.time_ns += 60'000'000'000;
  history.append(std::vector{again});
  EXPECT_EQ(answerQuestion({&index, &history, kNow_ns, std::nullopt}, "what has changed today").changes.size(), 1U) << "no news";
  Event seen = again;
  seen.kind = EventKind::kSighted;
  seen.time_ns += 60'000'000'000;
  history.append(std::vector{seen});
  const Answer found = answerQuestion({&index, &history, kNow_ns, std::nullopt}, "where is the blue cup");
  EXPECT_EQ(found.sentence.find("in vain"), std::string::npos) << found.sentence;
  EXPECT_FALSE(found.found.at(0).missed_ns);
}

}  // namespace
}  // namespace oikos::semantic
