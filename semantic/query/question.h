// SPDX-License-Identifier: Apache-2.0
// A question taken apart. What its words mean in a home is found out later.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "semantic/query/time_phrase.h"

namespace oikos::semantic {

enum class PlaceRelation { kOn, kIn, kUnder, kAt, kFrom, kNear, kLeftOf, kRightOf, kInFrontOf, kBehind, kAbove };
constexpr auto enumTable(PlaceRelation) {
  return std::to_array<base::EnumName<PlaceRelation>>({{PlaceRelation::kOn, "on"},
                                                       {PlaceRelation::kIn, "in"},
                                                       {PlaceRelation::kUnder, "under"},
                                                       {PlaceRelation::kAt, "at"},
                                                       {PlaceRelation::kFrom, "from"},
                                                       {PlaceRelation::kNear, "near"},
                                                       {PlaceRelation::kLeftOf, "left of"},
                                                       {PlaceRelation::kRightOf, "right of"},
                                                       {PlaceRelation::kInFrontOf, "in front of"},
                                                       {PlaceRelation::kBehind, "behind"},
                                                       {PlaceRelation::kAbove, "above"}});
}

struct PlacePhrase;

/// "second", "top", "third from the bottom": counted by height, 0 is the topmost.
struct Ordinal {
  int steps = 0;
  bool from_bottom = false;
  bool middle = false;
  std::string word;  ///< as it was said: labels may have it
};

/// A noun with its attributes: "the second drawer of the cupboard left of the fridge".
struct ThingPhrase {
  std::vector<std::string> words;  ///< attributes, then nouns; empty: anything
  std::optional<Ordinal> ordinal;
  std::optional<bool> open;             ///< "the open doors"
  bool nearest = false;                 ///< to `nearest_to`, or to the robot
  bool furniture = false;               ///< "furniture": no small objects
  bool every = false;                   ///< "every cup": what is asked of it has to hold for each
  bool counted = false;                 ///< "two cups"
  bool either = false;                  ///< joined to `others` by "or": one of them will do
  std::vector<ThingPhrase> nearest_to;  ///< none or one
  std::vector<ThingPhrase> whole;       ///< none or one: that it is a part of, or belongs to
  std::vector<PlacePhrase> places;
  std::vector<ThingPhrase> others;  ///< "the cup and the bowl": what comes after the first "and"
  std::string said;                 ///< its words as they were written, for answers

  [[nodiscard]] bool empty() const {
    return words.empty() && whole.empty() && places.empty() && !nearest && !ordinal && !open && !furniture;
  }
};

struct PlacePhrase {
  PlaceRelation relation = PlaceRelation::kIn;
  ThingPhrase thing;
  bool negated = false;            ///< "not in the kitchen"
  std::vector<PlacePhrase> or_at;  ///< "on the sofa or on the table": one of them will do
};

enum class QuestionKind {
  kWhere,       ///< where is X
  kUsualPlace,  ///< where does X belong
  kContents,    ///< what is on Y; which X are on Y
  kCount,       ///< how many X are on Y
  kIsThere,     ///< is there an X on Y; is X on Y
  kIsState,     ///< is X open; is the oven off
  kWhichState,  ///< which X are open
  kHowFar,      ///< how far is X open
  kSetting,     ///< what is X set to
  kLastSeen,    ///< when did you last see X
  kLastChange,  ///< when was X moved, opened, set
  kChanges,     ///< what changed since T
  kHistory,     ///< history of X
  kStand,       ///< where do I stand to reach X
  kHowOpen,     ///< how do I open X
  kHowGrasp,    ///< how do I grasp X
  kUse,         ///< what can X be used for
  kWhatFor,     ///< what can I sit on
  kFetch,       ///< bring me X
  kProperty,    ///< what colour is X
  kDistance,    ///< how far is X from Y
};

struct Question {
  QuestionKind kind = QuestionKind::kWhere;
  ThingPhrase thing;
  std::optional<ThingPhrase> other;  ///< of kDistance
  std::optional<TimePhrase> time;
  std::string state;     ///< of kIsState and kWhichState: "open", "closed", "on", or the name of a setting; of kLastChange: what it led
                         ///< to, "open" or "closed"; empty: anything
  bool any = false;      ///< of kIsState: one that is so will do ("is any door open"); of kChanges: it was asked whether
  bool all = false;      ///< of kIsState: each has to be so ("are the doors closed"); of kIsThere: all that are called so are there
  std::string property;  ///< of kProperty: its name
  std::vector<std::string> use;  ///< of kWhatFor
};

struct ParsedQuestion {
  std::optional<Question> question;
  std::optional<Question>
      otherwise;              ///< what it means where the home has no answer to `question`: "what is X on" may ask for a setting or a place
  bool is_statement = false;  ///< "the cup is on the table": `question` asks whether it is so
  std::string not_understood;  ///< the word at which it ended, where there is no question
};

/// Controlled English: a kind of question, a thing with attributes, places, a time. Articles and case do not matter.
/// `words`: of the sentence, spoken out (spoken.h), with names of several words joined into one.
[[nodiscard]] ParsedQuestion parseQuestion(const std::vector<std::string>& words);

}  // namespace oikos::semantic
