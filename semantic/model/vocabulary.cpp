// SPDX-License-Identifier: Apache-2.0
#include "semantic/model/vocabulary.h"

#include <algorithm>
#include <utility>

namespace oikos::semantic {

namespace {

constexpr double kSecondsPerHour = 3600.0;
constexpr double kUnknownStaysFor_h = 168.0;

/// In full: "i do not know" is "I don't know" as well.
std::vector<Term> builtInSurplus() {
  return {
      {"hello", {"hi", "hey", "hey there", "hi there", "good morning", "good afternoon", "good evening", "good day", "greetings"}},
      {"please", {"kindly", "if you please", "if you would", "if you can", "if possible", "if you do not mind", "for me"}},
      {"thanks", {"thank you", "thank you very much", "many thanks", "cheers", "ta"}},
      {"sorry", {"excuse me", "sorry to bother you", "sorry to disturb you", "pardon", "pardon me", "um", "uh", "oh", "ah", "hm", "er"}},
      {"ok", {"okay", "so", "and", "well", "right", "now then", "listen", "say", "anyway", "by the way", "then", "again", "also", "but"}},
      {"quick", {"quickly", "hurry", "hurry up", "quick question", "asap", "right away", "at once", "immediately"}},
      {"dear",
       {"darling", "sweetheart", "honey", "love", "my dear", "my love", "my friend", "mate", "buddy", "pal", "sir", "madam", "dude"}},
      {"robot", {"oikos", "dear robot", "hello robot", "good robot"}},
      {"tell_me",
       {"tell us",
        "could you",
        "would you",
        "will you",
        "can you please",
        "can you possibly",
        "can you tell me",
        "can anyone tell me",
        "can anybody tell me",
        "can someone tell me",
        "can somebody tell me",
        "could anyone tell me",
        "could someone tell me",
        "be so kind as to",
        "would you be so kind as to",
        "be so good as to",
        "would you be so good as to",
        "would you mind telling me",
        "would it be possible to",
        "do me a favour",
        "do me a favor",
        "would you mind",
        "possibly",
        "let me know",
        "remind me",
        "help me",
        "can you help me",
        "just",
        "just tell me",
        "show me if",
        "say if"}},
      {"do_you_know",
       {"do you happen to know",
        "do you remember",
        "do you recall",
        "does anyone know",
        "does anybody know",
        "does someone know",
        "who knows",
        "do you think",
        "any idea",
        "any clue",
        "an idea",
        "do you have any idea",
        "do you have an idea",
        "have you any idea",
        "have you got any idea",
        "have you got an idea",
        "got any idea",
        "would you know",
        "would anyone know",
        "would anybody know",
        "would you happen to know",
        "you know"}},
      {"i_wonder",
       {"i was wondering",
        "i am wondering",
        "i want to know",
        "i would like to know",
        "i would love to know",
        "i need to know",
        "i have to know",
        "i must know",
        "i forgot",
        "i forget",
        "i have forgotten",
        "i do not know",
        "i do not remember",
        "i have no idea",
        "no idea",
        "i am not sure",
        "not sure",
        "can i ask",
        "may i ask",
        "could i ask",
        "can i ask you",
        "may i ask you"}},
      {"if",
       {"whether", "check if", "check whether", "see if", "see whether", "find out if", "find out whether", "look if", "look whether",
        "make sure that", "find out", "have a look if", "have a look whether", "take a look if", "take a look whether"}},
      {"or_not", {"or what", "or something", "or so", "do not you", "i guess", "i suppose", "i think", "i believe", "i hope"}},
      {"exactly", {"precisely",        "in total",      "surely",        "altogether",     "all together",    "in all",
                   "all in all",       "at all",        "by any chance", "by chance",      "actually",        "though",
                   "perhaps",          "maybe",         "for breakfast", "for lunch",      "for dinner",      "for supper",
                   "how does it work", "if so what",    "if so which",   "and if so what", "and if so which", "how does that work",
                   "which one is it",  "be a dear and", "be a love and", "be so kind and", "be so good and"}},
      {"correct", {"yes", "is that right", "is that correct", "am i right", "eh", "huh"}}};
}

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
      return colors;
    case TermKind::kSurplus:
      break;
  }
  return surplus;
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
       {"door", {"room door", "interior door"}},
       {"fridge", {"refrigerator", "icebox"}},
       {"freezer", {}},
       {"oven", {}},
       {"cooker", {"stove", "hob"}},
       {"dishwasher", {}},
       {"microwave", {}},
       {"washing_machine", {"washer"}},
       {"sink", {"washbasin", "basin"}},
       {"bathtub", {"tub"}},
       {"tv", {"television", "telly"}},
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
      builtInSurplus(),
  };
}

}  // namespace oikos::semantic
