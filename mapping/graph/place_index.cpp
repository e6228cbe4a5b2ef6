// SPDX-License-Identifier: Apache-2.0
// Differs from HBST in that a leaf which no bit divides into at least a tenth and the rest stays a leaf.
#include "mapping/graph/place_index.h"

#include <algorithm>
#include <array>
#include <set>

namespace oikos::mapping {

namespace {

constexpr int kBits = 256;
constexpr std::size_t kLeafSize = 60;
constexpr int kNear = 45;  ///< Hamming distance of descriptors that may show the same thing

bool bitOf(const Descriptor& d, int bit) {
  return ((d[static_cast<std::size_t>(bit / 64)] >> (bit % 64)) & 1U) != 0;
}

}  // namespace

int PlaceIndex::leafOf(const Descriptor& descriptor) const {
  int at = 0;
  while (branches_[static_cast<std::size_t>(at)].bit >= 0) {
    const Branch& branch = branches_[static_cast<std::size_t>(at)];
    at = bitOf(descriptor, branch.bit) ? branch.one : branch.zero;
  }
  return at;
}

void PlaceIndex::add(int place, const Features& features) {
  for (const Descriptor& descriptor : features.descriptor) {
    insert({descriptor, place});
  }
}

void PlaceIndex::insert(const Entry& entry) {
  const int leaf = leafOf(entry.descriptor);
  auto& entries = branches_[static_cast<std::size_t>(leaf)].entries;
  entries.push_back(entry);
  if (entries.size() > kLeafSize && entries.size() % kLeafSize == 1) {
    split(leaf);
  }
}

void PlaceIndex::split(int branch) {
  const std::vector<Entry>& entries = branches_[static_cast<std::size_t>(branch)].entries;
  std::array<int, kBits> ones{};
  for (const Entry& e : entries) {
    for (int bit = 0; bit < kBits; ++bit) {
      ones[static_cast<std::size_t>(bit)] += bitOf(e.descriptor, bit) ? 1 : 0;
    }
  }
  const int total = static_cast<int>(entries.size());
  const auto imbalance = [&](int count) { return std::abs(2 * count - total); };
  const auto best = std::min_element(ones.begin(), ones.end(), [&](int a, int b) { return imbalance(a) < imbalance(b); });
  if (imbalance(*best) > total * 8 / 10) {
    return;
  }
  const int bit = static_cast<int>(best - ones.begin());
  std::array<Branch, 2> children;
  for (const Entry& e : entries) {
    children[bitOf(e.descriptor, bit) ? 1 : 0].entries.push_back(e);
  }
  const int zero = static_cast<int>(branches_.size());
  branches_.push_back(std::move(children[0]));
  branches_.push_back(std::move(children[1]));
  Branch& parent = branches_[static_cast<std::size_t>(branch)];
  parent.bit = bit;
  parent.zero = zero;
  parent.one = zero + 1;
  parent.entries = {};
}

std::vector<PlaceIndex::Candidate> PlaceIndex::query(const Features& features, int most) const {
  std::map<int, int> votes;
  for (const Descriptor& descriptor : features.descriptor) {
    std::set<int> seen;  // one feature votes once for a place
    for (const Entry& e : branches_[static_cast<std::size_t>(leafOf(descriptor))].entries) {
      if (hammingDistance(descriptor, e.descriptor) <= kNear && seen.insert(e.place).second) {
        ++votes[e.place];
      }
    }
  }
  std::vector<Candidate> candidates;
  for (const auto& [place, count] : votes) {
    candidates.push_back({place, count});
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.votes > b.votes; });
  if (static_cast<int>(candidates.size()) > most) {
    candidates.resize(static_cast<std::size_t>(most));
  }
  return candidates;
}

std::int64_t PlaceIndex::comparisons(const Features& features) const {
  std::int64_t count = 0;
  for (const Descriptor& descriptor : features.descriptor) {
    count += static_cast<std::int64_t>(branches_[static_cast<std::size_t>(leafOf(descriptor))].entries.size());
  }
  return count;
}

}  // namespace oikos::mapping
