// SPDX-License-Identifier: Apache-2.0
#include "tools/interrupts.h"

#include <pthread.h>
#include <unistd.h>

#include <utility>

namespace oikos::tools {

namespace {

constexpr int kExitInterrupted = 130;  // 128 + SIGINT, what a shell expects
constexpr int kWakeUp = SIGUSR2;       // ends the watcher, from stop() only

bool isIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void writeLine(const std::string& text) {
  const std::string line = "\n" + text + "\n";
  // Nothing can be done if stderr is gone.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace

Interrupts::Interrupts() {
  sigemptyset(&awaited_);
  sigaddset(&awaited_, kWakeUp);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!isIgnored(signal)) {
      sigaddset(&awaited_, signal);
    }
  }
  pthread_sigmask(SIG_BLOCK, &awaited_, nullptr);
  watcher_ = std::thread([this] { wait(); });
}

Interrupts::~Interrupts() {
  stop();
}

void Interrupts::onInterrupt(std::string message, std::function<void()> tidy_up) {
  const std::lock_guard lock(mutex_);
  message_ = std::move(message);
  tidy_up_ = std::move(tidy_up);
}

void Interrupts::runUninterrupted(const std::function<void()>& step, std::string message_afterwards) {
  const std::lock_guard lock(mutex_);
  step();
  message_ = std::move(message_afterwards);
}

void Interrupts::stop() {
  if (watcher_.joinable()) {
    stopping_ = true;
    pthread_kill(watcher_.native_handle(), kWakeUp);
    watcher_.join();
  }
}

void Interrupts::wait() {
  while (true) {
    int signal = 0;
    if (sigwait(&awaited_, &signal) != 0) {
      continue;
    }
    if (signal != kWakeUp) {
      endProcess();
    }
    if (stopping_) {
      return;
    }
  }
}

void Interrupts::endProcess() {
  mutex_.lock();  // for good: a commit that has not begun must not begin now
  if (tidy_up_) {
    tidy_up_();
  }
  writeLine("oikos: " + message_);
  _exit(kExitInterrupted);
}

}  // namespace oikos::tools
