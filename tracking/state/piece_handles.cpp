// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/piece_handles.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace oikos::tracking {

namespace {

using registration::HandleStatus;

/// Also that it is hidden, or that there is none: what was looked at.
bool wasLookedAt(const registration::FusedHandle& handle) {
  return handle.images > 0 && handle.status != HandleStatus::kNotInView;
}

}  // namespace

PieceHandles::PieceHandles(const model::ArticulatedModel& model, const HandleTrackConfig& config)
    : model_(model), root_(model::Kinematics(model).root()), finder_(model, config.finder) {
  std::set<int> parts;
  for (const model::ModelHandle& handle : model_.handles) {
    fusions_.emplace_back(config.fusion);
    if (handle.kind != model::HandleKind::kRecessed) {
      parts.insert(handle.part);
    }
  }
  parts_.assign(parts.begin(), parts.end());
  for (model::ModelPart& part : model_.parts) {
    part.mesh_part = nullptr;
  }
}

bool PieceHandles::isPlaced(int part, const registration::ArticulatedResult& registered) const {
  if (registered.status != registration::BaseStatus::kRegistered) {
    return false;
  }
  return part == root_ || std::any_of(registered.joints.begin(), registered.joints.end(), [&](const registration::JointEstimate& joint) {
           return model_.joints[static_cast<std::size_t>(joint.joint)].child == part && joint.status == registration::JointStatus::kFound;
         });
}

void PieceHandles::add(const registration::DepthView& view, const registration::ArticulatedResult& registered) {
  for (const int part : parts_) {
    if (!isPlaced(part, registered)) {
      continue;
    }
    for (const registration::HandleEstimate& estimate : finder_.find(view, part, registered.T_map_part[static_cast<std::size_t>(part)])) {
      if (estimate.status != HandleStatus::kRecessed) {
        fusions_[static_cast<std::size_t>(estimate.handle)].add(estimate);
      }
    }
  }
}

std::vector<HandleReading> PieceHandles::conclude() const {
  std::vector<HandleReading> readings;
  for (std::size_t i = 0; i < fusions_.size(); ++i) {
    HandleReading reading{model_.handles[i].name, fusions_[i].result(), Eigen::Vector3d::Zero(), 0.0};
    if (!wasLookedAt(reading.found)) {
      continue;
    }
    const Eigen::Isometry3d T_believed_found = model_.handles[i].T_part_handle.inverse() * reading.found.T_part_handle;
    reading.off_m = T_believed_found.translation();
    reading.off_rad = std::acos(std::clamp(std::abs(T_believed_found.linear()(2, 2)), 0.0, 1.0));  // the grip has no ends
    readings.push_back(std::move(reading));
  }
  return readings;
}

}  // namespace oikos::tracking
