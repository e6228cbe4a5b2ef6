// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace oikos::metrics {

/// Of a share; 0 to 1.
struct ShareInterval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's score interval at 95 % (Wilson 1927, doi:10.1080/01621459.1927.10502953) for `hits` of `count`; with none, all of it.
[[nodiscard]] ShareInterval wilsonInterval(int hits, int count);

}  // namespace oikos::metrics
