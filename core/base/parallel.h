// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace oikos::base {

/// Calls `body(i)` once for each i in [0, count), on at most `threads` threads (the calling one included). Which thread takes
/// which index is not determined: for results that do not depend on the thread count, `body(i)` writes to slot i only, and
/// the caller reduces over the slots in order. The first exception (by index) is rethrown after all threads have ended.
void parallelFor(int count, int threads, const std::function<void(int)>& body);

}  // namespace oikos::base
