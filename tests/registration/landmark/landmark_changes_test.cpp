// SPDX-License-Identifier: Apache-2.0
// Furniture that is not as it is believed to be, and what stands before it: what is left out, and what it does to the camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "registration/landmark/landmark_refiner.h"
#include "tests/registration/landmark/landmark_room.h"

namespace oikos::registration {
namespace {

const LandmarkContribution* find(const LandmarkRefinement& result, const std::string& id) {
  const auto found = std::find_if(result.landmarks.begin(), result.landmarks.end(), [&](const auto& piece) { return piece.id == id; });
  return found == result.landmarks.end() ? nullptr : &*found;
}
LandmarkVerdict verdictOf(const LandmarkRefinement& result, const std::string& id) {
  const LandmarkContribution* piece = find(result, id);
  EXPECT_NE(piece, nullptr) << id;
  return piece == nullptr ? LandmarkVerdict::kHidden : piece->verdict;
}

TEST(LandmarkRefiner, AShiftedFridgeIsLeftOut) {
  for (const double shift_m : {0.06, 0.12, 0.4}) {
    Room room;
    LandmarkScene scene = room.believed();
    room.piece("fridge").T_map_model.translation().x() -= shift_m;
    room.sensor = camera::DepthSensorKind::kKinect1;
    const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
    ASSERT_EQ(result.status, RefinementStatus::kRefined) << shift_m;
    EXPECT_EQ(verdictOf(result, "fridge"), LandmarkVerdict::kMoved) << shift_m;
    EXPECT_EQ(verdictOf(result, "cabinet"), LandmarkVerdict::kUsed) << shift_m;
    EXPECT_EQ(verdictOf(result, "drawers"), LandmarkVerdict::kUsed) << shift_m;
    const PoseError error = between(result.T_map_camera, room.T_map_camera);
    EXPECT_LT(error.metres, 0.015) << shift_m;
    EXPECT_LT(error.degrees, 0.4) << shift_m;
  }
}

/// Pushed to the other side it hides where its side should be: nothing contradicts, and nothing is spoilt.
TEST(LandmarkRefiner, AShiftThatHidesItselfDoesNoHarm) {
  Room room;
  LandmarkScene scene = room.believed();
  room.piece("fridge").T_map_model.translation().x() += 0.12;
  room.sensor = camera::DepthSensorKind::kKinect1;
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.015);
}

TEST(LandmarkRefiner, AFridgePulledForwardIsLeftOut) {
  Room room;
  LandmarkScene scene = room.believed();
  room.piece("fridge").T_map_model.translation().y() -= 0.08;
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  EXPECT_NE(verdictOf(result, "fridge"), LandmarkVerdict::kUsed);  // its side is where it was, its doors are not
  EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.01);
}

/// Chairs that someone has called fixed.
TEST(LandmarkRefiner, ASwappedPairOfChairsIsLeftOut) {
  Room room;
  const test::FurnitureKind high{"chair", {{"height_m", "1.1"}, {"seat_height_m", "0.6"}}};
  room.pieces.push_back({"chair", {"chair"}, onFloor(-0.5, 1.9, 20.0)});
  room.pieces.push_back({"high-chair", high, onFloor(0.5, 1.9, -50.0)});
  LandmarkScene scene = room.believed();
  std::swap(room.piece("chair").T_map_model, room.piece("high-chair").T_map_model);
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  EXPECT_EQ(verdictOf(result, "chair"), LandmarkVerdict::kMoved);
  EXPECT_EQ(verdictOf(result, "high-chair"), LandmarkVerdict::kMoved);
  EXPECT_EQ(verdictOf(result, "fridge"), LandmarkVerdict::kUsed);
  EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.01);
}

