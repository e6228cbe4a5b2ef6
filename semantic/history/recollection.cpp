// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/recollection.h"

#include <limits>
#include <vector>

namespace oikos::semantic {

namespace {

void takeInOrder(Recalled& recalled, const Event& event) {
  recalled.newest_ns = event.time_ns;
  if (event.kind == EventKind::kMissed && event.after) {
    recalled.missed = event;
  } else if (event.after && event.kind != EventKind::kMissed && event.kind != EventKind::kForgotten) {
    recalled.state = event;
    recalled.missed.reset();
  }
  if (recalled.belief) {
    recalled.belief->take(event);
  }
}

}  // namespace

Recalled recallAt(const History* history, const std::string& subject, const BeliefPrior* prior, std::int64_t time_ns) {
  Recalled recalled;
  if (prior == nullptr) {
    recalled.state = history == nullptr ? std::nullopt : history->findStateAt(subject, time_ns);
    recalled.newest_ns = recalled.state ? std::optional(recalled.state->time_ns) : std::nullopt;
    return recalled;
  }
  recalled.belief.emplace(prior->default_places, prior->half_life_s);
  if (history != nullptr) {
    for (const Event& event : history->lastEventsOf(subject, time_ns, kMostRecalled)) {
      takeInOrder(recalled, event);
    }
  }
  if (!recalled.belief->newest_ns() && prior->first_seen && prior->first_seen->time_ns <= time_ns) {
    recalled.belief->take(*prior->first_seen);
  }
  if (!recalled.belief->newest_ns()) {
    recalled.belief.reset();
  }
  return recalled;
}

std::shared_ptr<const Recalled> Recollection::recall(const std::string& subject, const std::function<BeliefPrior()>& prior) {
  Shard& shard = shardOf(subject);
  std::uint64_t changes = 0;
  {
    const std::lock_guard lock(shard.mutex);
    if (const auto known = shard.known.find(subject); known != shard.known.end()) {
      return known->second;
    }
    changes = shard.changes;
  }
  const std::optional<BeliefPrior> made = prior ? std::optional(prior()) : std::nullopt;
  const auto recalled =
      std::make_shared<const Recalled>(recallAt(&history_, subject, made ? &*made : nullptr, std::numeric_limits<std::int64_t>::max()));
  const std::lock_guard lock(shard.mutex);
  if (shard.changes == changes) {  // else an event may have come that was not read
    if (shard.known.size() >= kMostOfShard) {
      shard.known.clear();
    }
    shard.known.insert_or_assign(subject, recalled);
  }
  return recalled;
}

void Recollection::take(const Event& event) {
  if (event.kind == EventKind::kReverted || event.kind == EventKind::kForgotten) {
    return clear();  // it tells of other things' events too
  }
  Shard& shard = shardOf(event.subject);
  const std::lock_guard lock(shard.mutex);
  ++shard.changes;
  const auto known = shard.known.find(event.subject);
  if (known == shard.known.end()) {
    return;
  }
  const Recalled& before = *known->second;
  if (!before.belief || !before.newest_ns || event.time_ns < *before.newest_ns) {
    shard.known.erase(known);
    return;
  }
  auto after = std::make_shared<Recalled>(before);
  takeInOrder(*after, event);
  known->second = std::move(after);
}

void Recollection::clear() {
  for (Shard& shard : shards_) {
    const std::lock_guard lock(shard.mutex);
    ++shard.changes;
    shard.known.clear();
  }
}

}  // namespace oikos::semantic
