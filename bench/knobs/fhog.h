// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "recognition/knobs/knob_detector.h"

namespace oikos::bench {

/// dlib's 31 numbers a cell (`extract_fhog_features`): Felzenszwalb's histograms over 18 signed and 9 unsigned orientations and four sums
/// (doi:10.1109/TPAMI.2009.167), on the same cells as ours; its patches are bytes. Empty if the build has found no dlib. Thread-safe.
[[nodiscard]] std::optional<recognition::CellDescriber> findFhog();

}  // namespace oikos::bench
