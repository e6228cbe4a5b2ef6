// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/vocabulary.h"

#include <algorithm>
#include <utility>

namespace oikos::semantic {

namespace {

constexpr double kSecondsPerHour = 3600.0;
constexpr double kUnknownStaysFor_h = 168.0;

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
  known->stays_for_h = term.stays_for_h ? term.stays_for_h : known->stays_for_h;
}

double Vocabulary::halfLife_s(std::string_view object_type) const {
  const Term* const term = find(TermKind::kObjectType, object_type);
  return kSecondsPerHour * (term == nullptr ? kUnknownStaysFor_h : term->stays_for_h.value_or(kUnknownStaysFor_h));
}

/// How long objects stay is a guess for a household of two; a home says better for its own.

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
       {"cup", {"mug", "beaker"}, 24.0},
       {"glass", {"tumbler"}, 24.0},
       {"bowl", {}, 24.0},
       {"dish", {"plate"}, 24.0},
       {"bottle", {"flask"}, 24.0},
       {"container", {"can", "tin", "jar"}},
       {"box", {"carton", "packet"}},
       {"pills_box", {"pillbox", "pills", "medicine", "tablets"}, 48.0},
       {"book", {}},
       {"phone", {"telephone", "mobile"}, 6.0},
       {"remote_control", {"remote"}, 12.0},
       {"keys", {"key"}, 12.0},
       {"glasses", {"spectacles"}, 6.0},
       {"pot", {"saucepan"}, 48.0},
       {"pan", {"frying pan"}, 48.0},
       {"fork", {}, 24.0},
       {"knife", {}, 24.0},
       {"spoon", {}, 24.0}},
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
