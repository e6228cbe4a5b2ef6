// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/words.h"

#include <gtest/gtest.h>

#include <utility>

namespace oikos::semantic {
namespace {

using Words = std::vector<std::string>;

TEST(Words, OfASentence) {
  EXPECT_EQ(wordsOf("Where is the BLUE cup?"), (Words{"where", "is", "the", "blue", "cup"}));
  EXPECT_EQ(wordsOf("what's on Anna's table"), (Words{"what", "is", "on", "anna", "'s", "table"}));
  EXPECT_EQ(wordsOf("blue-cup_2"), (Words{"blue", "cup", "2"}));
  EXPECT_EQ(wordsOf(std::string_view("cup\0bowl", 8)), (Words{"cup", "bowl"}));
  EXPECT_EQ(wordsOf("caf\xC3\xA9"), (Words{"caf\xC3\xA9"}));
  EXPECT_TRUE(wordsOf(" ?!").empty());
}

TEST(Words, AreLimitedInNumber) {
  std::string sentence;
  for (int i = 0; i < 100000; ++i) {
    sentence += "cup ";
  }
  EXPECT_EQ(wordsOf(sentence).size(), kMostWords + 1);
}

TEST(Words, Singular) {
  for (const auto& [plural, singular] : {std::pair("cups", "cup"),
                                         {"dishes", "dish"},
                                         {"knives", "knife"},
                                         {"glasses", "glass"},
                                         {"glass", "glass"},
                                         {"boxes", "box"},
                                         {"shelves", "shelf"},
                                         {"batteries", "battery"},
                                         {"keys", "key"},
                                         {"drawers", "drawer"},
                                         {"bus", "bus"},
                                         {"gas", "gas"}}) {
    EXPECT_EQ(singularOf(plural), singular);
  }
}

}  // namespace
}  // namespace oikos::semantic
