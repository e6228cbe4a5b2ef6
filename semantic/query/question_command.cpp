// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_kinds.h"

#include "semantic/query/grammar_words.h"
#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

bool readNews(QuestionDraft& draft) {
  draft.question.kind = QuestionKind::kChanges;
  draft.question.thing = readThingPhrase(draft.words.rest());
  return true;
}

/// "I cannot find X", "I am looking for X".
bool takeSearch(WordCursor& words) {
  WordCursor ahead = words;
  const bool of_speaker = ahead.take({"i", "we"});
  if (of_speaker) {
    ahead.take({"have", "am", "are", "still"});
    const bool seems = ahead.takeAll({"cant", "seem", "to"}) || ahead.takeAll({"cannot", "seem", "to"});
    if (seems && ahead.take({"find", "see"})) {
      words = ahead;
      return true;
    }
  }
  const bool searches = ahead.takeAll({"looking", "for"}) || ahead.takeAll({"searching", "for"}) || ahead.takeAll({"look", "for"}) ||
                        ahead.takeAll({"search", "for"});
  const bool lost =
      of_speaker && (ahead.takeAll({"cant", "find"}) || ahead.takeAll({"cannot", "find"}) || ahead.takeAll({"can", "not", "find"}) ||
                     ahead.takeAll({"can", "not", "see"}) || ahead.takeAll({"cant", "see"}) || ahead.take({"lost", "misplaced"}));
  words = searches || lost ? ahead : words;
  return searches || lost;
}

bool takeWish(WordCursor& words) {
  return words.takeAll({"i", "need"}) || words.takeAll({"i", "want"}) || words.takeAll({"i", "would", "like"}) ||
         words.takeAll({"i", "would", "love"}) || words.takeAll({"can", "i", "have"}) || words.takeAll({"could", "i", "have"}) ||
         words.takeAll({"may", "i", "have"}) || words.takeAll({"we", "need"}) || words.takeAll({"we", "want"}) ||
         words.takeAll({"i", "am", "after"}) || words.takeAll({"i", "could", "use"});
}

/// "over here" is where the speaker is.
void takeHere(WordCursor& words) {
  words.takeAllBack({"over", "here"}) || words.takeBack({"here"});
}

/// "me", "Jonas his".
void takeReceiver(WordCursor& words) {
  if (words.take({"me", "us", "him", "her", "them"})) {
    return;
  }
  const Words rest = words.rest();
  if (rest.size() > 2 && isOneOf(rest[1], {"his", "her", "their"}) && !isFiller(rest[0])) {
    words.drop(2);
  }
}

/// "list the contents of X", "name the things on Y".
bool readList(QuestionDraft& draft) {
  WordCursor ahead = draft.words;
  if (ahead.startsWith({"everything"}) && readBelongs(draft)) {
    return true;
  }
  if (ahead.take({"everything", "all"})) {
    return draft.finish(QuestionKind::kWhere);
  }
  if (ahead.take({"stuff", "things", "items"}) && findRelationWords(ahead.rest())) {
    draft.words = ahead;
    return draft.finish(QuestionKind::kContents);
  }
  const bool bare = ahead.startsWith({"contents"}) || ahead.startsWith({"the", "contents"});
  if (!bare && !ahead.take({"list", "name", "enumerate"}) && !ahead.takeAll({"read", "out"}) &&
      !ahead.takeAll({"give", "me", "a", "list", "of"})) {
    return false;
  }
  ahead.take({"me"});
  if (ahead.take({"what"})) {
    draft.words = ahead;
    return readWhat(draft);
  }
  ahead.take({"all"});
  ahead.take({"the"});
  if (ahead.takeAll({"contents", "of"}) && !ahead.empty()) {
    draft.question.kind = QuestionKind::kContents;
    addPlaces(draft.question.thing, {having(readThingPhrase(ahead.rest()))});
    return true;
  }
  draft.words = ahead;
  return draft.finish(QuestionKind::kWhere);
}

}  // namespace

bool readCommand(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (readList(draft)) {
    return true;
  }
  if (words.take({"bring", "fetch", "get", "give", "hand", "carry", "deliver", "grab", "pass", "bringing", "fetching", "getting", "giving",
                  "handing", "passing"})) {
    takeReceiver(words);
    takeHere(words);
    words.takeBack({"me", "us"}) && words.takeBack({"to", "for"});
    return draft.finish(QuestionKind::kFetch);
  }
  if (words.take({"opening"}) || words.takeAll({"how", "to", "open"})) {
    return draft.finish(QuestionKind::kHowOpen);
  }
  if (takeSearch(words)) {
    return draft.finish(QuestionKind::kWhere);
  }
  if (takeWish(words)) {
    takeHere(words);
    return draft.finish(QuestionKind::kFetch);
  }
  if (words.takeAll({"history", "of"}) || words.takeAll({"the", "history", "of"}) ||
      words.takeAll({"show", "me", "the", "history", "of"}) || words.takeAll({"show", "the", "history", "of"})) {
    return draft.finish(QuestionKind::kHistory);
  }
  if (words.takeAll({"show", "me", "where"}) || words.takeAll({"show", "where"})) {
    return readWhere(draft);
  }
  if (words.takeAll({"show", "me"}) || words.take({"find", "locate", "show", "seen"})) {
    words.takeAll({"all", "of"}) || words.take({"all"});
    return draft.finish(QuestionKind::kWhere);
  }
  return words.takeAll({"anything", "new"}) && readNews(draft);
}

}  // namespace oikos::semantic
