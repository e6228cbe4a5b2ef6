// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/commit_queue.h"

#include <thread>
#include <utility>

namespace oikos::semantic {

std::int64_t CommitQueue::run(std::vector<Event> events) {
  Batch batch;
  batch.events = std::move(events);
  std::unique_lock lock(mutex_);
  waiting_.push_back(&batch);
  while (!batch.done) {
    if (committing_) {
      changed_.wait(lock);
    } else {
      commitWaiting(lock);
    }
  }
  if (batch.failure) {
    std::rethrow_exception(batch.failure);
  }
  return batch.last_number;
}

/// Lets those come who are about to: a thread that has just been served hands in its next sooner than a disk syncs.
void CommitQueue::gather(std::unique_lock<std::mutex>& lock) {
  constexpr int kPatience = 4;
  for (int in_vain = 0; waiting_.size() < expected_ && in_vain < kPatience;) {
    const std::size_t before = waiting_.size();
    lock.unlock();
    std::this_thread::yield();
    lock.lock();
    in_vain = waiting_.size() == before ? in_vain + 1 : 0;
  }
}

void CommitQueue::commitWaiting(std::unique_lock<std::mutex>& lock) {
  committing_ = true;
  gather(lock);
  const std::vector<Batch*> together = std::exchange(waiting_, {});
  lock.unlock();
  std::exception_ptr failure;
  try {
    commit_(together);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  committing_ = false;
  expected_ = together.size() + waiting_.size();
  for (Batch* batch : together) {
    batch->failure = batch->failure ? batch->failure : failure;
    batch->done = true;
  }
  changed_.notify_all();
}

}  // namespace oikos::semantic
