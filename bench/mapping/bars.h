// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/mapping/mapping_score.h"

namespace oikos::bench {

/// A table of the scores, a line a recording.
void printScores(const Scores& scores);

/// What is asked of the scores, what they are, and what peers reach on the same frames. Leaves out bars without their score.
void printBars(const Scores& scores);

}  // namespace oikos::bench
