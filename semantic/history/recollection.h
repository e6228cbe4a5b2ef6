// SPDX-License-Identifier: Apache-2.0
// What a history says of things as they stand now, kept at hand: a question should not have to read the disk.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "semantic/history/belief.h"
#include "semantic/history/history.h"

namespace oikos::semantic {

/// What the events of one thing come to.
struct Recalled {
  std::optional<Event> state;             ///< the newest that says something of its state
  std::optional<BeliefFilter> belief;     ///< nothing: it is no small object, or nothing is known of when it was anywhere
  std::optional<Event> missed;            ///< of a small object: the newest miss, if nothing has told of its place since
  std::optional<std::int64_t> newest_ns;  ///< of all; nothing: there are none
};

/// Longer histories of a thing are taken from their newest events on.
constexpr std::size_t kMostRecalled = 1000;

/// By `time_ns`. `prior`: of a small object; null for anything else. `history` may be null: nothing is known but the prior.
[[nodiscard]] Recalled recallAt(const History* history, const std::string& subject, const BeliefPrior* prior, std::int64_t time_ns);

/// The same, of all events there are; as quick as a look into a table where it was asked before. Thread-safe.
class Recollection {
 public:
  /// The history must outlive it.
  explicit Recollection(const History& history) : history_(history) {}
  Recollection(const Recollection&) = delete;
  Recollection& operator=(const Recollection&) = delete;

  /// `prior`: makes the prior where it is needed; empty for what is no small object. Throws what reading the history throws.
  [[nodiscard]] std::shared_ptr<const Recalled> recall(const std::string& subject, const std::function<BeliefPrior()>& prior);
  /// An event that the history has taken, with its number; to be told of each, in the order of commits.
  void take(const Event& event);
  /// The home itself was edited: nothing that was recalled counts any more.
  void clear();

 private:
  static constexpr std::size_t kShards = 64;
  static constexpr std::size_t kMostOfShard = 256;
  struct Shard {
    std::mutex mutex;
    std::unordered_map<std::string, std::shared_ptr<const Recalled>> known;  // looked up only
    std::uint64_t changes = 0;
  };

  Shard& shardOf(const std::string& subject) { return shards_[std::hash<std::string>{}(subject) % kShards]; }

  const History& history_;
  std::array<Shard, kShards> shards_;
};

}  // namespace oikos::semantic
