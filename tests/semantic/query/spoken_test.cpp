// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/spoken.h"

#include <gtest/gtest.h>

#include "semantic/query/words.h"

namespace oikos::semantic {
namespace {

using Words = std::vector<std::string>;

Words spoken(const std::string& text) {
  return spokenOut(wordsOf(text));
}

TEST(Spoken, ShortFormsInFull) {
  EXPECT_EQ(spoken("where'd I leave it"), (Words{"where", "did", "i", "leave", "it"}));
  EXPECT_EQ(spoken("what've we got"), (Words{"what", "have", "we", "got"}));
  EXPECT_EQ(spoken("The phone isn't here"), (Words{"the", "phone", "is", "not", "here"}));
  EXPECT_EQ(spoken("I'd like the cup"), (Words{"i", "would", "like", "the", "cup"}));
}

TEST(Spoken, WordsOfTheirOwnStay) {
  EXPECT_EQ(spoken("my id card"), (Words{"my", "id", "card"}));
  EXPECT_EQ(spoken("Anna's keys"), (Words{"anna", "'s", "keys"}));
  EXPECT_EQ(spoken("the cupboard's left door"), (Words{"the", "cupboard", "'s", "left", "door"}));
}

TEST(Spoken, AnOwnersEndingMayBeIs) {
  EXPECT_EQ(spoken("what room's the bathtub in"), (Words{"what", "room", "is", "the", "bathtub", "in"}));
  EXPECT_EQ(spoken("the cup's on the table"), (Words{"the", "cup", "is", "on", "the", "table"}));
}

TEST(Spoken, ClausesAreParted) {
  EXPECT_EQ(clausesOf("Car keys! Quick!"), (std::vector<std::string_view>{"Car keys", " Quick"}));
  EXPECT_EQ(clausesOf("the phone - where is it?").size(), 2U);
  EXPECT_EQ(clausesOf("at 8:30, or at 3.5 m").size(), 2U);
  EXPECT_EQ(clausesOf("the jar, on the well-known blue-cup_2").size(), 2U);
  EXPECT_TRUE(clausesOf(" ?!, ").empty());
  EXPECT_TRUE(clausesOf("").empty());
}

TEST(Spoken, TagsAreFoundAtTheEndOfWhatIsSaid) {
  EXPECT_TRUE(isTag(spoken("isn't it")));
  EXPECT_TRUE(isTag(spoken("will you")));
  EXPECT_FALSE(isTag(spoken("is it open")));
  EXPECT_EQ(tagAtBack(spoken("the phone isn't on the sofa is it")), 2U);
  EXPECT_EQ(tagAtBack(spoken("the phone is on the sofa isn't it")), 3U);
  EXPECT_EQ(tagAtBack(spoken("what colour is it")), 0U);
  EXPECT_EQ(tagAtBack(spoken("the phone where is it")), 0U);
}

TEST(Spoken, ADoubtIsDroppedButNoNegation) {
  const auto without = [](const std::string& text, bool tagged) {
    Words words = spoken(text);
    dropDoubt(words, tagged);
    return words;
  };
  EXPECT_EQ(without("isn't the oven on", false), (Words{"is", "the", "oven", "on"}));
  EXPECT_EQ(without("the oven isn't on", true), (Words{"the", "oven", "is", "on"}));
  EXPECT_EQ(without("the oven isn't on", false), (Words{"the", "oven", "is", "not", "on"}));
  EXPECT_EQ(without("don't bring me the cup", false), (Words{"do", "not", "bring", "me", "the", "cup"}));
  EXPECT_EQ(without("which cups aren't white", false), (Words{"which", "cups", "are", "not", "white"}));
}

}  // namespace
}  // namespace oikos::semantic
