// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace oikos::tools {

/// Ends the process within a second on SIGINT, SIGTERM or SIGHUP, tidily: one thread of its own waits for them, every other
/// thread has them blocked. Construct it in `main` before the first thread. Signals that the parent process had ignored
/// (nohup) stay ignored.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// What an interrupt does from now on: `tidy_up`, then `message` on stderr, then exit with 130. `tidy_up` runs on the
  /// waiting thread while all others still run. Thread-safe.
  void onInterrupt(std::string message, std::function<void()> tidy_up);

  /// Runs `step` so that an interrupt comes either before it (and `step` never starts) or after it, when it meets
  /// `message_afterwards`. Thread-safe.
  void runUninterrupted(const std::function<void()>& step, std::string message_afterwards);

  /// Ends the waiting; if an interrupt is being handled, never returns. Call it before reporting a failure, so that what an
  /// interrupt breaks is not reported as an error.
  void stop();

 private:
  void wait();
  [[noreturn]] void endProcess();

  sigset_t awaited_{};
  std::mutex mutex_;
  std::string message_ = "interrupted";
  std::function<void()> tidy_up_;
  std::atomic<bool> stopping_ = false;
  std::thread watcher_;
};

}  // namespace oikos::tools
