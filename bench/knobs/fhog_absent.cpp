// SPDX-License-Identifier: Apache-2.0
// For builds without dlib.
#include "bench/knobs/fhog.h"

namespace oikos::bench {

std::optional<recognition::CellDescriber> findFhog() {
  return {};
}

}  // namespace oikos::bench
