// SPDX-License-Identifier: Apache-2.0
#include "tracking/changes/change_boxes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "tracking/furniture/changed_pieces.h"
#include "tracking/objects/object_sight.h"

namespace oikos::tracking {

namespace {

using mapping::Change;
using mapping::ChangeKind;

constexpr double kNear_m = 0.1;        // voxels, and errors of pose and map
constexpr double kMostOfIt = 0.6;      // of a change's voxels
constexpr int kStep_px = 2;            // of the scans, where the home is rendered
constexpr double kAroundCrop_m = 0.1;  // so that the picture shows where it is

/// A view with the home as it is believed to look in it.
struct BelievedView {
  const ChangeView* view;
  camera::PinholeCamera camera;
  cv::Mat depth_m;
};

std::vector<BelievedView> render(const std::vector<ChangeView>& views, const ExplainedBy& by) {
  BelievedScene scene(by.home, by.home_folder, by.carriers);
  std::vector<BelievedView> believed;
  for (const ChangeView& view : views) {
    scene.goTo(view.stamp_ns);
    const camera::PinholeCamera camera = cropped(view.scan.camera, {0, 0, view.scan.camera.width, view.scan.camera.height}, kStep_px);
    believed.push_back({&view, camera, scene.view(camera, view.scan.T_map_camera).depth_m});
  }
  return believed;
}

/// The home has a surface there.
bool isBelieved(const Eigen::Vector3d& point_map, const BelievedView& believed) {
  const Eigen::Vector3d point_camera = believed.view->scan.T_map_camera.inverse() * point_map;
  if (point_camera.z() < kNear_m || !believed.camera.contains(believed.camera.project(point_camera))) {
    return false;
  }
  const Eigen::Vector2i pixel = believed.camera.project(point_camera).array().round().cast<int>();
  return std::abs(static_cast<double>(believed.depth_m.at<float>(pixel.y(), pixel.x())) - point_camera.z()) <= kNear_m;
}

bool isInHome(const Change& change, const std::vector<BelievedView>& views, const mapping::VoxelLattice& lattice) {
  const auto believed = std::count_if(change.voxels.begin(), change.voxels.end(), [&](mapping::VoxelKey key) {
    const Eigen::Vector3d center_map = lattice.center(key).cast<double>();
    return std::any_of(views.begin(), views.end(), [&](const BelievedView& view) { return isBelieved(center_map, view); });
  });
  return static_cast<double>(believed) >= kMostOfIt * static_cast<double>(change.voxels.size());
}

Eigen::AlignedBox3d boxOf(const Change& change) {
  return {change.center_map - 0.5 * change.size_m, change.center_map + 0.5 * change.size_m};
}

/// By doors and drawers of the piece that were read, or since it was found elsewhere.
bool isOfPieceThatWasRead(const std::string& piece, const ExplainedBy& by) {
  const auto read =
      std::find_if(by.carriers.pieces.begin(), by.carriers.pieces.end(), [&](const PieceJoints& one) { return one.id.value == piece; });
  if (read != by.carriers.pieces.end() && !read->spans.empty()) {
    return true;
  }
  return std::any_of(by.home.rooms.begin(), by.home.rooms.end(), [&](const semantic::Room& room) {
    return std::any_of(room.objects.begin(), room.objects.end(),
                       [&](const semantic::LargeObject& object) { return object.id.value == piece && wasMoved(object, by.carriers); });
  });
}

/// Where in map the objects that were missed should have been, with what is near.
std::vector<Eigen::AlignedBox3d> placesOfMissed(const ExplainedBy& by) {
  const BelievedScene scene(by.home, by.home_folder, by.carriers);
  std::vector<Eigen::AlignedBox3d> places_map;
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    const auto reading =
        std::find_if(by.objects.begin(), by.objects.end(), [&](const ObjectReading& one) { return one.id == scene.objects()[i].id; });
    const auto stand = scene.stand(i);
    if (reading == by.objects.end() || reading->status != WatchStatus::kMissed || !stand) {
      continue;
    }
    Eigen::AlignedBox3d& place = places_map.emplace_back();
    for (int corner = 0; corner < 8; ++corner) {
      place.extend(stand->T_map_object * scene.objects()[i].box_object.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
    place.min().array() -= kNear_m;
    place.max().array() += kNear_m;
  }
  return places_map;
}

/// In how many voxels the view sees the change, and not something before it.
int shownIn(const Change& change, const ChangeView& view, const mapping::VoxelLattice& lattice) {
  const Eigen::Isometry3d T_camera_map = view.scan.T_map_camera.inverse();
  return static_cast<int>(std::count_if(change.voxels.begin(), change.voxels.end(), [&](mapping::VoxelKey key) {
    const Eigen::Vector3d point_camera = T_camera_map * lattice.center(key).cast<double>();
    if (point_camera.z() < kNear_m || !view.scan.camera.contains(view.scan.camera.project(point_camera))) {
      return false;
    }
    const Eigen::Vector2i pixel = view.scan.camera.project(point_camera).array().round().cast<int>();
    return static_cast<double>(view.scan.depth_m.at<float>(pixel.y(), pixel.x())) > point_camera.z() - kNear_m;
  }));
}

ChangeBox withPicture(const Change& change, const std::string& piece, const std::vector<ChangeView>& views,
                      const camera::PinholeCamera& camera, const mapping::VoxelLattice& lattice) {
  ChangeBox box{change, piece, 0, {}};
  int most = -1;
  for (const ChangeView& view : views) {
    const int shown = shownIn(change, view, lattice);
    if (shown > most) {
      most = shown;
      box.frame = view.frame;
      box.crop = pixelsAround(boxOf(change), view.scan.T_map_camera.inverse(), camera, kAroundCrop_m);
    }
  }
  return box;
}

}  // namespace

std::vector<ChangeBox> findChangeBoxes(const mapping::SeenSpace& map, const std::vector<ChangeView>& views, const ExplainedBy& by,
                                       const camera::PinholeCamera& camera, const mapping::ChangeConfig& config) {
  std::vector<mapping::LocatedScan> scans;
  for (const ChangeView& view : views) {
    scans.push_back(view.scan);
  }
  const std::vector<Change> changes = mapping::findChanges(map, scans, config).changes;
  if (changes.empty()) {
    return {};
  }
  const std::vector<std::string> pieces = piecesOf(changes, by.home, by.home_folder);
  const std::vector<BelievedView> believed = render(views, by);
  const std::vector<Eigen::AlignedBox3d> missed_map = placesOfMissed(by);
  std::vector<ChangeBox> boxes;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const Change& change = changes[i];
    const bool is_missed = std::any_of(missed_map.begin(), missed_map.end(),
                                       [&](const Eigen::AlignedBox3d& place) { return place.contains(change.center_map); });
    const bool is_explained =
        change.kind == ChangeKind::kNew ? isInHome(change, believed, map.lattice()) : is_missed || isOfPieceThatWasRead(pieces[i], by);
    if (!is_explained) {
      boxes.push_back(withPicture(change, pieces[i], views, camera, map.lattice()));
    }
  }
  return boxes;
}

}  // namespace oikos::tracking
