// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/vocabulary.h"

#include <algorithm>
#include <utility>

namespace oikos::semantic {

namespace {

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

const std::vector<Term>& Vocabulary::of(TermKind kind) const {
  switch (kind) {
    case TermKind::kRoomType:
      return room_types;
    case TermKind::kObjectType:
      return object_types;
    case TermKind::kAffordance:
      return affordances;
    case TermKind::kColor:
      break;
  }
  return colors;
}

std::vector<Term>& Vocabulary::of(TermKind kind) {
  return const_cast<std::vector<Term>&>(std::as_const(*this).of(kind));
}

const Term* Vocabulary::find(TermKind kind, std::string_view word) const {
  const std::vector<Term>& terms = of(kind);
  auto found = std::find_if(terms.begin(), terms.end(), [&](const Term& term) { return term.name == word; });
  if (found == terms.end()) {
    found = std::find_if(terms.begin(), terms.end(), [&](const Term& term) { return contains(term.synonyms, word); });
  }
  return found == terms.end() ? nullptr : &*found;
}

void Vocabulary::add(TermKind kind, const Term& term) {
  std::vector<Term>& terms = of(kind);
  const auto known = std::find_if(terms.begin(), terms.end(), [&](const Term& t) { return t.name == term.name; });
  if (known == terms.end()) {
    terms.push_back(term);
    return;
  }
  for (const std::string& synonym : term.synonyms) {
    if (!contains(known->synonyms, synonym)) {
      known->synonyms.push_back(synonym);
    }
  }
}

Vocabulary builtInVocabulary() {
  return {
      {{"kitchen", {"kitchenette"}},
       {"bathroom", {"bath", "washroom", "toilet", "restroom"}},
       {"living_room", {"lounge", "sitting room", "parlour"}},
       {"bedroom", {}},
       {"dining_room", {}},
       {"hall", {"hallway", "corridor", "entrance"}},
       {"office", {"study"}},
       {"storage", {"storeroom", "pantry", "closet room"}},
       {"balcony", {"terrace"}}},
      {{"table", {"desk"}},
       {"chair", {"seat", "stool"}},
       {"armchair", {}},
       {"sofa", {"couch", "settee"}},
       {"bed", {}},
       {"shelf", {"rack", "bookshelf", "bookcase"}},
       {"cupboard", {"cabinet"}},
       {"closet", {"wardrobe"}},
       {"drawer_unit", {"chest of drawers", "dresser"}},
       {"drawer", {}},
       {"door", {}},
       {"fridge", {"refrigerator", "icebox"}},
       {"freezer", {}},
       {"oven", {}},
       {"cooker", {"stove", "hob"}},
       {"dishwasher", {}},
       {"microwave", {}},
       {"washing_machine", {"washer"}},
       {"sink", {"washbasin", "basin"}},
       {"bathtub", {"tub"}},
       {"cup", {"mug", "beaker"}},
       {"glass", {"tumbler"}},
       {"bowl", {}},
       {"dish", {"plate"}},
       {"bottle", {"flask"}},
       {"container", {"can", "tin", "jar"}},
       {"box", {"carton", "packet"}},
       {"pills_box", {"pillbox", "pills", "medicine", "tablets"}},
       {"book", {}},
       {"phone", {"telephone", "mobile"}},
       {"remote_control", {"remote"}},
       {"keys", {"key"}},
       {"glasses", {"spectacles"}},
       {"pot", {"saucepan"}},
       {"pan", {"frying pan"}},
       {"fork", {}},
       {"knife", {}},
       {"spoon", {}}},
      {{"supporting_surface", {"put things on"}},
       {"graspable", {"grasp", "hold"}},
       {"sittable", {"sit on"}},
       {"openable", {"open"}},
       {"container", {"store things in"}},
       {"drinkable_from", {"drink from"}},
       {"cooling", {"keep things cold"}},
       {"heating", {"heat", "cook with"}}},
      {{"red", {"crimson", "scarlet"}},
       {"green", {}},
       {"blue", {"navy", "azure"}},
       {"yellow", {}},
       {"orange", {}},
       {"brown", {}},
       {"black", {}},
       {"white", {}},
       {"grey", {"gray"}},
       {"silver", {}},
       {"pink", {}},
       {"purple", {"violet"}},
       {"transparent", {"clear"}}},
  };
}

}  // namespace oikos::semantic
