// SPDX-License-Identifier: Apache-2.0
#include "tracking/furniture/changed_pieces.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "core/model/triangle_mesh.h"
#include "semantic/model/home_models.h"

namespace oikos::tracking {

namespace {

constexpr double kAround_m = 0.08;  ///< voxels, and errors of map and belief
constexpr double kMostOfIt = 0.6;   ///< share of a change's box
constexpr int kStopsOfAJoint = 5;   ///< between its limits

/// Each joint by itself through its range, the others as they are believed.
std::vector<std::vector<double>> reachOf(const model::ArticulatedModel& model, const std::vector<double>& believed) {
  std::vector<std::vector<double>> all = {believed};
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const double lower = std::max(model.joints[j].lower, -std::numbers::pi);  // of a joint without limits: one turn
    const double upper = std::min(model.joints[j].upper, std::numbers::pi);
    for (int stop = 0; stop < kStopsOfAJoint; ++stop) {
      std::vector<double> values = believed;
      values[j] = lower + (upper - lower) * stop / (kStopsOfAJoint - 1);
      all.push_back(values);
    }
  }
  return all;
}

struct Reach {
  std::string id;
  Eigen::Isometry3d T_map_model;
  Eigen::AlignedBox3d box_model;
};

/// Of a grid of points in the change's box: those within the reach.
double shareWithin(const mapping::Change& change, const Reach& reach) {
  constexpr int kSide = 6;
  const Eigen::Isometry3d T_model_map = reach.T_map_model.inverse();
  int within = 0;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Eigen::Vector3d share = (Eigen::Vector3d(i % kSide, i / kSide % kSide, i / (kSide * kSide)).array() + 0.5) / kSide - 0.5;
    const Eigen::Vector3d point_map = change.center_map + share.cwiseProduct(change.size_m);
    within += reach.box_model.contains(T_model_map * point_map) ? 1 : 0;
  }
  return static_cast<double>(within) / (kSide * kSide * kSide);
}

}  // namespace

Eigen::AlignedBox3d boxOf(const model::ArticulatedModel& model, const std::vector<std::vector<double>>& joint_values) {
  const model::Kinematics kinematics(model);
  Eigen::AlignedBox3d box;
  for (const std::vector<double>& values : joint_values) {
    const std::vector<Eigen::Isometry3d> T_model_part = kinematics.solve(values);
    for (std::size_t p = 0; p < model.parts.size(); ++p) {
      if (model.parts[p].mesh_part) {
        for (const Eigen::Vector3f& vertex : model.parts[p].mesh_part->vertices) {
          box.extend(T_model_part[p] * vertex.cast<double>());
        }
      }
    }
  }
  return box;
}

Eigen::AlignedBox3d reachBoxOf(const model::ArticulatedModel& model, const std::vector<double>& believed) {
  return boxOf(model, reachOf(model, believed));
}

std::vector<std::string> piecesOf(const std::vector<mapping::Change>& changes, const semantic::Home& home,
                                  const std::filesystem::path& home_folder) {
  std::vector<Reach> reaches;
  semantic::ModelMaker maker(home_folder);
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      const model::ArticulatedModel model = maker.make(object);
      const Eigen::AlignedBox3d box = reachBoxOf(model, semantic::jointValues(object));
      const Eigen::Vector3d around = Eigen::Vector3d::Constant(kAround_m);
      reaches.push_back({object.id.value, object.T_map_object.toIsometry(), {box.min() - around, box.max() + around}});
    }
  }
  std::stable_sort(reaches.begin(), reaches.end(),
                   [](const Reach& a, const Reach& b) { return a.box_model.volume() < b.box_model.volume(); });
  std::vector<std::string> pieces;
  for (const mapping::Change& change : changes) {
    const auto found =
        std::find_if(reaches.begin(), reaches.end(), [&](const Reach& reach) { return shareWithin(change, reach) >= kMostOfIt; });
    pieces.push_back(found == reaches.end() ? "" : found->id);
  }
  return pieces;
}

}  // namespace oikos::tracking
