// SPDX-License-Identifier: Apache-2.0
// Questions that are long, hostile, unfinished, half understood or about what nobody knows.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "semantic/query/answer.h"
#include "tests/semantic/papers_house.h"
#include "tests/semantic/query/ask.h"

namespace oikos::semantic {
namespace {

TEST(Answer, NoTextThrows) {
  const Home home = papersHouse();
  const HomeIndex index(home);
  const std::vector<std::string> words{"where",  "what",    "which",     "is",     "are",      "how",     "many",    "far",    "open",
                                       "closed", "set",     "to",        "on",     "in",       "the",     "cup",     "table",  "fridge",
                                       "there",  "find",    "s",         "",       "\xFF",     "kitchen", "bring",   "second", "drawer",
                                       "of",     "nearest", "yesterday", "at",     "8",        "when",    "changed", "left",   "that",
                                       "and",    "last",    "seen",      "do",     "anything", "but",     "not",     "or",     "every",
                                       "it",     ",",       "isn't",     "anyone", "i",        "got",     "has",     "one",    "two"};
  std::uint32_t state = 7;
  for (int i = 0; i < 20000; ++i) {
    std::string question;
    for (int k = 0; k < 6; ++k) {
      state = state * 1664525U + 1013904223U;
      question += words[(state >> 16) % words.size()] + " ";
    }
    EXPECT_NO_THROW((void)answerQuestion({&index, nullptr, kNow_ns, std::nullopt}, question)) << question;
  }
}

TEST(Answer, HostileTextIsRefusedOrAnswered) {
  const Home home = papersHouse();
  std::string many;
  for (int i = 0; i < 200000; ++i) {
    many += "cup ";
  }
  EXPECT_NE(ask(home, many).sentence.find("too long"), std::string::npos);
  EXPECT_NE(ask(home, many.substr(0, 300)).sentence.find("64 words"), std::string::npos);
  std::string nested = "where is";
  for (int i = 0; i < 20; ++i) {
    nested += " cup on the";
  }
  EXPECT_FALSE(ask(home, nested + " table").sentence.empty());
  EXPECT_EQ(ask(home, std::string("where is the blue\0cup", 21)).found.size(), 1U);
  EXPECT_EQ(ask(home, "where is the \xC3\x28 cup").status, AnswerStatus::kUnknownWord);
  EXPECT_EQ(ask(home, "where is the cup in 99999999999999999999 days ago").status, AnswerStatus::kUnknownWord);
}

TEST(Answer, WhatIsNotKnownIsNoCertainNo) {
  const Home home = papersHouse();
  for (const char* question :
       {"is the fridge full", "is the blue cup clean", "is the cup in the bathtub", "is there a freezer in the kitchen",
        "how many ukuleles are there", "which cups are not on the table", "where is the ball"}) {
    EXPECT_NE(ask(home, question).status, AnswerStatus::kAnswered) << question << "\n" << ask(home, question).sentence;
  }
  EXPECT_EQ(ask(home, "is anything open").yes, false);
  EXPECT_EQ(ask(home, "are the doors closed").yes, true);
}

TEST(Answer, AHomeHasItsOwnSurplusWords) {
  Home home = papersHouse();
  const std::string question = "old chap where is the blue cup guv";
  EXPECT_EQ(ask(home, question).status, AnswerStatus::kNotUnderstood);
  home.vocabulary.edit().add(TermKind::kSurplus, {"guv", {"old chap"}});
  EXPECT_EQ(ask(home, question).status, AnswerStatus::kAnswered);
  EXPECT_EQ(ask(home, "where is the cup on the right").status, ask(papersHouse(), "where is the cup on the right").status);
}

TEST(Answer, AnUnfinishedQuestionIsNotUnderstood) {
  for (const char* question : {"anything but", "anything", "is", "is not", "has anything", "are there five cups"}) {
    EXPECT_NE(ask(papersHouse(), question).status, AnswerStatus::kUnknownWord) << question;
    EXPECT_FALSE(ask(papersHouse(), question).yes) << question;
    EXPECT_FALSE(ask(papersHouse(), question).sentence.empty()) << question;
  }
}

TEST(Answer, NamesWhatItPassedOver) {
  const Answer answer = ask(papersHouse(), "Where is the blue cup, Marvin?");
  EXPECT_EQ(answer.status, AnswerStatus::kAnswered);
  EXPECT_EQ(answer.not_understood, std::vector<std::string>{"marvin"});
}

TEST(Answer, StatesAndGrammarAreNoMisspeltThings) {
  const Home home = papersHouse();
  for (const char* question : {"where is the open", "where is the cup know", "is the blue cup shut on", "which cups are still"}) {
    EXPECT_TRUE(ask(home, question).corrected.empty()) << question;
  }
  EXPECT_TRUE(ask(home, "where is my dear").suggestions.empty());
  EXPECT_EQ(ask(home, "where is my suger").corrected.size(), 1U);
}

}  // namespace
}  // namespace oikos::semantic
