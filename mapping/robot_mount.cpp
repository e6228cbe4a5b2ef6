// SPDX-License-Identifier: Apache-2.0
#include "mapping/robot_mount.h"

#include <urdf_model/model.h>

#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/model/urdf_document.h"

namespace oikos::mapping {

namespace {

urdf::LinkConstSharedPtr getLink(const urdf::ModelInterface& robot, const std::string& name, const std::filesystem::path& file) {
  if (urdf::LinkConstSharedPtr link = robot.getLink(name)) {
    return link;
  }
  std::vector<std::string> names;
  for (const auto& [known, link] : robot.links_) {
    names.push_back(known);
  }
  throw base::Error(base::ErrorCode::kInput, "has no link '" + name + "'" + base::didYouMean(name, names), file.string());
}

Eigen::Isometry3d poseInRoot(urdf::LinkConstSharedPtr link) {
  Eigen::Isometry3d T_root_link = Eigen::Isometry3d::Identity();
  for (; link->parent_joint; link = link->getParent()) {
    T_root_link = model::toIsometry(link->parent_joint->parent_to_joint_origin_transform) * T_root_link;
  }
  return T_root_link;
}

}  // namespace

Eigen::Isometry3d readMount(const std::filesystem::path& urdf, const MountLinks& links) {
  const auto robot = model::parseUrdf(urdf);
  const Eigen::Isometry3d T_root_base = poseInRoot(getLink(*robot, links.base, urdf));
  const Eigen::Isometry3d T_root_camera = poseInRoot(getLink(*robot, links.camera, urdf));
  const Eigen::Isometry3d T_base_camera = T_root_base.inverse() * T_root_camera;
  if (!T_base_camera.matrix().allFinite()) {
    throw base::Error(base::ErrorCode::kInput,
                      "a joint between '" + links.base + "' and '" + links.camera + "' has an origin that is not finite", urdf.string());
  }
  return T_base_camera;
}

}  // namespace oikos::mapping
