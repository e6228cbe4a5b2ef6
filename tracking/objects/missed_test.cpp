// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/missed_test.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace oikos::tracking {

namespace {

int countOf(const std::vector<TimedSight>& sights, SightVerdict verdict) {
  return static_cast<int>(std::count_if(sights.begin(), sights.end(), [&](const TimedSight& one) { return one.sight.verdict == verdict; }));
}

/// Those that speak against it, after all that have something in its place.
std::vector<const TimedSight*> missesOf(const std::vector<TimedSight>& sights) {
  std::vector<const TimedSight*> misses;
  for (const TimedSight& one : sights) {
    if (one.sight.verdict == SightVerdict::kThere) {
      misses.clear();
    } else if (one.sight.against > 0.0) {
      misses.push_back(&one);
    }
  }
  return misses;
}

/// Of these, from places apart, the strongest.
std::vector<const TimedSight*> thoseApart(std::vector<const TimedSight*> misses, double apart_m) {
  std::stable_sort(misses.begin(), misses.end(),
                   [](const TimedSight* a, const TimedSight* b) { return a->sight.against > b->sight.against; });
  std::vector<const TimedSight*> apart;
  for (const TimedSight* const one : misses) {
    const bool is_apart = std::all_of(apart.begin(), apart.end(),
                                      [&](const TimedSight* other) { return (one->camera_map - other->camera_map).norm() >= apart_m; });
    if (is_apart) {
      apart.push_back(one);
    }
  }
  return apart;
}

std::vector<const TimedSight*> sureOnes(const std::vector<const TimedSight*>& misses) {
  std::vector<const TimedSight*> sure;
  std::copy_if(misses.begin(), misses.end(), std::back_inserter(sure),
               [](const TimedSight* one) { return one->sight.verdict == SightVerdict::kNotThere; });
  return sure;
}

}  // namespace

ObjectReading testMissed(const std::vector<TimedSight>& sights, double apart_m, const MissedTestConfig& config) {
  ObjectReading reading;
  reading.views = static_cast<int>(sights.size());
  reading.there = countOf(sights, SightVerdict::kThere);
  reading.not_there = countOf(sights, SightVerdict::kNotThere);
  reading.hidden = countOf(sights, SightVerdict::kHidden);
  const std::vector<const TimedSight*> misses = missesOf(sights);
  const std::vector<const TimedSight*> sure = sureOnes(misses);
  const std::vector<const TimedSight*> apart = thoseApart(misses, apart_m);
  const double words =
      std::accumulate(apart.begin(), apart.end(), 0.0, [](double sum, const TimedSight* one) { return sum + one->sight.against; });
  const double chance = std::pow(config.misread, words);
  if (!sure.empty() && static_cast<int>(apart.size()) >= config.min_views && chance <= config.max_chance) {
    const TimedSight& best = **std::max_element(
        sure.begin(), sure.end(), [](const TimedSight* a, const TimedSight* b) { return a->sight.through < b->sight.through; });
    reading.status = WatchStatus::kMissed;
    reading.confidence = 1.0 - chance;
    reading.stamp_ns = sure.front()->stamp_ns;
    reading.frame = sure.front()->frame;
    reading.evidence_frame = best.frame;
    reading.crop = best.sight.crop;
  } else if (sure.empty() && reading.there > 0) {
    reading.status = WatchStatus::kThere;
  } else if (sure.empty() && reading.hidden > 0) {
    reading.status = WatchStatus::kHidden;
  }
  return reading;
}

}  // namespace oikos::tracking
