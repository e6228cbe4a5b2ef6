// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace oikos::base {

/// Calls `body(i)` once for each i in [0, count), on at most `threads` threads (the calling one included). Which thread takes
/// which index is not determined: for results that do not depend on the thread count, `body(i)` writes to slot i only, and
/// the caller reduces over the slots in order. The first exception (by index) is rethrown after all have been called. The other threads
/// stay for later calls; one that does not get a processor before the others have done the work is not waited for, so that a body must
/// not wait for another one. Thread-safe, and a body may call it in turn.
void parallelFor(int count, int threads, const std::function<void(int)>& body);

}  // namespace oikos::base
