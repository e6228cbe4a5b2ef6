// SPDX-License-Identifier: Apache-2.0
#include "semantic/query/question_draft.h"

namespace oikos::semantic {

bool QuestionDraft::finishChange(const std::string& verb) {
  question.state = isOneOf(verb, {"open", "opened"}) ? "open" : isOneOf(verb, {"close", "closed", "shut"}) ? "closed" : "";
  return finish(QuestionKind::kLastChange);
}

std::string stateNamed(const std::string& word) {
  const auto open = opennessOf(word);
  return open ? (*open ? "open" : "closed") : word;
}

bool isStateWord(const std::string& word) {
  return opennessOf(word).has_value() || isOneOf(word, {"on", "off", "running"});
}

bool QuestionDraft::finish(QuestionKind kind) {
  question.kind = kind;
  while (words.takeBack({"there", "anywhere", "somewhere"}) ||
         (words.rest().size() > 1 && isBe(words.back()) && (words.dropBack(), true))) {
  }
  if (words.empty()) {
    return false;
  }
  question.thing = readThingPhrase(words.rest());
  return true;
}

}  // namespace oikos::semantic
