// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

#include "semantic/history/event.h"

namespace oikos::semantic {

/// Commits what several threads hand in at the same time together: one of them does it for all that wait. Thread-safe.
class CommitQueue {
 public:
  /// One thread's events on their way.
  struct Batch {
    std::vector<Event> events;
    std::int64_t last_number = 0;
    std::exception_ptr failure;  ///< of this batch alone
    bool done = false;
  };
  /// Called by one thread at a time. What it throws is the failure of every batch that has none.
  using Commit = std::function<void(const std::vector<Batch*>&)>;

  explicit CommitQueue(Commit commit) : commit_(std::move(commit)) {}

  /// Returns when the batch is committed: its last number. Throws what went wrong with it.
  std::int64_t run(std::vector<Event> events);

 private:
  void gather(std::unique_lock<std::mutex>& lock);
  void commitWaiting(std::unique_lock<std::mutex>& lock);

  Commit commit_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Batch*> waiting_;
  std::size_t expected_ = 0;  ///< at the next commit, if all come again
  bool committing_ = false;
};

}  // namespace oikos::semantic
