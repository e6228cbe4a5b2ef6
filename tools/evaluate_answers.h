// SPDX-License-Identifier: Apache-2.0
// What the commands below `oikos evaluate` share.
#pragma once

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/metrics/error_statistics.h"

namespace oikos::tools {

inline double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

template <class Config>
void requireValid(const Config& config) {
  if (const auto problems = config.validate(); !problems.empty()) {
    throw base::Error(base::ErrorCode::kUsage, problems.front());
  }
}

/// One row of the answer for a person: `rmse 1.23  mean 1.11  median 1.05  max 3.02 cm`.
inline std::string row(const metrics::ErrorStatistics& statistics, double factor, const std::string& unit) {
  const auto cell = [factor](const char* name, double value) {
    return std::string(name) + " " + base::toFixedText(factor * value, 2) + "  ";
  };
  return cell("rmse", statistics.rmse) + cell("mean", statistics.mean) + cell("median", statistics.median) + "max " +
         base::toFixedText(factor * statistics.max, 2) + " " + unit;
}

inline nlohmann::ordered_json statisticsJson(const metrics::ErrorStatistics& statistics, double factor, const std::string& unit) {
  return {{"rmse_" + unit, factor * statistics.rmse},
          {"mean_" + unit, factor * statistics.mean},
          {"median_" + unit, factor * statistics.median},
          {"max_" + unit, factor * statistics.max}};
}

/// tools/evaluate_tags.cpp
void addTagEvaluation(CLI::App& evaluate);
/// tools/evaluate_states.cpp
void addStateEvaluation(CLI::App& evaluate);

}  // namespace oikos::tools
