// SPDX-License-Identifier: Apache-2.0
// Format: Shotton et al., "Scene Coordinate Regression Forests for Camera Relocalization in RGB-D Images", CVPR 2013, and its data set's
// readme.
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "core/base/error.h"
#include "core/recording/listing.h"

namespace oikos::recording {

namespace {

namespace fs = std::filesystem;

enum class Role { kColor, kDepth };

struct ParsedName {
  std::int64_t number = 0;
  Role role = Role::kColor;
};

std::optional<ParsedName> parseName(std::string_view name) {
  constexpr std::string_view kPrefix = "frame-";
  if (name.substr(0, kPrefix.size()) != kPrefix) {
    return std::nullopt;
  }
  name.remove_prefix(kPrefix.size());
  ParsedName parsed;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), parsed.number);
  constexpr std::int64_t kLargestNumber = 1'000'000'000;
  if (failure != std::errc() || name.front() == '-' || parsed.number > kLargestNumber) {
    return std::nullopt;
  }
  name.remove_prefix(static_cast<std::size_t>(end - name.data()));
  if (name == ".depth.png") {
    parsed.role = Role::kDepth;
    return parsed;
  }
  return name == ".color.png" || name == ".color.jpg" ? std::optional<ParsedName>(parsed) : std::nullopt;
}

using NumberedFiles = std::map<std::int64_t, std::set<fs::path>>;

int countDuplicates(const NumberedFiles& files) {
  int duplicates = 0;
  for (const auto& [number, same] : files) {
    duplicates += static_cast<int>(same.size()) - 1;
  }
  return duplicates;
}

}  // namespace

bool looksLikeSevenScenes(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (parseName(entry.path().filename().string())) {
      return true;
    }
  }
  return false;
}

Listing listSevenScenes(const fs::path& folder, double rate_hz) {
  NumberedFiles color;
  NumberedFiles depth;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (const auto parsed = parseName(entry.path().filename().string())) {
      (parsed->role == Role::kColor ? color : depth)[parsed->number].insert(entry.path());
    }
  }
  Listing listing;
  for (const auto& [number, files] : color) {
    if (const auto partner = depth.find(number); partner != depth.end()) {
      const std::int64_t stamp_ns = std::llround(static_cast<double>(number) * 1e9 / rate_hz);
      // of a JPEG and a PNG with one number the PNG, the later name, is the original
      listing.frames.push_back({stamp_ns, *files.rbegin(), *partner->second.begin(), {}});
    }
  }
  if (listing.frames.empty()) {
    throw base::Error(base::ErrorCode::kInput, "no frame has both frame-NNNNNN.color.png (or .jpg) and frame-NNNNNN.depth.png",
                      folder.string());
  }
  ListingStatistics& statistics = listing.statistics;
  const int paired = static_cast<int>(listing.frames.size());
  statistics.duplicate_color = countDuplicates(color);
  statistics.duplicate_depth = countDuplicates(depth);
  statistics.listed_color = static_cast<int>(color.size()) + statistics.duplicate_color;
  statistics.listed_depth = static_cast<int>(depth.size()) + statistics.duplicate_depth;
  statistics.unmatched_color = static_cast<int>(color.size()) - paired;
  statistics.unmatched_depth = static_cast<int>(depth.size()) - paired;
  return listing;
}

}  // namespace oikos::recording
