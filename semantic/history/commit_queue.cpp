// SPDX-License-Identifier: Apache-2.0
#include "semantic/history/commit_queue.h"

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

void CommitQueue::commitWaiting(std::unique_lock<std::mutex>& lock) {
  const std::vector<Batch*> together = std::exchange(waiting_, {});
  committing_ = true;
  lock.unlock();
  std::exception_ptr failure;
  try {
    commit_(together);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  committing_ = false;
  for (Batch* batch : together) {
    batch->failure = batch->failure ? batch->failure : failure;
    batch->done = true;
  }
  changed_.notify_all();
}

}  // namespace oikos::semantic
