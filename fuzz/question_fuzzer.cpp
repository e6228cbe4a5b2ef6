// SPDX-License-Identifier: Apache-2.0
// Any bytes as a question about a home of two rooms; the answer has to be JSON, whatever they are.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/error.h"
#include "semantic/query/answer.h"
#include "semantic/xml/home_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace oikos;
  static const semantic::HomeReading kReading = semantic::readHome(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml");
  static const semantic::HomeIndex kIndex(kReading.home);
  constexpr std::int64_t kNow_ns = 1'773'338'400'000'000'000;  // 2026-03-12T18:00:00Z
  const std::string_view question(reinterpret_cast<const char*>(data), size);
  const auto json = nlohmann::json::parse(semantic::toJson(semantic::answerQuestion({&kIndex, nullptr, kNow_ns, std::nullopt}, question)));
  OIKOS_CHECK(json.contains("status") && !json["sentence"].get<std::string>().empty());
  return 0;
}
