// SPDX-License-Identifier: Apache-2.0
// The home as it is believed to look at a moment of a recording, with its small objects.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/render/scene.h"
#include "core/render/view.h"
#include "registration/articulated/joint_fusion.h"
#include "semantic/model/home.h"
#include "semantic/model/home_models.h"
#include "tracking/furniture/furniture_places.h"

namespace oikos::tracking {

/// What a recording has found of a piece's doors and drawers.
struct PieceJoints {
  semantic::ObjectId id;
  bool is_elsewhere = false;                                                ///< the piece is not where it is believed to be
  std::map<semantic::JointId, std::vector<registration::JointSpan>> spans;  ///< in the order of time; indices mean nothing here
};

/// What it has found of all that carries small objects.
struct CarrierReadings {
  std::vector<PieceJoints> pieces;
  std::vector<FurniturePlace> furniture;
  double max_moved_m = 0.04;  ///< a piece that was found farther from where it is believed to stand has been moved,
  double max_moved_deg = 3.0;
};

/// Whether the recording has found the piece, elsewhere than where it is believed to stand.
[[nodiscard]] bool wasMoved(const semantic::LargeObject& object, const CarrierReadings& readings);

/// A small object with a model or a shape of its own, that stands on or in something whose place is known.
struct WatchedObject {
  semantic::ObjectId id;
  semantic::Placement placement;  ///< where it is looked for
  semantic::ObjectId carrier;     ///< a piece of furniture; empty: a room's floor
  bool can_be_pushed = false;     ///< the carrier
  int model = 0;                  ///< number in the scene,
  int carrier_model = 0;          ///< and that of the carrier
  Eigen::AlignedBox3d box_object;
};

/// Where it should be at a moment.
struct ObjectStand {
  Eigen::Isometry3d T_map_object = Eigen::Isometry3d::Identity();
  double joint_sigma_m = 0.0;  ///< what the readings of the joints that carry it leave open
};

/// Fixed and shiftable furniture, small objects, walls and floors. Joints stand where the recording has found them, else where they are
/// believed to. Not thread-safe.
class BelievedScene {
 public:
  /// Left out of `objects()` is what stands on or in a piece that is movable, was found elsewhere than believed, or is not there. Throws
  /// Error for a model that cannot be made.
  BelievedScene(const semantic::Home& home, const std::filesystem::path& home_folder, const CarrierReadings& readings);

  /// In the home's order.
  [[nodiscard]] const std::vector<WatchedObject>& objects() const { return objects_; }

  /// Brings all joints to where they stood at that time of the recording.
  void goTo(std::int64_t stamp_ns);
  /// At that time; nothing: a joint that carries it was not found then.
  [[nodiscard]] std::optional<ObjectStand> stand(std::size_t object) const;

  /// Depth, normals and parts.
  [[nodiscard]] render::View view(const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) const;
  /// The same as if the object were not there.
  [[nodiscard]] render::View viewWithout(std::size_t object, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera);
  /// Of each part in a view; -1: none.
  [[nodiscard]] int modelOf(int part) const;

 private:
  /// A piece of furniture as it stands now.
  struct Piece {
    semantic::LargeObject object;
    int model = 0;
    bool is_watchable = true;                ///< it stands where it is believed to
    std::optional<PieceJoints> found;        ///< nothing: the recording says nothing of its joints
    std::vector<double> believed;            ///< value of each joint
    std::map<std::string, double> found_sq;  ///< variance of each joint that was found at this time
  };
  struct Small {
    semantic::SmallObject object;
    int model = 0;
    int piece = -1;  ///< that carries it; -1: a floor
  };

  void addPiece(const semantic::LargeObject& object, const CarrierReadings& readings, semantic::ModelMaker& maker);
  void addSmall(const semantic::SmallObject& object, int piece, int carrier_model, semantic::ModelMaker& maker);
  int addShell(const semantic::Room& room);
  [[nodiscard]] Eigen::Isometry3d placeOf(const Small& small) const;
  [[nodiscard]] std::optional<double> findJointSigma_m(const Small& small) const;

  render::Scene scene_;
  std::vector<Piece> pieces_;
  std::vector<Small> small_;
  std::vector<std::size_t> watched_;  ///< index in small_ of each of objects_
  std::vector<WatchedObject> objects_;
};

}  // namespace oikos::tracking
