// SPDX-License-Identifier: Apache-2.0
#include "tracking/objects/believed_scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/degrees.h"
#include "core/model/primitives.h"
#include "core/render/camera_rays.h"
#include "semantic/model/placement.h"
#include "tracking/furniture/changed_pieces.h"
#include "tracking/localisation/room_walls.h"

namespace oikos::tracking {

namespace {

using registration::JointSpan;

constexpr double kFloorThickness_m = 0.01;

std::optional<PieceJoints> findJoints(const CarrierReadings& readings, const semantic::ObjectId& id) {
  const auto found = std::find_if(readings.pieces.begin(), readings.pieces.end(), [&](const PieceJoints& one) { return one.id == id; });
  return found == readings.pieces.end() ? std::nullopt : std::optional(*found);
}

const FurniturePlace* findPlace(const CarrierReadings& readings, const semantic::ObjectId& id) {
  const auto found =
      std::find_if(readings.furniture.begin(), readings.furniture.end(), [&](const FurniturePlace& one) { return one.id == id; });
  return found == readings.furniture.end() ? nullptr : &*found;
}

/// That in which the moment lies; nothing: it lies between two, and so does the joint.
const JointSpan* findSpan(const std::vector<JointSpan>& spans, std::int64_t stamp_ns) {
  const auto later = std::find_if(spans.begin(), spans.end(), [&](const JointSpan& span) { return span.first_ns > stamp_ns; });
  if (later == spans.begin()) {
    return spans.empty() ? nullptr : &spans.front();
  }
  const JointSpan& span = *std::prev(later);
  return later == spans.end() || stamp_ns <= span.last_ns ? &span : nullptr;
}

bool hasLook(const semantic::SmallObject& object) {
  return !object.model.empty() || object.shape.has_value();
}

}  // namespace

bool wasMoved(const semantic::LargeObject& object, const CarrierReadings& readings) {
  const FurniturePlace* const place = findPlace(readings, object.id);
  if (place == nullptr) {
    return false;
  }
  const Eigen::Isometry3d T_believed_found = object.T_map_object.toIsometry().inverse() * place->T_map_object;
  return T_believed_found.translation().norm() > readings.max_moved_m ||
         Eigen::AngleAxisd(T_believed_found.linear()).angle() > readings.max_moved_deg * base::kRadPerDeg;
}

BelievedScene::BelievedScene(const semantic::Home& home, const std::filesystem::path& home_folder, const CarrierReadings& readings) {
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    const int floor = room.outline_map.empty() ? -1 : addShell(room);
    for (const semantic::SmallObject& object : room.small_objects) {
      addSmall(object, -1, floor, maker);
    }
    for (const semantic::LargeObject& object : room.objects) {
      if (object.movability != semantic::Movability::kMovable) {
        addPiece(object, readings, maker);
      }
    }
  }
  scene_.commit();
}

/// Walls and the floor, whose number it returns.
int BelievedScene::addShell(const semantic::Room& room) {
  for (const RoomWall& wall : wallsOf(room.outline_map, 0.0)) {
    scene_.add(std::make_shared<const model::TriangleMesh>(wall.mesh_wall), wall.T_map_wall);
  }
  Eigen::AlignedBox3d floor_map;
  for (const Eigen::Vector2d& corner : room.outline_map) {
    floor_map.extend(Eigen::Vector3d(corner.x(), corner.y(), 0.0));
  }
  floor_map.min().z() = -kFloorThickness_m;
  return scene_.add(std::make_shared<const model::TriangleMesh>(model::makeBoxBetween(floor_map.cast<float>())),
                    Eigen::Isometry3d::Identity());
}

void BelievedScene::addPiece(const semantic::LargeObject& object, const CarrierReadings& readings, semantic::ModelMaker& maker) {
  Piece piece;
  piece.object = object;
  piece.found = object.articulation ? findJoints(readings, object.id) : std::nullopt;
  if (piece.found) {
    for (const semantic::Joint& joint : object.articulation->joints) {
      piece.believed.push_back(joint.value);
    }
    piece.is_watchable = !piece.found->is_elsewhere;
  }
  if (const FurniturePlace* const place = findPlace(readings, object.id)) {
    piece.is_watchable = piece.is_watchable && !wasMoved(object, readings);
    piece.object.T_map_object = semantic::Pose::fromIsometry(place->T_map_object);
  }
  piece.model = scene_.add(maker.make(object), piece.object.T_map_object.toIsometry(), semantic::jointValues(object));
  pieces_.push_back(std::move(piece));
  for (const semantic::SmallObject& small : object.small_objects) {
    addSmall(small, static_cast<int>(pieces_.size()) - 1, pieces_.back().model, maker);
  }
}

