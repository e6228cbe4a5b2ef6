// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/question_table.h"

namespace oikos::semantic {
namespace {

const std::filesystem::path kSource = OIKOS_SOURCE_DIR;

TEST(QuestionTable, EveryQuestionIsAnsweredRight) {
  const std::vector<test::TableRow> table = test::readTable(kSource / "tests/data/questions/table.json");
  EXPECT_GE(table.size(), 150U);
  const test::TableScore score = test::score(table, kSource);
  EXPECT_EQ(score.right, table.size());
  for (const std::string& failure : score.failures) {
    ADD_FAILURE() << failure;
  }
}

TEST(QuestionTable, TheWayPeopleTalk) {
  const std::vector<test::TableRow> table = test::readTable(kSource / "tests/data/questions/people.json");
  ASSERT_EQ(table.size(), 80U);
  const test::TableScore score = test::score(table, kSource);
  std::printf("the way people talk: %zu of %zu right, %zu confident wrong answers\n", score.right, table.size(), score.confident.size());
  EXPECT_GE(100 * score.right, 85 * table.size());
  for (const std::string& failure : score.confident) {
    ADD_FAILURE() << failure;
  }
}

TEST(QuestionTable, TalkOfSomeoneWhoHasNotSeenTheParser) {
  constexpr std::size_t kReached = 150;  // of which 89 before the parser's author had read the table
  const std::vector<test::TableRow> table = test::readTable(kSource / "tests/data/questions/talk.json");
  ASSERT_EQ(table.size(), 150U);
  const test::TableScore score = test::score(table, kSource, false);
  std::printf("talk: %zu of %zu right, %zu confident wrong answers\n", score.right, table.size(), score.confident.size());
  EXPECT_GE(score.right, kReached);
  for (const std::string& failure : score.confident) {
    ADD_FAILURE() << failure;
  }
}

/// Its author had not seen the parser either: 68 before it was mended for, with two confident wrong answers.
TEST(QuestionTable, TalkOfAnotherStranger) {
  constexpr std::size_t kReached = 98;
  const std::vector<test::TableRow> table = test::readTable(kSource / "tests/data/questions/strangers.json");
  ASSERT_EQ(table.size(), 100U);
  const test::TableScore score = test::score(table, kSource, false);
  std::printf("strangers: %zu of %zu right, %zu confident wrong answers\n", score.right, table.size(), score.confident.size());
  EXPECT_GE(score.right, kReached);
  for (const std::string& failure : score.confident) {
    ADD_FAILURE() << failure;
  }
}

}  // namespace
}  // namespace oikos::semantic
