// SPDX-License-Identifier: Apache-2.0
// Questions that name what they ask for: "the location of X".
#include "semantic/query/question_kinds.h"

namespace oikos::semantic {

namespace {

/// "can I stand", "do I drive to", "is best".
bool readSpot(QuestionDraft& draft) {
  WordCursor words = draft.words;
  words.take({"the"});
  words.take({"best", "right", "good"});
  if (!words.take({"spot", "position", "place", "pose", "location"})) {
    return false;
  }
  if (words.take({"can", "could", "do", "should", "must", "shall", "would"}) && words.takeSpeaker()) {
    words.take({"have"});
    words.take({"to"});
    if (!words.take({"stand", "park", "go", "be", "drive", "stay", "wait", "move"})) {
      return false;
    }
    words.take({"to", "at", "in"});
  } else {
    words.takeAll({"to", "stand"}) || words.takeAll({"to", "park"}) || words.takeAll({"to", "be"});
  }
  draft.words = words;
  return readStandGoal(draft);
}

bool takeWay(WordCursor& words) {
  WordCursor ahead = words;
  ahead.take({"the", "a"});
  ahead.take({"best", "right", "proper", "easiest", "good", "correct"});
  const bool taken = ahead.take({"way", "trick", "procedure", "method", "steps", "secret"}) && ahead.take({"to", "for", "of"});
  words = taken ? ahead : words;
  return taken;
}

}  // namespace

bool readNamed(QuestionDraft& draft) {
  WordCursor& words = draft.words;
  WordCursor ahead = words;
  ahead.take({"the"});
  if (ahead.take({"whereabouts", "location", "place"}) && ahead.take({"of"})) {
    words = ahead;
    return draft.finish(QuestionKind::kWhere);
  }
  ahead = words;
  ahead.take({"the"});
  if (ahead.takeAll({"last", "time"})) {
    words = ahead;
    words.take({"that", "when"});
    words.takeAllBack({"was", "when"}) || words.takeAllBack({"is", "when"});
    return readWhen(draft);
  }
  return takeWay(words) ? readHowTo(draft) : readSpot(draft);
}

}  // namespace oikos::semantic
