// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>

namespace oikos::base {

/// How far a long piece of work has come.
struct Progress {
  std::string stage;  ///< what is being done: "mapping"
  int done = 0;       ///< frames, usually
  int total = 0;      ///< 0: not known
};

/// How a library tells: libraries never print. May be called from any thread, often (a sink is cheap).
using ProgressSink = std::function<void(const Progress&)>;

/// Calls `sink` if there is one.
inline void reportProgress(const ProgressSink& sink, const Progress& progress) {
  if (sink) {
    sink(progress);
  }
}

/// "mapping [#####.....]  50%  300/600  31.2/s  0:10 left", cut to `columns`; rate and time left once there is a basis for them.
[[nodiscard]] std::string formatProgress(const Progress& progress, double elapsed_s, int columns);

/// Draws the progress on one line of a terminal, over and over. Thread-safe.
class ProgressBar {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  /// `terminal` must outlive the bar. `clock` is for tests.
  explicit ProgressBar(std::ostream& terminal, int columns = 80, Clock clock = std::chrono::steady_clock::now);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Leaves the line empty, for what is printed next.
  void clear();

 private:
  std::mutex mutex_;
  std::ostream* terminal_;
  int columns_;
  Clock clock_;
  std::string stage_;
  std::chrono::steady_clock::time_point stage_begin_;
  std::chrono::steady_clock::time_point last_drawn_;
  bool visible_ = false;
};

}  // namespace oikos::base
