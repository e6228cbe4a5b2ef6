// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/knob_stays.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace oikos::tracking {

namespace {

using recognition::KnobStatus;
using Scores = std::vector<double>;  // one a state

bool showsIt(const KnobSighting& sighting) {
  const KnobStatus status = sighting.reading.status;
  return status == KnobStatus::kRead || status == KnobStatus::kCannotTell;
}

bool hasRead(const KnobSighting& sighting, std::size_t state) {
  return sighting.reading.status == KnobStatus::kRead && sighting.reading.state == state;
}

/// Log likelihoods. What a picture gives to no state at all it holds against none of them.
Scores scoresOf(const KnobSighting& sighting, std::size_t states, const KnobTestConfig& config) {
  const std::vector<double>& probabilities = sighting.reading.state_probabilities;
  OIKOS_CHECK(probabilities.size() == states);
  double in_none = 1.0;
  for (const double probability : probabilities) {
    in_none -= probability;
  }
  Scores scores;
  for (const double probability : probabilities) {
    const double share = probability + std::max(in_none, 0.0) / static_cast<double>(states);
    scores.push_back(std::log(std::max(share, config.error_share)));
  }
  return scores;
}

/// The likeliest state at each picture.
std::vector<std::size_t> likeliestCourse(const std::vector<Scores>& scores, double turning_cost) {
  const std::size_t states = scores.front().size();
  Scores best = scores.front();
  std::vector<std::vector<std::size_t>> came_from;
  for (std::size_t i = 1; i < scores.size(); ++i) {
    const auto top = static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
    std::vector<std::size_t> from(states);
    Scores next(states);
    for (std::size_t s = 0; s < states; ++s) {
      from[s] = best[s] >= best[top] - turning_cost ? s : top;
      next[s] = std::max(best[s], best[top] - turning_cost) + scores[i][s];
    }
    best = std::move(next);
    came_from.push_back(std::move(from));
  }
  std::vector<std::size_t> course(scores.size());
  course.back() = static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
  for (std::size_t i = scores.size() - 1; i > 0; --i) {
    course[i - 1] = came_from[i - 1][course[i]];
  }
  return course;
}

/// From sums over so many pictures, of which each counts the less the more there are.
double probabilityOf(std::size_t state, const Scores& sums, int images, double tempering) {
  const double share = (1.0 + tempering * (images - 1)) / images;
  double all = 0.0;
  for (const double sum : sums) {
    all += std::exp(share * (sum - sums[state]));
  }
  return 1.0 / all;
}

registration::PixelBox cropOf(const recognition::KnobReading& reading) {
  const double half = 1.5 * reading.diameter_px;
  const auto low = [&](double middle) { return std::max(0, static_cast<int>(std::floor(middle - half))); };
  const auto high = [&](double middle) { return static_cast<int>(std::ceil(middle + half)); };
  const Eigen::Vector2d& centre = reading.centre_px;
  return {low(centre.x()), low(centre.y()), high(centre.x()), high(centre.y())};
}

KnobStay stayOf(const std::vector<const KnobSighting*>& sightings, const std::vector<Scores>& scores, std::size_t state, double tempering) {
  KnobStay stay;
  stay.state = state;
  stay.images = static_cast<int>(sightings.size());
  stay.first_ns = sightings.front()->stamp_ns;
  stay.first_frame = sightings.front()->frame;
  stay.last_frame = sightings.back()->frame;
  Scores sums(scores.front().size(), 0.0);
  double largest_px = -1.0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const KnobSighting& one = *sightings[i];
    for (std::size_t s = 0; s < sums.size(); ++s) {
      sums[s] += scores[i][s];
    }
    const bool is_found = hasRead(one, state);
    if (is_found && stay.found++ == 0) {
      stay.first_ns = one.stamp_ns;
      stay.first_frame = one.frame;
    }
    const double shown_px = one.reading.diameter_px + (is_found ? 1e6 : 0.0);
    if (shown_px > largest_px) {
      largest_px = shown_px;
      stay.best_frame = one.frame;
      stay.crop = cropOf(one.reading);
    }
  }
  stay.probability = probabilityOf(state, sums, stay.images, tempering);
  return stay;
}

}  // namespace

std::vector<KnobStay> fuseSightings(const std::vector<KnobSighting>& sightings, std::size_t states, const KnobTestConfig& config) {
  std::vector<const KnobSighting*> shown;
  std::vector<Scores> scores;
  for (const KnobSighting& sighting : sightings) {
    if (showsIt(sighting)) {
      shown.push_back(&sighting);
      scores.push_back(scoresOf(sighting, states, config));
    }
  }
  if (shown.empty()) {
    return {};
  }
  const std::vector<std::size_t> course = likeliestCourse(scores, -std::log(config.turning_share) / config.tempering);
  std::vector<KnobStay> stays;
  for (std::size_t begin = 0; begin < course.size();) {
    std::size_t end = begin + 1;
    while (end < course.size() && course[end] == course[begin]) {
      ++end;
    }
    const auto from = static_cast<std::ptrdiff_t>(begin);
    const auto to = static_cast<std::ptrdiff_t>(end);
    stays.push_back(
        stayOf({shown.begin() + from, shown.begin() + to}, {scores.begin() + from, scores.begin() + to}, course[begin], config.tempering));
    begin = end;
  }
  return stays;
}

}  // namespace oikos::tracking
