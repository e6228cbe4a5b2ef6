// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
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

/// One call's work. Helpers come when they get a processor; who comes after the work was taken has nothing to do, and is not waited for.
class Work {
 public:
  Work(int count, const std::function<void(int)>& body) : count_(count), body_(body) {}

  /// Takes indices until there is none.
  void take() {
    for (int i = next_++; i < count_; i = next_++) {
      try {
        body_(i);
      } catch (...) {
        failure_.store(i, std::current_exception());
      }
    }
  }
  void help() {
    {
      const std::lock_guard lock(mutex_);
      if (is_closed_) {
        return;  // the caller has gone, and what the body refers to with it
      }
      ++helping_;
    }
    take();
    const std::lock_guard lock(mutex_);
    --helping_;
    left_.notify_all();
  }
  /// Waits for the helpers that have begun, and lets no other begin.
  void close() {
    std::unique_lock lock(mutex_);
    is_closed_ = true;
    left_.wait(lock, [&] { return helping_ == 0; });
  }
  void rethrow() const { failure_.rethrow(); }

 private:
  const int count_;
  const std::function<void(int)>& body_;
  std::atomic<int> next_ = 0;
  FirstFailure failure_;
  std::mutex mutex_;
  std::condition_variable left_;
  int helping_ = 0;
  bool is_closed_ = false;
};

/// Threads that stay, as many as were ever needed at once: to start one takes as long as some loops do, and, on a busy machine, until it
/// gets a processor.
class Helpers {
 public:
  static Helpers& all() {
    static Helpers helpers;
    return helpers;
  }
  Helpers() = default;
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;
  ~Helpers() {
    {
      const std::lock_guard lock(mutex_);
      is_ending_ = true;
    }
    called_.notify_all();
    threads_.clear();  // joins
  }

  void call(const std::shared_ptr<Work>& work, int helpers) {
    const std::lock_guard lock(mutex_);
    for (int i = 0; i < helpers; ++i) {
      calls_.push_back(work);
    }
    while (idle_ + starting_ < calls_.size()) {
      ++starting_;
      threads_.emplace_back([this] { serve(); });
    }
    helpers == 1 ? called_.notify_one() : called_.notify_all();
  }
  /// Nobody needs to come any more.
  void recall(const std::shared_ptr<Work>& work) {
    const std::lock_guard lock(mutex_);
    std::erase(calls_, work);
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    --starting_;
    while (true) {
      ++idle_;
      called_.wait(lock, [&] { return is_ending_ || !calls_.empty(); });
      --idle_;
      if (is_ending_) {
        return;
      }
      const std::shared_ptr<Work> work = std::move(calls_.front());
      calls_.pop_front();
      lock.unlock();
      work->help();
      lock.lock();
    }
  }

  std::mutex mutex_;
  std::condition_variable called_;
  std::deque<std::shared_ptr<Work>> calls_;
  std::size_t idle_ = 0;
  std::size_t starting_ = 0;
  bool is_ending_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace

void parallelFor(int count, int threads, const std::function<void(int)>& body) {
  const auto work = std::make_shared<Work>(count, body);
  const int helpers = std::min(threads, count) - 1;
  if (helpers > 0) {
    Helpers::all().call(work, helpers);
  }
  work->take();
  if (helpers > 0) {
    Helpers::all().recall(work);
    work->close();
  }
  work->rethrow();
}

}  // namespace oikos::base
