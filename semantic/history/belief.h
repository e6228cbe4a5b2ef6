// SPDX-License-Identifier: Apache-2.0
// Where an object is now, as far as its history tells: Rosen, Mason, Leonard, "Towards lifelong feature-based mapping in semi-static
// environments" (ICRA 2016, doi:10.1109/ICRA.2016.7487237). There a feature persists or is gone for good; here it may be at any of several
// places, or elsewhere, and comes back. The survival prior is exponential, so that the filter has a state of constant size.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "semantic/history/event.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

/// What carries an object, and how; not where on it.
struct Place {
  std::string parent;
  Relation relation = Relation::kOn;
  bool operator==(const Place&) const = default;
};

struct PlaceProbability {
  Place place;
  double probability = 0.0;
};

/// A distribution: the places' probabilities and `elsewhere` sum to 1.
struct Belief {
  std::vector<PlaceProbability> places;  ///< the most probable first
  double elsewhere = 1.0;                ///< where it has never been seen and does not belong
  std::optional<Event> last_seen;        ///< the newest sighting
  std::optional<Place> expected_at;      ///< the most probable place; nothing: none has a probability above 0
};

/// What is known of an object before its history.
struct BeliefPrior {
  std::vector<Placement> default_places;
  double half_life_s = 1.0;                        ///< above 0
  std::optional<Event> first_seen = std::nullopt;  ///< counts as long as the history says nothing
};

/// The belief in one object, event by event. Not thread-safe.
///
/// The object is put away at random times, as often as `half_life_s` says (after that time half of all objects have not been touched), and
/// then lies at one of its places or elsewhere, each as likely as it was found there before: places count 1 if they are default places, and
/// 1 for each time that the object was seen to have come there; elsewhere counts 1. A sighting's confidence is the probability that it is
/// right; one that is wrong tells nothing. A miss's confidence is the probability that the object would have been seen, had it been there.
/// What a person said counts as certain until a newer event.
class BeliefFilter {
 public:
  /// Before any event it lies where it is put away.
  BeliefFilter(std::span<const Placement> default_places, double half_life_s);

  /// The next one of the object in the order of time; an event that tells of no place is passed over.
  void take(const Event& event);
  /// `now_ns`: not before the last event.
  [[nodiscard]] Belief at(std::int64_t now_ns) const;
  /// Of the events that it has taken; nothing: none told of a place.
  [[nodiscard]] const std::optional<std::int64_t>& newest_ns() const { return time_ns_; }

 private:
  struct Weighted {
    Place place;
    double weight = 0.0;  ///< how often it is put there
    double probability = 0.0;
  };

  [[nodiscard]] double totalWeight() const;
  [[nodiscard]] double untouched(std::int64_t now_ns) const;
  std::size_t indexOf(const Place& place);
  void advance(std::int64_t now_ns);
  void see(std::size_t place, double confidence);
  void miss(std::size_t place, double confidence);

  std::vector<Weighted> places_;
  double elsewhere_ = 1.0;
  double half_life_s_;
  std::optional<std::int64_t> time_ns_;  ///< of the probabilities
  std::optional<std::size_t> last_place_;
  std::optional<std::size_t> said_by_person_;
  std::optional<Event> last_seen_;
};

/// `events`: the object's, in the order of time, none after `now_ns`.
[[nodiscard]] Belief beliefOf(std::span<const Event> events, std::span<const Placement> default_places, double half_life_s,
                              std::int64_t now_ns);

}  // namespace oikos::semantic
