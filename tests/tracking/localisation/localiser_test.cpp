// SPDX-License-Identifier: Apache-2.0
// A camera that turns out of what is mapped of a room and back.
#include "tracking/localisation/localiser.h"

#include <gtest/gtest.h>

#include "mapping/relocalise/relocaliser.h"
#include "mapping/relocalise/saved_map.h"
#include "tests/mapping/graph/synthetic_drive.h"
#include "tests/mapping/relocalise/saved_room.h"

namespace oikos::tracking {
namespace {

constexpr double kChiSquared = 22.5;  // 6 degrees of freedom, one in a thousand

double normalised(const LocatedPose& pose, const Eigen::Isometry3d& T_map_camera) {
  const geometry::Vector6d xi = geometry::logSe3(pose.T_map_camera.inverse() * T_map_camera);
  return xi.dot(pose.covariance.ldlt().solve(xi));
}

TEST(Localiser, CarriesThePoseOverWhatTheMapDoesNotShow) {
  const mapping::SavedMap map(mapping::savedRoom().file());
  const mapping::Relocaliser relocaliser(map, {}, 7);
  std::vector<Eigen::Isometry3d> poses = mapping::turnAround(160.0, 256.0, 24);
  std::vector<Eigen::Isometry3d> back(poses.rbegin(), poses.rend());
  mapping::append(poses, back);
  const auto drive = mapping::recordingOf(poses, {}, 3);
  Localiser localiser({.camera = drive.camera(), .relocaliser = &relocaliser}, {});
  int carried = 0;
  for (int i = 0; i < drive.frameCount(); ++i) {
    const LocatedPose located = localiser.addUnrefined(drive.read(i, recording::Channels::kGray));
    ASSERT_NE(located.source, PoseSource::kNone) << i;
    EXPECT_LT(normalised(located, drive.truth()[static_cast<std::size_t>(i)].T_map_camera), kChiSquared) << i;
    EXPECT_EQ(located.isFound(), located.source == PoseSource::kMap) << i;
    carried += located.isFound() ? 0 : 1;
    EXPECT_TRUE(located.isFound() || (i > 2 && i < 45)) << i;  // in the map it is found
  }
  EXPECT_GT(carried, 10);
}

TEST(Localiser, NothingIsCarriedFromNowhere) {
  const mapping::SavedMap map(mapping::savedRoom().file());
  const mapping::Relocaliser relocaliser(map, {}, 7);
  const auto unknown = mapping::recordingOf(mapping::turnAround(250.0, 300.0, 3), {}, 2);
  Localiser localiser({.camera = unknown.camera(), .relocaliser = &relocaliser}, {});
  for (int i = 0; i < unknown.frameCount(); ++i) {
    EXPECT_EQ(localiser.add(unknown.read(i, recording::Channels::kGray)).source, PoseSource::kNone) << i;
  }
}

}  // namespace
}  // namespace oikos::tracking
