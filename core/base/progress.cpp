// SPDX-License-Identifier: Apache-2.0
#include "core/base/progress.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/base/number_text.h"

namespace oikos::base {

namespace {

constexpr int kBarCells = 24;
constexpr double kMinElapsed_s = 0.5;  // before that a rate says nothing
constexpr auto kRedrawEvery = std::chrono::milliseconds(100);
constexpr const char* kClearLine = "\r\x1b[K";

std::string formatBar(double share) {
  const int full = static_cast<int>(share * kBarCells);
  return "[" + std::string(full, '#') + std::string(kBarCells - full, '.') + "]";
}

std::string padLeft(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}

/// "0:07", "12:30", "1:02:03".
std::string formatDuration(double duration_s) {
  const auto total_s = static_cast<std::int64_t>(std::ceil(duration_s));
  const auto twoDigits = [](std::int64_t number) { return (number < 10 ? "0" : "") + toText(number); };
  const std::string seconds = twoDigits(total_s % 60);
  const std::int64_t minutes = total_s / 60;
  return minutes < 60 ? toText(minutes) + ":" + seconds : toText(minutes / 60) + ":" + twoDigits(minutes % 60) + ":" + seconds;
}

}  // namespace

std::string formatProgress(const Progress& progress, double elapsed_s, int columns) {
  const int total = std::max(progress.total, 0);
  const int done = total > 0 ? std::clamp(progress.done, 0, total) : std::max(progress.done, 0);
  std::string line = progress.stage;
  if (total > 0) {
    const double share = static_cast<double>(done) / total;
    line += " " + formatBar(share) + padLeft(toFixedText(std::floor(100.0 * share), 0), 4) + "%  " + std::to_string(done) + "/" +
            std::to_string(total);
  } else {
    line += "  " + std::to_string(done);
  }
  if (done > 0 && elapsed_s >= kMinElapsed_s) {
    line += "  " + toFixedText(done / elapsed_s, 1) + "/s";
    line += total > 0 ? "  " + formatDuration(elapsed_s * (total - done) / done) + " left" : "";
  }
  return line.substr(0, static_cast<std::size_t>(std::max(columns, 0)));
}

ProgressBar::ProgressBar(std::ostream& terminal, int columns, Clock clock)
    : terminal_(&terminal), columns_(columns), clock_(std::move(clock)), stage_begin_(clock_()) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::show(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const auto now = clock_();
  const bool new_stage = progress.stage != stage_;
  if (new_stage) {
    stage_ = progress.stage;
    stage_begin_ = now;
  }
  const bool finished = progress.done == progress.total;
  if (visible_ && !new_stage && !finished && now - last_drawn_ < kRedrawEvery) {
    return;
  }
  const double elapsed_s = std::chrono::duration<double>(now - stage_begin_).count();
  *terminal_ << kClearLine << formatProgress(progress, elapsed_s, columns_) << std::flush;
  last_drawn_ = now;
  visible_ = true;
}

void ProgressBar::clear() {
  const std::lock_guard lock(mutex_);
  if (visible_) {
    *terminal_ << kClearLine << std::flush;
    visible_ = false;
  }
}

}  // namespace oikos::base
