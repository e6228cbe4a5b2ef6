// SPDX-License-Identifier: Apache-2.0
// A home without a history that is asked something.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "semantic/query/answer.h"

namespace oikos::semantic {

constexpr std::int64_t kNow_ns = 1'773'338'400'000'000'000;  // 2026-03-12T18:00:00Z

[[nodiscard]] inline Answer ask(const Home& home, const std::string& question) {
  const HomeIndex index(home);
  return answerQuestion({&index, nullptr, kNow_ns, std::nullopt}, question);
}

}  // namespace oikos::semantic
