// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace oikos::bench {

/// Wilson's interval at 95 %.
[[nodiscard]] std::pair<double, double> rateInterval(long successes, long n);

/// In per cent, with counts and interval.
[[nodiscard]] std::string rateText(long successes, long n);

/// The mean, and half the width of its 95 % interval as if the values were independent.
[[nodiscard]] std::string meanText(const std::vector<double>& values);

}  // namespace oikos::bench
