// SPDX-License-Identifier: Apache-2.0
// Pieces of answers' sentences.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "semantic/query/thing.h"

namespace oikos::semantic {

[[nodiscard]] std::string joined(const std::vector<std::string>& words, const std::string& between);
[[nodiscard]] std::string capitalised(std::string text);
/// "a, b and c".
[[nodiscard]] std::string enumerated(const std::vector<std::string>& texts);
/// "the blue cup".
[[nodiscard]] std::string theName(const Thing& thing);
/// "the house keys are", not "is": by the word that ends the name.
[[nodiscard]] bool isPlural(const Thing& thing);
/// "in the cupboard in the kitchen"; of one of several chairs "in the kitchen, by the fridge".
[[nodiscard]] std::string placeText(const Thing& thing);
/// "69 degrees", "25 cm".
[[nodiscard]] std::string openingText(const Joint& joint);
/// "open by 69 degrees", "closed"; of furniture with several parts each by its name.
[[nodiscard]] std::string stateText(const Thing& thing);
/// "(1.80, -0.25)", m.
[[nodiscard]] std::string positionText(const Eigen::Vector3d& position_map);
/// "(1.80, -0.25), facing 90 degrees".
[[nodiscard]] std::string standText(const Eigen::Isometry3d& T_map_base);

/// Of texts that are the same the first one, "(2 of them)".
[[nodiscard]] std::vector<std::string> countedOnce(const std::vector<std::string>& texts);

/// "a, b and 3 more" of what `say` makes of each.
template <class Say>
[[nodiscard]] std::string listOf(const std::vector<const Thing*>& things, const Say& say) {
  constexpr std::size_t kMostSpoken = 8;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(things.size(), kMostSpoken); ++i) {
    texts.push_back(say(*things[i]));
  }
  texts = countedOnce(texts);
  if (things.size() > kMostSpoken) {
    texts.push_back(std::to_string(things.size() - kMostSpoken) + " more");
  }
  return enumerated(texts);
}

}  // namespace oikos::semantic
