// SPDX-License-Identifier: Apache-2.0
// Whether a piece of furniture that can be pushed is where it should be: a table that was pushed by a hand's breadth has a top where it
// should have one nearly everywhere, but not along its edges.
#pragma once

#include <map>
#include <set>

#include "tracking/objects/object_sight.h"

namespace oikos::tracking {

/// Along the inner side of a model's outline, where what is behind it can be told from it.
struct EdgeCount {
  int pixels = 0;   ///< of a coarse image, with a reading that is not before the model
  int through = 0;  ///< of these: the reading passed through it

  [[nodiscard]] bool isInPlace(const ObjectSightConfig& config) const {
    return pixels >= config.min_edge_pixels && through <= config.max_edge_through * pixels;
  }
};

/// Of each of these models of the scene, which is at the image's time.
[[nodiscard]] std::map<int, EdgeCount> countEdges(const BelievedScene& scene, const std::set<int>& models, const DepthView& view,
                                                  const ObjectSightConfig& config);

}  // namespace oikos::tracking