void BelievedScene::addSmall(const semantic::SmallObject& object, int piece, int carrier_model, semantic::ModelMaker& maker) {
  if (!hasLook(object)) {
    return;
  }
  const model::ArticulatedModel model = maker.make(object);
  Small small{object, 0, piece};
  small.model = scene_.add(model, placeOf(small), {});
  small_.push_back(small);
  const bool is_watchable = piece < 0 || pieces_[static_cast<std::size_t>(piece)].is_watchable;
  if (carrier_model < 0 || !is_watchable) {
    return;
  }
  WatchedObject watched;
  watched.id = object.id;
  watched.placement = {object.parent, object.relation, object.T_parent_object};
  watched.model = small.model;
  watched.carrier_model = carrier_model;
  watched.box_object = boxOf(model, {{}});
  if (piece >= 0) {
    const semantic::LargeObject& carrier = pieces_[static_cast<std::size_t>(piece)].object;
    watched.carrier = carrier.id;
    watched.can_be_pushed = carrier.movability != semantic::Movability::kFixed;
  }
  watched_.push_back(small_.size() - 1);
  objects_.push_back(std::move(watched));
}

Eigen::Isometry3d BelievedScene::placeOf(const Small& small) const {
  const Eigen::Isometry3d T_parent_object = small.object.T_parent_object.toIsometry();
  if (small.piece < 0) {
    return T_parent_object;  // of a room: in map
  }
  const semantic::LargeObject& carrier = pieces_[static_cast<std::size_t>(small.piece)].object;
  const auto T_map_parent = semantic::findCarrierInMap(carrier, small.object.parent);
  return T_map_parent.value_or(carrier.T_map_object.toIsometry()) * T_parent_object;
}

void BelievedScene::goTo(std::int64_t stamp_ns) {
  for (Piece& piece : pieces_) {
    if (!piece.found) {
      continue;
    }
    piece.found_sq.clear();
    auto& joints = piece.object.articulation->joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      joints[j].value = piece.believed[j];
      const auto spans = piece.found->spans.find(joints[j].id);
      const JointSpan* const span = spans == piece.found->spans.end() ? nullptr : findSpan(spans->second, stamp_ns);
      if (span != nullptr && span->status == registration::JointStatus::kFound) {
        joints[j].value = span->value;
        piece.found_sq[joints[j].id.value] = span->variance;
      }
    }
    scene_.move(piece.model, piece.object.T_map_object.toIsometry(), semantic::jointValues(piece.object));
  }
  for (const Small& small : small_) {
    scene_.move(small.model, placeOf(small), {});
  }
  scene_.commit();
}

std::optional<ObjectStand> BelievedScene::stand(std::size_t object) const {
  const Small& small = small_[watched_[object]];
  const std::optional<double> sigma_m = findJointSigma_m(small);
  return sigma_m ? std::optional(ObjectStand{placeOf(small), *sigma_m}) : std::nullopt;
}

/// Through all joints between the part that carries it and the piece's body.
std::optional<double> BelievedScene::findJointSigma_m(const Small& small) const {
  if (small.piece < 0) {
    return 0.0;
  }
  const Piece& piece = pieces_[static_cast<std::size_t>(small.piece)];
  if (!piece.object.articulation) {
    return 0.0;
  }
  const auto& [parts, joints, handles, knobs] = *piece.object.articulation;
  double variance = 0.0;
  semantic::PartId current{small.object.parent};
  for (std::size_t steps = 0; steps < parts.size(); ++steps) {
    const auto part = std::find_if(parts.begin(), parts.end(), [&](const semantic::Part& one) { return one.id == current; });
    if (part == parts.end() || part->parent.value.empty()) {
      break;
    }
    const auto joint = std::find_if(joints.begin(), joints.end(), [&](const semantic::Joint& one) { return one.child == current; });
    if (joint != joints.end()) {
      const auto found = piece.found_sq.find(joint->id.value);
      if (found == piece.found_sq.end()) {
        return std::nullopt;
      }
      const double lever_m = joint->type == semantic::JointType::kRevolute ? small.object.T_parent_object.position_m.norm() : 1.0;
      variance += found->second * lever_m * lever_m;
    }
    current = part->parent;
  }
  return std::sqrt(variance);
}

render::View BelievedScene::view(const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) const {
  render::ViewConfig config;
  config.with_normals = true;
  config.with_parts = true;
  return render::renderView(scene_, render::CameraRays(camera), {T_map_camera, {}}, config);
}

render::View BelievedScene::viewWithout(std::size_t object, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera) {
  scene_.show(objects_[object].model, false);
  scene_.commit();
  render::View without = view(camera, T_map_camera);
  scene_.show(objects_[object].model, true);
  scene_.commit();
  return without;
}

int BelievedScene::modelOf(int part) const {
  return part < 0 ? -1 : scene_.parts()[static_cast<std::size_t>(part)].model;
}

}  // namespace oikos::tracking
