// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bench/routes/route_run.h"

namespace oikos::bench {

/// The names of the columns.
void printRouteHeader();

/// One line of the table.
void printRoute(const RouteScore& score);

/// The averages of all routes with one sensor and one belief, and whether they are as asked for.
void printRouteBars(const std::vector<RouteScore>& scores);

}  // namespace oikos::bench
