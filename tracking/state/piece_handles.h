// SPDX-License-Identifier: Apache-2.0
// Where the handles of a piece really are (S236-S240), over the images of a recording.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "registration/articulated/articulated_registration.h"
#include "registration/handles/handle_finder.h"
#include "registration/handles/handle_fusion.h"

namespace oikos::tracking {

struct HandleTrackConfig {
  registration::HandleConfig finder;
  registration::HandleFusionConfig fusion;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("finder", finder);
    visitor("fusion", fusion);
  }
  [[nodiscard]] std::vector<std::string> validate() const { return {}; }
};

/// What a recording says of a handle.
struct HandleReading {
  std::string id;
  registration::FusedHandle found;                  ///< on its part
  Eigen::Vector3d off_m = Eigen::Vector3d::Zero();  ///< from where it is believed, in its believed frame (x: away from the front)
  double off_rad = 0.0;                             ///< between the two directions of the grip
};

/// The handles of one model; recessed ones are left out, as nothing is to be seen of them. Not thread-safe.
class PieceHandles {
 public:
  /// Throws as registration::HandleFinder.
  PieceHandles(const model::ArticulatedModel& model, const HandleTrackConfig& config);

  /// An image in which the piece was registered: the handles of the base and of doors and drawers that were found in it.
  void add(const registration::DepthView& view, const registration::ArticulatedResult& registered);

  /// Those that an image was to show, in the model's order.
  [[nodiscard]] std::vector<HandleReading> conclude() const;

 private:
  [[nodiscard]] bool isPlaced(int part, const registration::ArticulatedResult& registered) const;

  model::ArticulatedModel model_;  ///< without meshes
  int root_ = 0;
  registration::HandleFinder finder_;
  std::vector<int> parts_;                           ///< that carry handles, ascending
  std::vector<registration::HandleFusion> fusions_;  ///< by handle of the model
};

}  // namespace oikos::tracking
