// SPDX-License-Identifier: Apache-2.0
#include "core/model/urdf_model.h"

#include <urdf_model/model.h>

#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/model/urdf_document.h"
#include "core/model/urdf_visual.h"

namespace oikos::model {

namespace {

constexpr double kShortestAxis = 1e-6;

class UrdfReader {
 public:
  UrdfReader(std::filesystem::path file, const MeshFileLimits& limits) : file_(std::move(file)), visuals_(file_, limits) {}

  UrdfModel run() {
    const auto robot = parseUrdf(file_);
    result_.model.name = robot->getName();
    for (const auto& [name, link] : robot->links_) {
      index_of_part_[name] = static_cast<int>(result_.model.parts.size());
      TriangleMesh mesh_part = visuals_.meshOf(*link);
      result_.model.parts.push_back({name, mesh_part.empty() ? nullptr : std::make_shared<const TriangleMesh>(std::move(mesh_part))});
    }
    for (const auto& [name, joint] : robot->joints_) {
      addJoint(*joint);
    }
    result_.warnings.insert(result_.warnings.end(), visuals_.warnings().begin(), visuals_.warnings().end());
    checkTree();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const urdf::Joint& joint, const std::string& what) const {
    throw base::Error(base::ErrorCode::kInput, "joint '" + joint.name + "' " + what, file_.string());
  }

  void addJoint(const urdf::Joint& source) {
    ModelJoint joint{.name = source.name, .type = motionOf(source)};
    joint.parent = partOf(source, source.parent_link_name);
    joint.child = partOf(source, source.child_link_name);
    joint.T_parent_joint = toIsometry(source.parent_to_joint_origin_transform);
    if (!joint.T_parent_joint.matrix().allFinite()) {
      fail(source, "has an origin that is not finite");
    }
    if (joint.type != MotionType::kFixed) {
      setMotion(source, joint);
    }
    if (source.mimic) {
      result_.warnings.push_back("joint '" + source.name + "' mimics '" + source.mimic->joint_name + "': here it moves on its own");
    }
    result_.model.joints.push_back(std::move(joint));
  }

  [[nodiscard]] MotionType motionOf(const urdf::Joint& joint) const {
    switch (joint.type) {
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        return MotionType::kRevolute;
      case urdf::Joint::PRISMATIC:
        return MotionType::kPrismatic;
      case urdf::Joint::FIXED:
        return MotionType::kFixed;
      default:
        fail(joint, std::string("is of the type ") + (joint.type == urdf::Joint::FLOATING ? "floating" : "planar") +
                        ": must be revolute, continuous, prismatic or fixed");
    }
  }

  [[nodiscard]] int partOf(const urdf::Joint& joint, const std::string& link) const {
    const auto part = index_of_part_.find(link);
    if (part == index_of_part_.end()) {
      fail(joint, "names the link '" + link + "', which does not exist");
    }
    return part->second;
  }

  void setMotion(const urdf::Joint& source, ModelJoint& joint) const {
    const Eigen::Vector3d axis(source.axis.x, source.axis.y, source.axis.z);
    if (!axis.allFinite() || axis.norm() < kShortestAxis) {
      fail(source, "has an axis without a direction");
    }
    joint.axis_joint = axis.normalized();
    if (source.type == urdf::Joint::CONTINUOUS) {
      joint.lower = -std::numeric_limits<double>::infinity();
      joint.upper = std::numeric_limits<double>::infinity();
      return;
    }
    if (!source.limits) {
      fail(source, "has no limits");
    }
    joint.lower = source.limits->lower;
    joint.upper = source.limits->upper;
    if (!(joint.lower <= joint.upper)) {
      fail(source,
           "has limits from " + base::toText(joint.lower) + " to " + base::toText(joint.upper) + ": the lower must not be above the upper");
    }
  }

  /// What urdfdom lets through, such as a circle beside the tree.
  void checkTree() const {
    try {
      const Kinematics kinematics(result_.model);
    } catch (const base::Error& error) {
      throw base::Error(base::ErrorCode::kInput, error.what(), file_.string());
    }
  }

  std::filesystem::path file_;
  UrdfVisuals visuals_;
  std::map<std::string, int> index_of_part_;
  UrdfModel result_;
};

}  // namespace

UrdfModel readUrdf(const std::filesystem::path& file, const MeshFileLimits& limits) {
  return UrdfReader(file, limits).run();
}

}  // namespace oikos::model
