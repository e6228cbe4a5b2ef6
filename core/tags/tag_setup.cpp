// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_setup.h"

#include <algorithm>

#include "core/base/config.h"
#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/geometry/pose_numbers.h"

namespace oikos::tags {

namespace {

std::optional<Eigen::Isometry3d> findPose(const std::vector<double>& numbers) {
  std::array<double, 7> n{};
  if (numbers.size() != n.size()) {
    return std::nullopt;
  }
  std::copy(numbers.begin(), numbers.end(), n.begin());
  return geometry::poseFromNumbers(n);
}

std::string listed(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) {
    text += (text.empty() ? "[" : ", ") + base::toText(number);
  }
  return text.empty() ? "[]" : text + "]";
}

}  // namespace

std::vector<std::string> TagSetup::validate() const {
  std::vector<std::string> messages;
  const auto requirePose = [&](const char* key, const std::vector<double>& numbers) {
    if (!findPose(numbers)) {
      messages.push_back(std::string(key) + " = " + listed(numbers) +
                         ": must be seven finite numbers tx, ty, tz (m), qx, qy, qz, qw, the quaternion of norm 1 (within 0.001)");
    }
  };
  requirePose("T_map_camera", T_map_camera);
  requirePose("T_base_board", T_base_board);
  return messages;
}

TagSetup readTagSetup(const std::filesystem::path& file) {
  return base::loadConfig<TagSetup>({file, {}});
}

Eigen::Isometry3d poseOf(const std::vector<double>& numbers) {
  const std::optional<Eigen::Isometry3d> pose = findPose(numbers);
  OIKOS_CHECK(pose.has_value());
  return *pose;
}

std::vector<double> numbersOf(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  return {T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()};
}

}  // namespace oikos::tags
