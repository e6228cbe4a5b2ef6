// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_family.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <memory>

namespace oikos::tags {

namespace {

const apriltag_family_t& family() {
  static const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> instance(tag36h11_create(), tag36h11_destroy);
  return *instance;
}

}  // namespace

int tagFamilySize() {
  return static_cast<int>(family().ncodes);
}

std::vector<cv::Point> whiteCells(int id) {
  const apriltag_family_t& tags = family();
  std::vector<cv::Point> cells;
  for (std::uint32_t bit = 0; bit < tags.nbits; ++bit) {
    if ((tags.codes[id] >> (tags.nbits - 1 - bit) & 1U) != 0) {  // the first bit is the highest
      cells.emplace_back(static_cast<int>(tags.bit_x[bit]), static_cast<int>(tags.bit_y[bit]));
    }
  }
  return cells;
}

}  // namespace oikos::tags