TEST(LandmarkRefiner, AnOpenDoorIsLeftOutAndItsCabinetKept) {
  for (const double angle_deg : {20.0, 60.0, 95.0}) {
    Room room;
    LandmarkScene scene = room.believed();
    const model::ArticulatedModel cabinet = test::believed({"cabinet"});
    room.piece("cabinet").joint_values.assign(cabinet.joints.size(), 0.0);
    for (std::size_t j = 0; j < cabinet.joints.size(); ++j) {
      if (cabinet.joints[j].type == model::MotionType::kRevolute && cabinet.joints[j].name.find("door") != std::string::npos) {
        room.piece("cabinet").joint_values[j] = angle_deg * kDegree;
      }
    }
    const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
    ASSERT_EQ(result.status, RefinementStatus::kRefined) << angle_deg;
    EXPECT_NE(verdictOf(result, "cabinet"), LandmarkVerdict::kMoved) << angle_deg;
    ASSERT_NE(find(result, "cabinet"), nullptr);
    EXPECT_FALSE(find(result, "cabinet")->dropped_parts.empty()) << angle_deg;
    EXPECT_LT(between(result.T_map_camera, room.T_map_camera).metres, 0.01) << angle_deg;
  }
}

TEST(LandmarkRefiner, APersonBeforeThemHidesAndDoesNotContradict) {
  for (const double x : {-0.6, 0.0, 0.5}) {
    Room room;
    LandmarkScene scene = room.believed();
    room.people = {onFloor(x, 0.9, 30.0)};
    room.sensor = camera::DepthSensorKind::kKinect1;
    const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
    ASSERT_EQ(result.status, RefinementStatus::kRefined) << x;
    for (const LandmarkContribution& piece : result.landmarks) {
      EXPECT_NE(piece.verdict, LandmarkVerdict::kMoved) << piece.id << " " << x << " contradiction " << piece.contradiction << " pixels "
                                                        << piece.pixels << " agreeing " << piece.agreeing;
    }
    const PoseError error = between(result.T_map_camera, room.T_map_camera);
    EXPECT_LT(error.metres, 0.015) << x;
    EXPECT_LT(error.degrees, 0.4) << x;
  }
}

/// Books, boxes and chairs hide what is behind them; they are no sign that it has been moved.
TEST(LandmarkRefiner, ClutterBeforeThemDoesNotContradict) {
  Room room;
  LandmarkScene scene = room.believed();
  for (int i = 0; i < 12; ++i) {
    const double along_m = -1.3 + 0.2 * i;
    room.boxes.push_back(Eigen::Translation3d(0.0, 0.0, 0.2 + 0.15 * (i % 4)) * onFloor(along_m, 2.6 - 0.02 * (i % 3), 10.0 * i));
  }
  room.sensor = camera::DepthSensorKind::kKinect1;
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), priorOff(room.T_map_camera, 0.04, 0.03, 2.0), {});
  ASSERT_EQ(result.status, RefinementStatus::kRefined);
  for (const LandmarkContribution& piece : result.landmarks) {
    EXPECT_NE(piece.verdict, LandmarkVerdict::kMoved) << piece.id << " contradiction " << piece.contradiction;
  }
  const PoseError error = between(result.T_map_camera, room.T_map_camera);
  EXPECT_LT(error.metres, 0.015);
  EXPECT_LT(error.degrees, 0.4);
}

TEST(LandmarkRefiner, WhereMostHasBeenMovedTheAnswerIsRefused) {
  Room room;
  LandmarkScene scene = room.believed();
  room.piece("fridge").T_map_model.translation().x() -= 0.15;
  room.piece("cabinet").T_map_model.translation().y() -= 0.12;
  room.piece("drawers").T_map_model = room.piece("drawers").T_map_model * onFloor(0.05, 0.1, 20.0);
  const CameraPrior prior = priorOff(room.T_map_camera, 0.02, 0.01, 1.0);
  const LandmarkRefinement result = refineByLandmarks(scene, room.scan(), prior, {});
  EXPECT_EQ(result.status, RefinementStatus::kInconsistent);
  EXPECT_EQ(result.T_map_camera.matrix(), prior.T_map_camera.matrix());
}

}  // namespace
}  // namespace oikos::registration
