// SPDX-License-Identifier: Apache-2.0
#include "mapping/robot_mount.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <memory>
#include <mutex>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/base/read_file.h"

namespace oikos::mapping {

namespace {

/// urdfdom reports through a global logger that prints by default: this keeps the first message instead.
class CapturedMessages : public console_bridge::OutputHandler {
 public:
  CapturedMessages() { console_bridge::useOutputHandler(this); }
  ~CapturedMessages() override { console_bridge::restorePreviousOutputHandler(); }
  CapturedMessages(const CapturedMessages&) = delete;
  CapturedMessages& operator=(const CapturedMessages&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (first_.empty() && level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) {
      first_ = text;
    }
  }
  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  std::string first_;
};

urdf::ModelInterfaceSharedPtr parseModel(const std::filesystem::path& file) {
  static std::mutex logger_mutex;
  const std::string text = base::readFile(file);
  const std::lock_guard lock(logger_mutex);
  const CapturedMessages messages;
  urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model) {
    throw base::Error(base::ErrorCode::kInput, "is not a valid URDF: " + messages.first(), file.string());
  }
  return model;
}

urdf::LinkConstSharedPtr getLink(const urdf::ModelInterface& model, const std::string& name, const std::filesystem::path& file) {
  if (urdf::LinkConstSharedPtr link = model.getLink(name)) {
    return link;
  }
  std::vector<std::string> names;
  for (const auto& [known, link] : model.links_) {
    names.push_back(known);
  }
  throw base::Error(base::ErrorCode::kInput, "has no link '" + name + "'" + base::didYouMean(name, names), file.string());
}

Eigen::Isometry3d toIsometry(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  result.translation() << pose.position.x, pose.position.y, pose.position.z;
  return result;
}

Eigen::Isometry3d poseInRoot(urdf::LinkConstSharedPtr link) {
  Eigen::Isometry3d T_root_link = Eigen::Isometry3d::Identity();
  for (; link->parent_joint; link = link->getParent()) {
    T_root_link = toIsometry(link->parent_joint->parent_to_joint_origin_transform) * T_root_link;
  }
  return T_root_link;
}

}  // namespace

Eigen::Isometry3d readMount(const std::filesystem::path& urdf, const MountLinks& links) {
  const auto model = parseModel(urdf);
  const Eigen::Isometry3d T_root_base = poseInRoot(getLink(*model, links.base, urdf));
  const Eigen::Isometry3d T_root_camera = poseInRoot(getLink(*model, links.camera, urdf));
  const Eigen::Isometry3d T_base_camera = T_root_base.inverse() * T_root_camera;
  if (!T_base_camera.matrix().allFinite()) {
    throw base::Error(base::ErrorCode::kInput,
                      "a joint between '" + links.base + "' and '" + links.camera + "' has an origin that is not finite", urdf.string());
  }
  return T_base_camera;
}

}  // namespace oikos::mapping
