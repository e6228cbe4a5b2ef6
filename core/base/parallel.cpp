// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace oikos::base {

namespace {

/// Keeps the exception of the lowest index, so that the same failure is reported whatever the thread count.
class FirstFailure {
 public:
  void store(int index, std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_ || index < index_) {
      index_ = index;
      failure_ = std::move(failure);
    }
  }
  void rethrow() const {
    if (failure_) {
      std::rethrow_exception(failure_);
    }
  }

 private:
  std::mutex mutex_;
  int index_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void parallelFor(int count, int threads, const std::function<void(int)>& body) {
  std::atomic<int> next = 0;
  FirstFailure failure;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        failure.store(i, std::current_exception());
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int t = 1; t < std::min(threads, count); ++t) {
      helpers.emplace_back(work);
    }
    work();
  }
  failure.rethrow();
}

}  // namespace oikos::base
