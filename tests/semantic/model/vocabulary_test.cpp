// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/vocabulary.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/enum_table_check.h"

namespace oikos::semantic {
namespace {

constexpr std::array<TermKind, 5> kKinds{TermKind::kRoomType, TermKind::kObjectType, TermKind::kAffordance, TermKind::kColor,
                                         TermKind::kSurplus};

TEST(Vocabulary, FindsNamesAndSynonymsOfTheirKindOnly) {
  const Vocabulary words = builtInVocabulary();
  ASSERT_NE(words.find(TermKind::kObjectType, "mug"), nullptr);
  EXPECT_EQ(words.find(TermKind::kObjectType, "mug")->name, "cup");
  EXPECT_EQ(words.find(TermKind::kObjectType, "cup")->name, "cup");
  EXPECT_EQ(words.find(TermKind::kColor, "mug"), nullptr);
  EXPECT_EQ(words.find(TermKind::kColor, "gray")->name, "grey");
}

TEST(Vocabulary, ANameGoesBeforeASynonym) {
  Vocabulary words;
  words.add(TermKind::kColor, {"violet", {"purple"}});
  words.add(TermKind::kColor, {"purple", {}});
  EXPECT_EQ(words.find(TermKind::kColor, "purple")->name, "purple");
}

TEST(Vocabulary, AHomesWordsComeOnTop) {
  Vocabulary words = builtInVocabulary();
  const std::size_t before = words.object_types.size();
  words.add(TermKind::kObjectType, {"cup", {"chalice", "mug"}});
  EXPECT_EQ(words.object_types.size(), before);
  EXPECT_EQ(words.find(TermKind::kObjectType, "chalice")->name, "cup");
  const auto& synonyms = words.find(TermKind::kObjectType, "cup")->synonyms;
  EXPECT_EQ(std::set<std::string>(synonyms.begin(), synonyms.end()).size(), synonyms.size());
}

TEST(Vocabulary, NoBuiltInWordHasTwoMeanings) {
  const Vocabulary words = builtInVocabulary();
  for (const TermKind kind : kKinds) {
    std::set<std::string> seen;
    for (const Term& term : words.of(kind)) {
      EXPECT_TRUE(seen.insert(term.name).second) << term.name;
      for (const std::string& synonym : term.synonyms) {
        EXPECT_TRUE(seen.insert(synonym).second) << synonym;
      }
    }
  }
}

}  // namespace
}  // namespace oikos::semantic
