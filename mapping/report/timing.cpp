// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/timing.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "mapping/report/json_text.h"

namespace oikos::mapping {

namespace {

using Json = nlohmann::ordered_json;

std::string hostName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string processorName() {
  std::ifstream cpu_info("/proc/cpuinfo");
  for (std::string line; std::getline(cpu_info, line);) {
    if (line.starts_with("model name")) {
      const auto value = line.find_first_not_of(" \t:", std::string("model name").size());
      return value == std::string::npos ? "" : line.substr(value);
    }
  }
  return "";
}

std::int64_t peakMemoryBytes() {
  struct rusage usage {};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::int64_t>(usage.ru_maxrss) * 1024 : 0;
}

}  // namespace

void measureHost(TimingReport& timing) {
  timing.host = hostName();
  timing.processor = processorName();
  timing.processors = static_cast<int>(std::thread::hardware_concurrency());
  timing.peak_memory_bytes = peakMemoryBytes();
}

std::string timingJson(const TimingReport& timing) {
  Json stages = Json::array();
  for (const StageTime& stage : timing.stages) {
    stages.push_back({{"name", stage.name}, {"wall_s", stage.wall_s}});
  }
  const Json per_second = timing.total_s > 0.0 ? Json(timing.frames / timing.total_s) : Json(nullptr);
  return jsonText({{"format", "oikos-map-timing"},
                   {"version", 1},
                   {"total_s", timing.total_s},
                   {"frames", timing.frames},
                   {"frames_per_s", per_second},
                   {"stages", std::move(stages)},
                   {"peak_memory_bytes", timing.peak_memory_bytes},
                   {"threads", timing.threads},
                   {"host", timing.host},
                   {"processor", timing.processor},
                   {"processors", timing.processors}});
}

}  // namespace oikos::mapping
