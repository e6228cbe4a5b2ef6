// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "mapping/report/timing.h"

namespace oikos::mapping {

/// How long each stage of a run takes, for `timing.json`.
class StageClock {
 public:
  void begin(const std::string& stage) {
    end();
    stages_.push_back({stage, 0.0});
    begin_ = Clock::now();
  }
  void end() {
    if (!stages_.empty() && stages_.back().wall_s == 0.0) {
      stages_.back().wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    }
  }
  [[nodiscard]] const std::vector<StageTime>& stages() const { return stages_; }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<StageTime> stages_;
  Clock::time_point begin_;
};

}  // namespace oikos::mapping
