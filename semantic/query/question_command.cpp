// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_kinds.h"

#include "semantic/query/thing_phrase.h"

namespace oikos::semantic {

namespace {

bool readNews(QuestionDraft& draft) {
  draft.question.kind = QuestionKind::kChanges;
  draft.question.thing = readThingPhrase(draft.words.rest());
  return true;
}

}  // namespace

bool readCommand(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  if (words.take({"bring", "fetch", "get", "give", "hand", "carry", "deliver", "grab"})) {
    words.take({"me", "us", "him", "her"});
    words.takeBack({"me", "us"}) && words.takeBack({"to", "for"});
    return draft.finish(QuestionKind::kFetch);
  }
  if (words.takeAll({"i", "need"}) || words.takeAll({"i", "want"}) || words.takeAll({"i", "would", "like"}) ||
      words.takeAll({"id", "like"}) || words.takeAll({"can", "i", "have"}) || words.takeAll({"could", "i", "have"})) {
    return draft.finish(QuestionKind::kFetch);
  }
  if (words.takeAll({"history", "of"}) || words.takeAll({"the", "history", "of"}) ||
      words.takeAll({"show", "me", "the", "history", "of"}) || words.takeAll({"show", "the", "history", "of"})) {
    return draft.finish(QuestionKind::kHistory);
  }
  if (words.takeAll({"show", "me", "where"}) || words.takeAll({"show", "where"})) {
    return readWhere(draft);
  }
  if (words.takeAll({"show", "me"}) || words.takeAll({"look", "for"}) || words.takeAll({"search", "for"}) ||
      words.takeAll({"im", "looking", "for"}) || words.takeAll({"i", "am", "looking", "for"}) || words.takeAll({"looking", "for"}) ||
      words.takeAll({"i", "cant", "find"}) || words.takeAll({"i", "cannot", "find"}) || words.takeAll({"i", "lost"}) ||
      words.takeAll({"ive", "lost"}) || words.takeAll({"i", "have", "lost"}) || words.takeAll({"i", "misplaced"}) ||
      words.takeAll({"help", "me", "find"}) || words.take({"find", "locate", "show", "list", "seen"})) {
    words.takeAll({"all", "of"}) || words.take({"all"});
    return draft.finish(QuestionKind::kWhere);
  }
  return words.takeAll({"anything", "new"}) && readNews(draft);
}

}  // namespace oikos::semantic
