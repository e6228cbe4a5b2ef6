// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <tuple>

#include "core/recording/listing.h"

namespace oikos::recording {

namespace {

struct Candidate {
  std::int64_t difference_ns = 0;
  ImagePair pair;
};

std::vector<Candidate> findCandidates(const std::vector<ListedImage>& color, const std::vector<ListedImage>& depth,
                                      std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates;
  std::size_t first = 0;  // no depth image before it is near enough to this colour image or a later one
  for (std::size_t c = 0; c < color.size(); ++c) {
    while (first < depth.size() && depth[first].stamp_ns < color[c].stamp_ns - max_difference_ns) {
      ++first;
    }
    for (std::size_t d = first; d < depth.size() && depth[d].stamp_ns <= color[c].stamp_ns + max_difference_ns; ++d) {
      const std::int64_t difference_ns = std::abs(depth[d].stamp_ns - color[c].stamp_ns);
      candidates.push_back({difference_ns, {static_cast<int>(c), static_cast<int>(d)}});
    }
  }
  return candidates;
}

}  // namespace

std::vector<ImagePair> associate(const std::vector<ListedImage>& color, const std::vector<ListedImage>& depth,
                                 std::int64_t max_difference_ns) {
  std::vector<Candidate> candidates = findCandidates(color, depth, max_difference_ns);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.difference_ns, a.pair.color, a.pair.depth) < std::tie(b.difference_ns, b.pair.color, b.pair.depth);
  });
  std::vector<bool> color_taken(color.size(), false);
  std::vector<bool> depth_taken(depth.size(), false);
  std::vector<ImagePair> pairs;
  for (const Candidate& candidate : candidates) {
    const auto c = static_cast<std::size_t>(candidate.pair.color);
    const auto d = static_cast<std::size_t>(candidate.pair.depth);
    if (!color_taken[c] && !depth_taken[d]) {
      color_taken[c] = true;
      depth_taken[d] = true;
      pairs.push_back(candidate.pair);
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const ImagePair& a, const ImagePair& b) { return a.color < b.color; });
  return pairs;
}

}  // namespace oikos::recording
