// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mapping/odometry/features.h"

namespace oikos::mapping {

/// Finds earlier places by their features: a binary search tree over descriptors, one bit a branch, that grows with the drive and
/// needs no vocabulary (Schlegel & Grisetti, "HBST", RA-L 2018). Adding or asking for one image costs O(features * log(all)).
class PlaceIndex {
 public:
  struct Candidate {
    int place = -1;
    int votes = 0;  ///< features of the query that have a near descriptor of this place
  };

  void add(int place, const Features& features);
  /// Places by votes, most first, then by number; at most `most`.
  [[nodiscard]] std::vector<Candidate> query(const Features& features, int most) const;
  /// How many descriptors query() compares with those of the image: what it costs.
  [[nodiscard]] std::int64_t comparisons(const Features& features) const;

 private:
  struct Entry {
    Descriptor descriptor;
    int place;
  };
  struct Branch {
    int bit = -1;  ///< -1: a leaf
    int zero = -1;
    int one = -1;
    std::vector<Entry> entries;
  };
  [[nodiscard]] int leafOf(const Descriptor& descriptor) const;
  void insert(const Entry& entry);
  void split(int branch);

  std::vector<Branch> branches_ = std::vector<Branch>(1);
};

}  // namespace oikos::mapping
