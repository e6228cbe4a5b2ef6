// SPDX-License-Identifier: Apache-2.0
// The rest of a question after the words that tell its kind. Each is false where the rest is no such question.
#pragma once

#include "semantic/query/question_draft.h"

namespace oikos::semantic {

/// After "where".
[[nodiscard]] bool readWhere(QuestionDraft& draft);
/// After "from where".
[[nodiscard]] bool readStand(QuestionDraft& draft);
/// After "in which": "room is X".
[[nodiscard]] bool readWhichPlace(QuestionDraft& draft);

/// "the location of X", "the last time you saw X", "the best way to open X".
[[nodiscard]] bool readNamed(QuestionDraft& draft);

/// After "by how much", "how far": "is X open".
[[nodiscard]] bool readHowFar(QuestionDraft& draft);
/// After "how do": "I open X", "I pick up X".
/// After "how many": "X", "X are there", "X are on Y", "X does Y have", "X do we have", "X are open".
[[nodiscard]] bool readCount(QuestionDraft& draft);
/// "X that belongs to Y".
[[nodiscard]] bool readBelongs(QuestionDraft& draft);
[[nodiscard]] bool readHowTo(QuestionDraft& draft);
/// What is wanted of a place to stand: "to reach X", "so that the camera sees X", "if I want to open X".
[[nodiscard]] bool readStandGoal(QuestionDraft& draft);
/// After "how".
[[nodiscard]] bool readHow(QuestionDraft& draft);
/// After "when".
[[nodiscard]] bool readWhen(QuestionDraft& draft);

/// After "what" or "which".
[[nodiscard]] bool readWhat(QuestionDraft& draft);

/// "is X open", "is there an X on Y", "is X on Y", "do we have X", "did I leave X on".
[[nodiscard]] bool readYesNo(QuestionDraft& draft);
/// "X is on Y"; "nearest X to Y"; a noun alone.
[[nodiscard]] bool readSentence(QuestionDraft& draft);

/// "bring me X", "show me X", "I cannot find X".
[[nodiscard]] bool readCommand(QuestionDraft& draft);

}  // namespace oikos::semantic
