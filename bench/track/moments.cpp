// SPDX-License-Identifier: Apache-2.0
#include "bench/track/moments.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace oikos::bench {

namespace {

void reportThose(const std::vector<MovedInDrive>& moments, bool in_view, const char* which, double rate_hz) {
  int count = 0;
  int worst = 0;
  int sum = 0;
  int within = 0;
  for (const MovedInDrive& one : moments) {
    if (one.is_in_view == in_view) {
      ++count;
      worst = std::max(worst, one.off());
      sum += one.off();
      within += one.isWithin() ? 1 : 0;
    }
  }
  std::printf("%s: %d, moments off by %.2f s in the mean, at worst by %.1f s; within what is said of them: %d of %d\n", which, count,
              sum / rate_hz / std::max(1, count), worst / rate_hz, within, count);
}

}  // namespace

int MovedInDrive::off() const {
  const int latest = is_in_view ? moment : first_shown;
  return told < moment ? moment - told : std::max(0, told - latest);
}

std::string textOf(const MovedInDrive& moved) {
  return "moment of " + moved.id + ": frame " + std::to_string(moved.told) + ", as before up to " + std::to_string(moved.last_before) +
         "; in truth " + std::to_string(moved.moment) +
         (moved.is_in_view ? "" : ", shown from " + std::to_string(moved.first_shown) + " on");
}

void report(const std::vector<MovedInDrive>& moments, double rate_hz) {
  reportThose(moments, true, "joints that moved in view", rate_hz);
  reportThose(moments, false, "joints that moved hardly in view, from when the camera shows them", rate_hz);
}

}  // namespace oikos::bench
