// SPDX-License-Identifier: Apache-2.0
// What the front end's files share about the frame at hand.
#pragma once

#include <memory>
#include <optional>

#include "mapping/graph/front_end.h"

namespace oikos::mapping {

/// The frame that is being added.
struct FrontEnd::Current {
  const camera::RgbdFrame& frame;
  std::shared_ptr<const ImagePyramid> pyramid;
  std::optional<Features> features;

  const Features& getFeatures(const camera::PinholeCamera& camera, const FeatureConfig& config) {
    if (!features) {
      features = extractFeatures(frame, camera, config);
    }
    return *features;
  }
};

/// An old place that was recognised in it.
struct FrontEnd::Revisit {
  int node = -1;
  FollowResult seen;     ///< in the old node's world
  double overlap = 0.0;  ///< share of the old node's landmarks that are seen again
};

}  // namespace oikos::mapping
