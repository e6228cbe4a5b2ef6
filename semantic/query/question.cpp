// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "semantic/query/thing_phrase.h"
#include "semantic/query/words.h"

namespace oikos::semantic {

namespace {

using List = std::initializer_list<std::string_view>;

bool isOneOf(std::string_view word, List list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool isSpeaker(std::string_view word) {
  return isOneOf(word, {"i", "you", "we", "one", "he", "she", "they", "it", "robot", "anyone", "anybody", "someone", "somebody", "people"});
}

bool isSeeing(std::string_view word) {
  return isOneOf(
      word, {"see", "saw", "seen", "notice", "noticed", "find", "found", "spot", "spotted", "observe", "observed", "detect", "detected"});
}

/// What a state is called in the answer's code: "open", "closed", or the word itself.
std::string stateNamed(const std::string& word) {
  const auto open = opennessOf(word);
  return open ? (*open ? "open" : "closed") : word;
}

bool isStateWord(const std::string& word) {
  return opennessOf(word).has_value() || isOneOf(word, {"on", "off", "running"});
}

/// Takes words from the front and from the back of what is left.
class Cursor {
 public:
  explicit Cursor(Words words) : words_(words) {}

  [[nodiscard]] bool empty() const { return words_.empty(); }
  [[nodiscard]] Words rest() const { return words_; }
  [[nodiscard]] const std::string& front() const { return words_.front(); }
  [[nodiscard]] const std::string& back() const { return words_.back(); }
  [[nodiscard]] bool startsWith(List sequence) const {
    return words_.size() >= sequence.size() && std::equal(sequence.begin(), sequence.end(), words_.begin());
  }
  void drop(std::size_t count = 1) { words_ = words_.subspan(count); }
  void dropBack(std::size_t count = 1) { words_ = words_.first(words_.size() - count); }

  bool take(List list) {
    return takeIf([&](const std::string& word) { return isOneOf(word, list); });
  }
  template <class Fits>
  bool takeIf(const Fits& fits) {
    if (words_.empty() || !fits(words_.front())) {
      return false;
    }
    drop();
    return true;
  }
  bool takeAll(List sequence) {
    if (!startsWith(sequence)) {
      return false;
    }
    drop(sequence.size());
    return true;
  }
  bool takeBack(List list) {
    if (words_.empty() || !isOneOf(words_.back(), list)) {
      return false;
    }
    dropBack();
    return true;
  }
  /// "the robot", "anyone", "Anna".
  bool takeSpeaker() {
    take({"the"});
    return takeIf(isSpeaker);
  }
  bool takeBe() { return takeIf(isBe); }
  bool takeModal() { return take({"can", "could", "do", "does", "did", "should", "would", "must", "may", "shall", "will", "to"}); }
  /// Where the word stands; the number of words: nowhere.
  [[nodiscard]] std::size_t find(List list) const {
    return static_cast<std::size_t>(
        std::find_if(words_.begin(), words_.end(), [&](const std::string& word) { return isOneOf(word, list); }) - words_.begin());
  }

 private:
  Words words_;
};

class QuestionReader {
 public:
  explicit QuestionReader(Words words) : words_(words) {}

  ParsedQuestion read() {
    skipPoliteness();
    const std::string first = words_.empty() ? "" : words_.front();
    if (readKind() && (!question_.thing.empty() || mayBeOfAnything())) {
      return {std::move(question_), is_statement_, {}};
    }
    return {std::nullopt, false, words_.empty() ? first : words_.front()};
  }

 private:
  [[nodiscard]] bool mayBeOfAnything() const {
    return question_.kind == QuestionKind::kChanges || question_.kind == QuestionKind::kWhatFor ||
           question_.kind == QuestionKind::kWhichState;
  }

  void skipPoliteness() {
    while (words_.take({"please", "hey", "hello", "hi", "ok", "okay", "oikos", "so", "and", "well", "quick", "quickly", "say", "um", "oh",
                        "sorry", "excuse", "thanks"}) ||
           words_.takeAll({"tell", "me"}) || words_.takeAll({"can", "you", "tell", "me"}) || words_.takeAll({"could", "you"}) ||
           words_.takeAll({"would", "you"}) || words_.takeAll({"will", "you"}) || words_.takeAll({"do", "you", "know"}) ||
           words_.takeAll({"do", "you", "remember"}) || words_.takeAll({"any", "idea"}) || words_.takeAll({"i", "wonder"}) ||
           words_.takeAll({"i", "want", "to", "know"}) || words_.takeAll({"let", "me", "know"}) || words_.takeAll({"if"}) ||
           words_.takeAll({"whether"}) || words_.takeAll({"id", "like", "to", "know"}) ||
           words_.takeAll({"i", "would", "like", "to", "know"}) || words_.takeAll({"i", "forgot"}) || words_.takeAll({"remind", "me"})) {
    }
    while (words_.takeBack({"please", "thanks", "again", "then", "exactly", "right"})) {
    }
    if (words_.startsWith({"can", "you"}) && words_.rest().size() > 2 && !isSeeing(words_.rest()[2])) {
      words_.drop(2);
    }
  }

  bool readKind() {
    if (takeTrailingWhere()) {
      return finish(QuestionKind::kWhere);
    }
    if (words_.take({"where", "wheres"})) {
      return readWhere();
    }
    if (words_.takeAll({"from", "where"})) {
      return readStand();
    }
    if (words_.take({"how"})) {
      return readHow();
    }
    if (words_.take({"when"})) {
      return readWhen();
    }
    if (words_.takeAll({"in", "which"}) || words_.takeAll({"in", "what"}) || words_.takeAll({"on", "which"}) ||
        words_.takeAll({"on", "what"})) {
      return readWhichPlace();
    }
    if (words_.take({"what", "which", "whats"})) {
      return readWhat();
    }
    if (words_.takeAll({"number", "of"}) || words_.takeAll({"the", "number", "of"}) || words_.take({"count"})) {
      return finish(QuestionKind::kCount);
    }
    return readYesNo() || readCommand() || readSentence();
  }

  /// "the cup on the table, where is it?"
  bool takeTrailingWhere() {
    const Words rest = words_.rest();
    const std::size_t size = rest.size();
    if (size > 3 && rest[size - 3] == "where" && isBe(rest[size - 2]) && isOneOf(rest[size - 1], {"it", "they", "that", "those"})) {
      words_.dropBack(3);
      return true;
    }
    return false;
  }

  bool finish(QuestionKind kind) {
    question_.kind = kind;
    while (words_.takeBack({"there", "anywhere", "somewhere"}) ||
           (words_.rest().size() > 1 && isBe(words_.back()) && (words_.dropBack(), true))) {
    }
    if (words_.empty()) {
      return false;
    }
    question_.thing = readThingPhrase(words_.rest());
    return true;
  }

  /// After "where".
  bool readWhere() {
    if (words_.takeAll({"have", "you"}) || words_.takeAll({"did", "you"}) || words_.takeAll({"has", "anyone"})) {
      words_.take({"last", "ever"});
      words_.takeIf(isSeeing) || words_.take({"put", "leave", "left"});
      words_.takeBack({"last", "before"});
      return finish(QuestionKind::kWhere);
    }
    did_ = words_.startsWith({"did"});
    const bool modal = words_.takeModal();
    const bool speaker = words_.takeSpeaker();
    if (modal && speaker) {
      words_.take({"last", "usually", "normally"});
      if (words_.take({"stand", "park", "go", "be", "drive", "position", "stay", "wait", "place", "move"}) && words_.take({"to", "for"})) {
        return readStandGoal();
      }
      if (words_.take({"put", "store", "return"})) {
        words_.takeBack({"back", "away"});
        return finish(did_ ? QuestionKind::kWhere : QuestionKind::kUsualPlace);
      }
      words_.takeIf(isSeeing) || words_.take({"leave", "left", "put", "get", "have", "keep"});
      words_.takeBack({"last"});
      return finish(QuestionKind::kWhere);
    }
    if (words_.takeBack({"belong", "belongs"})) {
      words_.takeIf(isBe);
      return finish(QuestionKind::kUsualPlace);
    }
    if (modal && words_.takeBack({"go", "live", "stay"})) {
      return finish(did_ ? QuestionKind::kWhere : QuestionKind::kUsualPlace);
    }
    words_.takeBe() || words_.take({"has", "have", "might", "would", "could", "can", "should"});
    words_.takeBack({"gone", "hiding", "located", "kept", "standing", "be", "found", "been"});
    if (words_.takeBack({"usually", "normally", "supposed", "meant"}) || takeWord({"usually", "normally"})) {
      words_.takeBack({"kept", "stored"});
      return finish(QuestionKind::kUsualPlace);
    }
    return finish(QuestionKind::kWhere);
  }

  /// Somewhere among the words.
  bool takeWord(List list) {
    if (const std::size_t position = words_.find(list); position < words_.rest().size()) {
      edited_.assign(words_.rest().begin(), words_.rest().end());
      edited_.erase(edited_.begin() + static_cast<std::ptrdiff_t>(position));
      words_ = Cursor(edited_);
      return true;
    }
    return false;
  }

  bool readStand() {
    words_.takeModal();
    words_.takeSpeaker();
    return readStandGoal();
  }

  /// "reach X", "see what is in X".
  bool readStandGoal() {
    if (!words_.take({"see", "reach", "open", "close", "look", "grasp", "get", "use", "grab", "view", "take", "pick", "access", "inspect",
                      "watch", "at"})) {
      return false;
    }
    words_.take({"at", "into", "up", "inside"});
    if (words_.take({"what"})) {
      words_.takeBe() || words_.take({"lies", "stands"});
      if (const auto relation = findRelationWords(words_.rest()); relation) {
        words_.drop(relation->count);
      }
    }
    return finish(QuestionKind::kStand);
  }

  /// After "how".
  bool readHow() {
    if (words_.take({"many", "much"})) {
      return readCount();
    }
    if (words_.takeAll({"long", "ago"})) {
      return readWhen();
    }
    if (words_.take({"far", "wide"})) {
      return readHowFar();
    }
    if (words_.takeBe()) {
      if (words_.takeBack({"opened", "open"})) {
        return finish(QuestionKind::kHowOpen);
      }
      if (words_.takeBack({"grasped", "held", "grabbed"})) {
        return finish(QuestionKind::kHowGrasp);
      }
      return words_.takeBack({"set"}) && finish(QuestionKind::kSetting);
    }
    if (!words_.takeModal()) {
      return false;
    }
    words_.takeSpeaker();
    if (words_.take({"open", "close", "shut", "unlock"})) {
      return finish(QuestionKind::kHowOpen);
    }
    if (words_.take({"grasp", "hold", "grab", "grip", "lift", "take"}) || words_.takeAll({"pick", "up"})) {
      words_.takeBack({"up"});
      return finish(QuestionKind::kHowGrasp);
    }
    if (words_.takeAll({"get", "to"}) || words_.take({"reach", "approach"})) {
      return finish(QuestionKind::kStand);
    }
    return words_.take({"get", "fetch", "bring"}) && finish(QuestionKind::kFetch);
  }

  /// After "how many": "X", "X are there", "X are on Y", "X does Y have", "X do we have", "X are open".
  bool readCount() {
    const std::size_t verb = words_.find({"is", "are", "was", "were", "do", "does", "did", "can", "have", "has", "lie", "stand", "sit"});
    const Words noun = words_.rest().first(verb);
    words_.drop(verb);
    const bool modal = words_.takeModal();
    if (modal && words_.takeBack({"have", "contain", "hold", "own"}) && !words_.empty() && !isSpeaker(words_.front())) {
      question_.kind = QuestionKind::kCount;
      question_.thing = readThingPhrase(noun);
      question_.thing.whole.push_back(readThingPhrase(words_.rest()));
      return !noun.empty();
    }
    if (modal) {
      words_.takeSpeaker();
      words_.take({"have", "see", "own"});
      words_.take({"got"});
    } else if (!words_.takeBe()) {
      words_.take({"have", "has", "lie", "stand", "sit"});
    }
    words_.take({"there"});
    edited_.assign(noun.begin(), noun.end());
    if (!words_.empty()) {
      edited_.emplace_back("that");
    }
    edited_.insert(edited_.end(), words_.rest().begin(), words_.rest().end());
    words_ = Cursor(edited_);
    words_.takeBack({"that", "have", "got"});
    return !noun.empty() && finish(QuestionKind::kCount);
  }

  /// After "how far": "is X open", "open is X", "is X from Y".
  bool readHowFar() {
    if (words_.take({"away"})) {
      words_.takeBe();
    }
    words_.take({"open", "opened"});
    words_.takeBe() || words_.take({"did"});
    const std::size_t from = words_.find({"from"});
    if (from > 0 && from + 1 < words_.rest().size()) {
      question_.other = readThingPhrase(words_.rest().subspan(from + 1));
      words_ = Cursor(words_.rest().first(from));
      words_.takeBack({"away"});
      return finish(QuestionKind::kDistance);
    }
    while (words_.takeBack({"open", "opened", "out", "pulled", "ajar", "closed", "shut", "turned"})) {
    }
    return finish(QuestionKind::kHowFar);
  }

  /// After "when".
  bool readWhen() {
    if (!words_.takeModal() && !words_.takeBe()) {
      words_.take({"have", "has"});
    }
    words_.takeSpeaker();
    words_.take({"last"});
    if (words_.takeIf(isSeeing)) {
      words_.takeBack({"last"});
      return finish(QuestionKind::kLastSeen);
    }
    if (words_.take({"move", "open", "close", "change", "moved", "opened", "closed", "changed", "use", "used"})) {
      return finish(QuestionKind::kLastChange);
    }
    words_.takeBack({"last"});
    if (!words_.empty() && isSeeing(words_.back())) {
      words_.dropBack();
      words_.takeBack({"last"});
      return finish(QuestionKind::kLastSeen);
    }
    if (words_.takeBack({"moved", "opened", "closed", "changed", "set", "used", "shut", "move", "change", "put", "open"})) {
      words_.takeBack({"last", "been"});
      return finish(QuestionKind::kLastChange);
    }
    return false;
  }

  /// After "in which": "room is X".
  bool readWhichPlace() {
    const std::size_t be = words_.find({"is", "are", "was", "were", "do", "did", "can"});
    if (be == words_.rest().size()) {
      return false;
    }
    words_.drop(be + 1);
    words_.takeSpeaker();
    words_.take({"keep", "find", "put", "leave"});
    return finish(QuestionKind::kWhere);
  }

  /// After "what" or "which".
  bool readWhat() {
    words_.take({"else", "exactly"});
    if (readChanges() || readUses() || readSettings()) {
      return true;
    }
    if (words_.takeAll({"is", "the", "history", "of"}) || words_.takeAll({"history", "does"})) {
      words_.takeBack({"have"});
      return finish(QuestionKind::kHistory);
    }
    if (readProperty()) {
      return true;
    }
    if (const bool does = words_.startsWith({"does"}) || words_.startsWith({"did"});
        does && (words_.rest().back() == "contain" || words_.rest().back() == "hold" || words_.rest().back() == "have")) {
      words_.drop();
      words_.dropBack();
      return finishContents({}, {{PlaceRelation::kIn, readThingPhrase(words_.rest())}});
    }
    return readContents();
  }

  /// "has changed", "things have moved", "is new", "happened".
  bool readChanges() {
    Cursor ahead = words_;
    const std::size_t verb = ahead.find({"changed", "change", "moved", "move", "happened", "happen", "new", "different"});
    if (verb == ahead.rest().size()) {
      return false;
    }
    const Words noun = ahead.rest().first(verb);
    const bool only_helpers = std::all_of(noun.begin(), noun.end(), [](const std::string& word) {
      return isBe(word) || isOneOf(word, {"has", "have", "did", "been", "things", "objects", "all", "everything", "anything", "of", "the"});
    });
    ahead.drop(verb + 1);
    const bool at_end = ahead.empty() || findRelationWords(ahead.rest());
    if (!at_end || (!only_helpers && !isOneOf(words_.rest()[verb], {"changed", "moved"}))) {
      return false;
    }
    question_.kind = QuestionKind::kChanges;
    edited_.clear();
    std::copy_if(noun.begin(), noun.end(), std::back_inserter(edited_), [](const std::string& word) {
      return !isBe(word) && !isOneOf(word, {"has", "have", "did", "been"});
    });
    edited_.insert(edited_.end(), ahead.rest().begin(), ahead.rest().end());
    question_.thing = readThingPhrase(edited_);
    return true;
  }

  /// "can X be used for", "is X good for", "can I sit on".
  bool readUses() {
    if (!words_.empty() && words_.back() == "for" && words_.rest().size() > 2) {
      words_.dropBack();
      words_.takeBack({"used", "good", "useful", "made"});
      words_.takeBack({"be"});
      words_.takeModal() || words_.takeBe();
      words_.takeSpeaker() && words_.take({"use"});
      return finish(QuestionKind::kUse);
    }
    Cursor ahead = words_;
    while (ahead.take({"things", "objects", "furniture", "thing", "object"})) {
    }
    if (!ahead.take({"can", "could"}) || !ahead.takeSpeaker() || ahead.empty()) {
      return false;
    }
    if (ahead.takeAll({"do", "with"})) {
      words_ = ahead;
      return finish(QuestionKind::kUse);
    }
    if (isSeeing(ahead.front())) {
      return false;
    }
    question_.kind = QuestionKind::kWhatFor;
    question_.use.assign(ahead.rest().begin(), ahead.rest().end());
    return true;
  }

  /// "is X set to", "is X at", "temperature is X set to", "is the temperature of X".
  bool readSettings() {
    if (words_.rest().size() < 3) {
      return false;
    }
    const Words rest = words_.rest();
    const bool set_to = isOneOf(rest.back(), {"to", "at", "on"}) && isOneOf(rest[rest.size() - 2], {"set", "turned", "switched"});
    const bool is_at = isBe(rest.front()) && rest.back() == "at";
    const std::size_t be = words_.find({"is", "are", "was", "were"});
    const bool named = be == 1 && isOneOf(rest.front(), {"program", "programme", "temperature", "setting", "level", "mode"});
    if (set_to || is_at || (named && isOneOf(rest.back(), {"on", "at", "in", "to", "set"}))) {
      words_.drop(std::min(be + 1, rest.size()));
      while (words_.takeBack({"to", "at", "set", "turned", "switched", "on", "in"})) {
      }
      return finish(QuestionKind::kSetting);
    }
    if (isBe(rest.front()) && rest[1] == "the" && isOneOf(rest[2], {"setting", "temperature", "program", "state", "level", "position"}) &&
        rest.size() > 4 && isOneOf(rest[3], {"of", "in"})) {
      words_.drop(4);
      return finish(QuestionKind::kSetting);
    }
    return false;
  }

  /// "colour is X", "is the colour of X".
  bool readProperty() {
    const auto property = [](const std::string& word) -> std::string {
      return isOneOf(word, {"colour", "color", "colors", "colours"})   ? "color"
             : isOneOf(word, {"content", "contents"})                  ? "content"
             : isOneOf(word, {"type", "kind", "size", "owner"})        ? word
             : isOneOf(word, {"material", "brand", "weight", "shape"}) ? word
                                                                       : "";
    };
    Cursor ahead = words_;
    if (ahead.rest().size() > 2 && !property(ahead.front()).empty() && isBe(ahead.rest()[1])) {
      question_.property = property(ahead.front());
      words_.drop(2);
      return finish(QuestionKind::kProperty);
    }
    if (ahead.takeBe() && ahead.take({"the"}) && ahead.rest().size() > 2 && !property(ahead.front()).empty() && ahead.rest()[1] == "of") {
      question_.property = property(ahead.front());
      words_.drop(4);
      return finish(QuestionKind::kProperty);
    }
    return false;
  }

  bool finishContents(const ThingPhrase& thing, const std::vector<PlacePhrase>& places) {
    question_.kind = QuestionKind::kContents;
    question_.thing = thing;
    question_.thing.places.insert(question_.thing.places.end(), places.begin(), places.end());
    return true;
  }

  /// "is on Y", "X are on Y", "X are open", "cup is nearest to Y", "room is X in", "is X".
  bool readContents() {
    const std::size_t verb =
        words_.find({"is", "are", "was", "were", "lies", "stands", "lie", "stand", "sits", "sit", "do", "did", "have", "can"});
    if (verb == words_.rest().size()) {
      return false;
    }
    const Words noun = words_.rest().first(verb);
    words_.drop(verb);
    if (words_.takeModal() || words_.take({"have"})) {
      words_.takeSpeaker();
      words_.take({"have", "see", "got", "find", "keep", "own"});
      words_.take({"got"});
    } else {
      words_.drop();
    }
    words_.take({"there"});
    if (words_.empty()) {
      return false;
    }
    const bool ends_with_place = words_.rest().size() > 1 && isOneOf(words_.back(), {"in", "on", "under", "at", "inside"});
    if (ends_with_place) {  // "which room is the cup in"
      words_.dropBack();
      return finish(QuestionKind::kWhere);
    }
    if (words_.rest().size() == 1 && isStateWord(words_.front())) {
      question_.kind = QuestionKind::kWhichState;
      question_.state = stateNamed(words_.front());
      question_.thing = readThingPhrase(noun);
      return true;
    }
    const bool says_place =
        findRelationWords(words_.rest()).has_value() || isOneOf(words_.front(), {"lying", "standing", "kept", "stored", "sitting"});
    edited_.assign(noun.begin(), noun.end());
    edited_.insert(edited_.end(), words_.rest().begin(), words_.rest().end());
    words_ = Cursor(edited_);
    if (says_place) {
      return finish(QuestionKind::kContents);
    }
    return finish(QuestionKind::kWhere);
  }

  /// "is X open", "is there an X on Y", "is X on Y", "do we have X", "did I leave X on".
  bool readYesNo() {
    if (!words_.empty() && isBe(words_.front())) {
      question_.all = isOneOf(words_.front(), {"are", "were"});
      words_.drop();
      question_.any = !words_.empty() && isOneOf(words_.front(), {"any", "anything", "something", "one", "some"});
      return readIs() && (!question_.thing.words.empty() || question_.kind != QuestionKind::kIsState || askWhetherAny());
    }
    if (words_.takeAll({"do", "we"}) || words_.takeAll({"have", "we"}) || words_.takeAll({"do", "i"}) || words_.takeAll({"have", "i"})) {
      words_.take({"have", "got", "own"});
      words_.take({"got"});
      return finish(QuestionKind::kIsThere);
    }
    if (words_.startsWith({"have", "you"}) || words_.startsWith({"did", "you"}) || words_.startsWith({"can", "you"}) ||
        words_.startsWith({"do", "you"}) || words_.startsWith({"has", "anyone"}) || words_.startsWith({"did", "anyone"}) ||
        words_.startsWith({"has", "anybody"}) || words_.startsWith({"has", "someone"}) || words_.startsWith({"did", "someone"})) {
      words_.drop(2);
      if (words_.take({"move", "moved", "change", "changed", "touch", "touched", "open", "opened", "close", "closed", "use", "used"})) {
        return finish(QuestionKind::kLastChange);
      }
      words_.take({"ever", "last"});
      return words_.takeIf(isSeeing) && finish(QuestionKind::kWhere);
    }
    if (words_.takeAll({"did", "i"}) || words_.takeAll({"did", "we"}) || words_.takeAll({"have", "i"})) {
      return readLeft();
    }
    if (words_.take({"does", "did", "has", "have"})) {
      if (words_.takeBack({"move", "moved", "change", "changed", "opened", "closed", "touched", "used"})) {
        words_.takeBack({"been"});
        return finish(QuestionKind::kLastChange);
      }
      const std::size_t verb = words_.find({"contain", "have", "hold"});
      if (verb > 0 && verb + 1 < words_.rest().size()) {
        question_.kind = QuestionKind::kIsThere;
        question_.thing = readThingPhrase(words_.rest().subspan(verb + 1));
        question_.thing.places.push_back({PlaceRelation::kIn, readThingPhrase(words_.rest().first(verb))});
        return true;
      }
    }
    return false;
  }

  /// After "did I": "leave X on", "close X", "turn off X".
  bool readLeft() {
    question_.kind = QuestionKind::kIsState;
    if (words_.take({"close", "shut"})) {
      question_.state = "closed";
    } else if (words_.take({"open"})) {
      question_.state = "open";
    } else if (words_.take({"turn", "switch", "turned", "switched"})) {
      const bool off = words_.takeBack({"off"}) || words_.take({"off"});
      question_.state = off ? "off" : "on";
      words_.takeBack({"on"}) || words_.take({"on"});
    } else if (words_.take({"leave", "left"}) && words_.rest().size() > 1 && isStateWord(words_.back())) {
      question_.state = stateNamed(words_.back());
      words_.dropBack();
    } else {
      return !words_.empty() && finish(QuestionKind::kIsThere);
    }
    return finish(QuestionKind::kIsState);
  }

  /// After "is".
  bool readIs() {
    if (words_.take({"there"})) {
      return finish(QuestionKind::kIsThere);
    }
    while (words_.takeBack({"still", "already", "yet", "properly", "fully"})) {
    }
    const Words rest = words_.rest();
    if (rest.size() > 1 && isStateWord(rest.back())) {
      question_.state = stateNamed(rest.back());
      words_.dropBack();
      words_.takeBack({"turned", "switched", "still", "wide", "already", "left", "standing"});
      return finish(QuestionKind::kIsState);
    }
    const std::size_t set = words_.find({"set", "turned", "switched"});
    if (set > 0 && set + 2 < rest.size() && isOneOf(rest[set + 1], {"to", "at", "on"})) {
      for (const std::string& word : rest.subspan(set + 2)) {
        question_.state += (question_.state.empty() ? "" : " ") + word;
      }
      words_ = Cursor(rest.first(set));
      return finish(QuestionKind::kIsState);
    }
    return finish(QuestionKind::kIsThere);
  }

  /// "is anything open".
  bool askWhetherAny() {
    question_.kind = QuestionKind::kIsThere;
    question_.thing.open = question_.state == "open";
    return question_.state == "open" || question_.state == "closed";
  }

  bool readCommand() {
    if (words_.take({"bring", "fetch", "get", "give", "hand", "carry", "deliver", "grab"})) {
      words_.take({"me", "us", "him", "her"});
      words_.takeBack({"me", "us"}) && words_.takeBack({"to", "for"});
      return finish(QuestionKind::kFetch);
    }
    if (words_.takeAll({"i", "need"}) || words_.takeAll({"i", "want"}) || words_.takeAll({"i", "would", "like"}) ||
        words_.takeAll({"id", "like"}) || words_.takeAll({"can", "i", "have"}) || words_.takeAll({"could", "i", "have"})) {
      return finish(QuestionKind::kFetch);
    }
    if (words_.takeAll({"history", "of"}) || words_.takeAll({"the", "history", "of"}) ||
        words_.takeAll({"show", "me", "the", "history", "of"}) || words_.takeAll({"show", "the", "history", "of"})) {
      return finish(QuestionKind::kHistory);
    }
    if (words_.takeAll({"show", "me", "where"}) || words_.takeAll({"show", "where"})) {
      return readWhere();
    }
    if (words_.takeAll({"show", "me"}) || words_.takeAll({"look", "for"}) || words_.takeAll({"search", "for"}) ||
        words_.takeAll({"im", "looking", "for"}) || words_.takeAll({"i", "am", "looking", "for"}) || words_.takeAll({"looking", "for"}) ||
        words_.takeAll({"i", "cant", "find"}) || words_.takeAll({"i", "cannot", "find"}) || words_.takeAll({"i", "lost"}) ||
        words_.takeAll({"ive", "lost"}) || words_.takeAll({"i", "have", "lost"}) || words_.takeAll({"i", "misplaced"}) ||
        words_.takeAll({"help", "me", "find"}) || words_.take({"find", "locate", "show", "list", "seen"})) {
      words_.takeAll({"all", "of"}) || words_.take({"all"});
      return finish(QuestionKind::kWhere);
    }
    return words_.takeAll({"anything", "new"}) && readNews();
  }

  bool readNews() {
    question_.kind = QuestionKind::kChanges;
    question_.thing = readThingPhrase(words_.rest());
    return true;
  }

  /// "X is on Y"; "nearest X to Y"; a noun alone.
  bool readSentence() {
    const std::size_t be = words_.find({"is", "are"});
    if (be > 0 && be + 1 < words_.rest().size()) {
      is_statement_ = true;
      edited_.assign(words_.rest().begin(), words_.rest().end());
      edited_.erase(edited_.begin() + static_cast<std::ptrdiff_t>(be));
      if (edited_.size() > 1 && isStateWord(edited_.back())) {
        words_ = Cursor(edited_);
        return readIs();
      }
      if (findRelationWords(Words(edited_).subspan(be))) {
        words_ = Cursor(edited_);
        return finish(QuestionKind::kIsThere);
      }
      is_statement_ = false;
      return false;
    }
    const std::size_t nearest = words_.find({"nearest", "closest"});
    return nearest < std::min<std::size_t>(words_.rest().size(), 2) && finish(QuestionKind::kWhere);
  }

  Cursor words_;
  Question question_;
  std::vector<std::string> edited_;
  bool is_statement_ = false;
  bool did_ = false;  ///< "where did …"
};

}  // namespace

ParsedQuestion parseQuestion(const std::vector<std::string>& words) {
  TimeReading reading = readTime(words);
  ParsedQuestion parsed = QuestionReader(reading.rest).read();
  if (parsed.question) {
    parsed.question->time = std::move(reading.time);
  }
  return parsed;
}

}  // namespace oikos::semantic
