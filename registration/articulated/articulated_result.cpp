// SPDX-License-Identifier: Apache-2.0
#include "registration/articulated/articulated_result.h"

#include <algorithm>

namespace oikos::registration {

const JointEstimate* ArticulatedResult::find(const std::string& joint_name) const {
  const auto found = std::find_if(joints.begin(), joints.end(), [&](const JointEstimate& joint) { return joint.name == joint_name; });
  return found == joints.end() ? nullptr : &*found;
}

}  // namespace oikos::registration
