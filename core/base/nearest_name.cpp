// SPDX-License-Identifier: Apache-2.0
#include "core/base/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace oikos::base {

int editDistance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);  // distances from the prefix of `a` read so far to every prefix of `b`
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
  const auto nearest = std::min_element(candidates.begin(), candidates.end(), [name](const std::string& a, const std::string& b) {
    return editDistance(name, a) < editDistance(name, b);
  });
  return nearest == candidates.end() ? std::string() : *nearest;
}

std::string didYouMean(std::string_view name, std::span<const std::string> candidates) {
  if (candidates.empty()) {
    return {};
  }
  const std::string nearest = nearestName(name, candidates);
  if (2 * editDistance(name, nearest) <= static_cast<int>(std::max(name.size(), nearest.size()))) {
    return "; did you mean '" + nearest + "'?";
  }
  std::string known = "; known: ";
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    known += (i == 0 ? "" : ", ") + candidates[i];
  }
  return known;
}

}  // namespace oikos::base
