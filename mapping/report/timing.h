// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace oikos::mapping {

struct StageTime {
  std::string name;
  double wall_s = 0.0;
};

/// What may differ between two runs on the same recording: `timing.json`, and nothing else.
struct TimingReport {
  std::vector<StageTime> stages;  ///< in order; they may overlap, where one runs beside another
  double total_s = 0.0;
  int frames = 0;
  int threads = 1;
  std::int64_t peak_memory_bytes = 0;
  std::string host;       ///< name
  std::string processor;  ///< as the operating system names it
  int processors = 0;     ///< logical ones
};

/// Fills in host, processors and peak memory (resident, of this process so far). What the system does not tell stays empty.
void measureHost(TimingReport& timing);

[[nodiscard]] std::string timingJson(const TimingReport& timing);

}  // namespace oikos::mapping
