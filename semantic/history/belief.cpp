// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/belief.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace oikos::semantic {

namespace {

constexpr double kElsewhereWeight = 1.0;
constexpr double kSecondsPerNs = 1e-9;

bool isSaidByPerson(EventKind kind) {
  return kind == EventKind::kCorrected || kind == EventKind::kEdited || kind == EventKind::kAdded;
}

}  // namespace

BeliefFilter::BeliefFilter(std::span<const Placement> default_places, double half_life_s) : half_life_s_(half_life_s) {
  OIKOS_CHECK(half_life_s > 0.0);
  for (const Placement& placement : default_places) {
    places_[indexOf({placement.parent, placement.relation})].weight = 1.0;
  }
  for (Weighted& place : places_) {
    place.probability = place.weight / totalWeight();
  }
  elsewhere_ = kElsewhereWeight / totalWeight();
}

double BeliefFilter::totalWeight() const {
  double total = kElsewhereWeight;
  for (const Weighted& place : places_) {
    total += place.weight;
  }
  return total;
}

std::size_t BeliefFilter::indexOf(const Place& place) {
  const auto found = std::find_if(places_.begin(), places_.end(), [&](const Weighted& known) { return known.place == place; });
  if (found != places_.end()) {
    return static_cast<std::size_t>(found - places_.begin());
  }
  places_.push_back({place, 0.0, 0.0});
  return places_.size() - 1;
}

/// The probability that nobody has touched it since `time_ns_`.
double BeliefFilter::untouched(std::int64_t now_ns) const {
  const double age_s = time_ns_ ? static_cast<double>(now_ns - *time_ns_) * kSecondsPerNs : 0.0;
  return std::exp2(-std::max(age_s, 0.0) / half_life_s_);
}

void BeliefFilter::advance(std::int64_t now_ns) {
  const double stays = untouched(now_ns);
  const double total = totalWeight();
  for (Weighted& place : places_) {
    place.probability = stays * place.probability + (1.0 - stays) * place.weight / total;
  }
  elsewhere_ = stays * elsewhere_ + (1.0 - stays) * kElsewhereWeight / total;
  time_ns_ = now_ns;
}

/// The posterior of a report that is right with probability c, and else as likely to name a place as the object is to be there.
void BeliefFilter::see(std::size_t seen, double confidence) {
  for (Weighted& place : places_) {
    place.probability *= 1.0 - confidence;
  }
  elsewhere_ *= 1.0 - confidence;
  places_[seen].probability += confidence;
  if (last_place_ != seen) {
    places_[seen].weight += 1.0;
    last_place_ = seen;
  }
}

void BeliefFilter::miss(std::size_t missed, double confidence) {
  const double lost = places_[missed].probability * confidence;
  const double rest = 1.0 - lost;
  if (rest > 0.0) {
    places_[missed].probability -= lost;
    for (Weighted& place : places_) {
      place.probability /= rest;
    }
    elsewhere_ /= rest;
    return;
  }
  const double others = totalWeight() - places_[missed].weight;  // it was certain to be there and is not: it has been put away
  for (Weighted& place : places_) {
    place.probability = place.weight / others;
  }
  places_[missed].probability = 0.0;
  elsewhere_ = kElsewhereWeight / others;
}

void BeliefFilter::take(const Event& event) {
  const auto* const placement = event.after ? std::get_if<Placement>(&*event.after) : nullptr;
  const bool is_person = isSaidByPerson(event.kind);
  if (placement == nullptr || (!is_person && event.kind != EventKind::kSighted && event.kind != EventKind::kMissed)) {
    return;
  }
  const std::size_t place = indexOf({placement->parent, placement->relation});
  advance(event.time_ns);
  said_by_person_.reset();
  if (event.kind == EventKind::kMissed) {
    miss(place, event.confidence);
    return;
  }
  see(place, is_person ? 1.0 : event.confidence);
  if (is_person) {
    said_by_person_ = place;
  } else {
    last_seen_ = event;
  }
}

Belief BeliefFilter::at(std::int64_t now_ns) const {
  BeliefFilter now = *this;
  now.advance(said_by_person_ ? time_ns_.value() : now_ns);
  Belief belief;
  belief.elsewhere = now.elsewhere_;
  belief.last_seen = last_seen_;
  for (const Weighted& place : now.places_) {
    belief.places.push_back({place.place, place.probability});
  }
  std::stable_sort(belief.places.begin(), belief.places.end(),
                   [](const PlaceProbability& a, const PlaceProbability& b) { return a.probability > b.probability; });
  if (!belief.places.empty() && belief.places.front().probability > 0.0) {
    belief.expected_at = belief.places.front().place;
  }
  return belief;
}

Belief beliefOf(std::span<const Event> events, std::span<const Placement> default_places, double half_life_s, std::int64_t now_ns) {
  BeliefFilter filter(default_places, half_life_s);
  for (const Event& event : events) {
    filter.take(event);
  }
  return filter.at(now_ns);
}

}  // namespace oikos::semantic
