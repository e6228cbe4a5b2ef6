// SPDX-License-Identifier: Apache-2.0
// What may move while a model is registered to a scan.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "core/render/scene.h"

namespace oikos::registration {

/// Columns: how a point of the model moves in `map` with each degree of freedom, as (translation, rotation) about the motion's pivot.
using Twists = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 8>;
/// One number a degree of freedom: m or rad.
using Step = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1>;

struct DegreeOfFreedom {
  std::string name;      ///< "x", "yaw", "joint door-left"
  bool is_turn = false;  ///< rad instead of m
};

/// The estimate in progress: the posed models, where the camera is, and the degrees of freedom between them. A step changes one or the
/// other; the registration itself sees only that the model moves before the scan.
class Motion {
 public:
  virtual ~Motion() = default;

  [[nodiscard]] virtual const std::vector<DegreeOfFreedom>& freedoms() const = 0;
  /// The point about which twists turn, where it is now; near what is seen, so that translation and rotation are nearly independent.
  [[nodiscard]] virtual Eigen::Vector3d pivot_map() const = 0;
  /// Of a part of the scene (index into Scene::parts()) as it stands now; zero for a part that stays.
  [[nodiscard]] virtual Twists twistsOf(int part) const = 0;
  [[nodiscard]] virtual Eigen::Isometry3d T_map_camera() const = 0;
  [[nodiscard]] virtual const render::Scene& scene() const = 0;
  /// Moves on by a step; limits are kept.
  virtual void apply(const Step& step) = 0;
  /// Back to `state`, which saved() gave.
  [[nodiscard]] virtual std::vector<double> saved() const = 0;
  virtual void restore(const std::vector<double>& state) = 0;

  /// The pose of what moves as a whole: of the camera, or of the model.
  [[nodiscard]] virtual Eigen::Isometry3d T_map_moving() const = 0;

  [[nodiscard]] int dimension() const { return static_cast<int>(freedoms().size()); }
};

enum class PoseFreedom {
  kPlanar,  ///< x, y, yaw about map z (S216)
  kRigid,   ///< all six
};

/// The camera moves and the whole scene stays: where was the robot? (S219)
class CameraMotion : public Motion {
 public:
  /// `pivot_camera`: a point about which the camera turns, for instance the robot's middle.
  CameraMotion(const render::Scene& scene, const Eigen::Isometry3d& T_map_camera, PoseFreedom freedom,
               const Eigen::Vector3d& pivot_camera = Eigen::Vector3d::Zero());

  [[nodiscard]] const std::vector<DegreeOfFreedom>& freedoms() const override { return freedoms_; }
  [[nodiscard]] Eigen::Isometry3d T_map_moving() const override { return T_map_camera_; }
  [[nodiscard]] Eigen::Vector3d pivot_map() const override { return T_map_camera_ * pivot_camera_; }
  [[nodiscard]] Twists twistsOf(int part) const override;
  [[nodiscard]] Eigen::Isometry3d T_map_camera() const override { return T_map_camera_; }
  [[nodiscard]] const render::Scene& scene() const override { return scene_; }
  void apply(const Step& step) override;
  [[nodiscard]] std::vector<double> saved() const override;
  void restore(const std::vector<double>& state) override;

 private:
  const render::Scene& scene_;
  Eigen::Isometry3d T_map_camera_;
  Eigen::Vector3d pivot_camera_;
  Twists basis_;
  std::vector<DegreeOfFreedom> freedoms_;
};

/// One model of the scene moves, and what is in its joints: where is the table, how far is the door open?
class ModelMotion : public Motion {
 public:
  struct Pose {
    Eigen::Isometry3d T_map_model = Eigen::Isometry3d::Identity();
    std::vector<double> joint_values;
  };
  struct Freedom {
    bool base = true;                         ///< the whole model
    PoseFreedom kind = PoseFreedom::kPlanar;  ///< of the base
    std::vector<int> joints = {};             ///< indices into the model's joints, kept within their limits
  };

  /// `number`: the model's in the scene. What `articulated` and `scene` hold is read and moved as long as this object lives.
  ModelMotion(render::Scene& scene, int number, const model::ArticulatedModel& articulated, const Eigen::Isometry3d& T_map_camera,
              const Pose& start, Freedom freedom);

  [[nodiscard]] const Pose& pose() const { return pose_; }
  void moveTo(const Pose& pose);

  [[nodiscard]] const std::vector<DegreeOfFreedom>& freedoms() const override { return freedoms_; }
  [[nodiscard]] Eigen::Isometry3d T_map_moving() const override { return pose_.T_map_model; }
  [[nodiscard]] Eigen::Vector3d pivot_map() const override { return pose_.T_map_model * pivot_model_; }
  [[nodiscard]] Twists twistsOf(int part) const override;
  [[nodiscard]] Eigen::Isometry3d T_map_camera() const override { return T_map_camera_; }
  [[nodiscard]] const render::Scene& scene() const override { return scene_; }
  void apply(const Step& step) override;
  [[nodiscard]] std::vector<double> saved() const override;
  void restore(const std::vector<double>& state) override;

 private:
  void updateTwists();

  render::Scene& scene_;
  int number_;
  const model::ArticulatedModel& model_;
  model::Kinematics kinematics_;
  Eigen::Isometry3d T_map_camera_;
  Pose pose_;
  Freedom freedom_;
  Eigen::Vector3d pivot_model_;
  Twists basis_;                     ///< of the base; without columns if it stays
  std::vector<Twists> part_twists_;  ///< one a part of the model
  std::vector<DegreeOfFreedom> freedoms_;
};

/// A twist (translation, rotation in map) about a point as the rigid motion it makes in map.
[[nodiscard]] Eigen::Isometry3d motionAbout(const Eigen::Vector3d& pivot_map, const Eigen::Matrix<double, 6, 1>& twist);

}  // namespace oikos::registration
