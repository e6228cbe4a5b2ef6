// SPDX-License-Identifier: Apache-2.0
// A robot drives past a fridge in the corner of a room with a simulated Kinect, and its doors are read.
#include "tracking/state/state_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/model/primitives.h"
#include "core/render/scene.h"
#include "semantic/model/home_models.h"
#include "tests/registration/furniture_scan.h"
#include "tracking/state/state_events.h"

namespace oikos::tracking {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kFrames = 14;
const test::FurnitureKind kFridge = {"fridge"};

/// A fridge, its hinges beside a wall: a door that is open by 90 degrees lies along it.
semantic::Home homeWithFridge() {
  semantic::LargeObject fridge;
  fridge.id = {"fridge"};
  fridge.type = "fridge";
  fridge.shape = semantic::Shape{"fridge", {}};
  fridge.articulation = semantic::articulationOf(semantic::makeShape(*fridge.shape, "fridge"), fridge.id);
  semantic::Room room;
  room.id = {"kitchen"};
  room.outline_map = {{-0.33, -0.325}, {3.5, -0.325}, {3.5, 3.0}, {-0.33, 3.0}};
  room.objects.emplace_back(fridge);
  semantic::Home home;
  home.rooms.push_back(room);
  return home;
}

void addBox(render::Scene& scene, const Eigen::Vector3f& size, const Eigen::Vector3d& middle) {
  model::TriangleMesh mesh = model::makeBox(size);
  mesh.materials.assign(1, {});
  mesh.materials[0].color_rgb = {0.7F, 0.7F, 0.65F};
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  scene.add(std::make_shared<const model::TriangleMesh>(std::move(mesh)), Eigen::Isometry3d(Eigen::Translation3d(middle)));
}

/// The drive: frame i is taken from another direction, with the doors at `values(i)`.
class Drive {
 public:
  explicit Drive(std::uint64_t seed) : seed_(seed) {
    std::mt19937_64 random(seed);
    real_ = test::trulyBuilt(kFridge, 0.004, random);
  }

  [[nodiscard]] static LocatedPose poseOf(int frame) {
    LocatedPose pose;
    pose.frame = frame;
    pose.stamp_ns = frame * 300'000'000LL;
    pose.source = PoseSource::kLandmarks;
    pose.T_map_camera = test::cameraBefore(Eigen::Isometry3d::Identity(), 2.1, (5.0 + 3.0 * frame) * kDegree, 0.9);
    geometry::Vector6d sigma;
    sigma << 0.005, 0.005, 0.005, 0.003, 0.003, 0.003;
    pose.covariance = sigma.cwiseAbs2().asDiagonal();
    return pose;
  }

  [[nodiscard]] camera::RgbdFrame frame(int number, const std::vector<double>& values) const {
    render::Scene scene;
    scene.add(real_, Eigen::Isometry3d::Identity(), values);
    addBox(scene, {8.0F, 8.0F, 0.1F}, {1.5, 1.5, -0.05});
    addBox(scene, {0.1F, 8.0F, 3.0F}, {-0.38, 1.5, 1.5});
    addBox(scene, {8.0F, 0.1F, 3.0F}, {1.5, -0.375, 1.5});
    scene.commit();
    camera::RgbdFrame frame;
    frame.index = number;
    frame.stamp_ns = poseOf(number).stamp_ns;
    frame.depth_m = test::sensed(test::viewOf(scene, test::kinectCamera(), poseOf(number).T_map_camera), test::kinectCamera(),
                                 camera::DepthSensorKind::kKinect1, 100 * seed_ + static_cast<std::uint64_t>(number));
    return frame;
  }

 private:
  std::uint64_t seed_;
  model::ArticulatedModel real_;
};

using Frames = std::map<int, camera::RgbdFrame>;

RecordingStates readAll(const semantic::Home& home, const Frames& frames, int threads, int* reads = nullptr,
                        const StateConfig& config = {}) {
  StateReader reader(home, {}, test::kinectCamera(), config, threads);
  for (const auto& [number, frame] : frames) {
    reader.look(frame, Drive::poseOf(number));
  }
  for (std::vector<int> wanted = reader.wanted(); !wanted.empty(); wanted = reader.wanted()) {
    std::vector<camera::RgbdFrame> given;
    for (const int number : wanted) {
      given.push_back(frames.at(number));
    }
    reader.read(given);
    if (reads != nullptr) {
      *reads += static_cast<int>(wanted.size());
    }
  }
  RecordingStates states;
  states.pieces = reader.conclude();
  return states;
}

/// The fridge's upper door opens before this frame.
Frames driveOpeningBefore(int opening, double open_rad, std::uint64_t seed) {
  const Drive drive(seed);
  Frames frames;
  for (int i = 0; i < kFrames; ++i) {
    frames[i] = drive.frame(i, {0.0, i >= opening ? open_rad : 0.0});
  }
  return frames;
}

TEST(StateReader, ADoorThatIsOpenedMeanwhileIsOneEventAtItsMoment) {
  constexpr int kOpening = 9;
  const semantic::Home home = homeWithFridge();
  const Frames frames = driveOpeningBefore(kOpening, 55.0 * kDegree, 1);
  int reads = 0;
  const RecordingStates readings = readAll(home, frames, 1, &reads);
  EXPECT_LT(reads, kFrames + 1);  // some of the frames are enough
  const auto events = stateEvents(readings, home, {"drive", 1'000'000'000'000}, {});
  ASSERT_EQ(events.size(), 1U);
  const semantic::Event& event = events[0].event;
  EXPECT_EQ(event.subject, "fridge-door-joint");
  EXPECT_EQ(event.recording, "drive");
  EXPECT_EQ(event.frame, kOpening);
  EXPECT_EQ(event.time_ns, 1'000'000'000'000 + Drive::poseOf(kOpening).stamp_ns);
  ASSERT_TRUE(events[0].last_before);
  EXPECT_EQ(events[0].last_before->frame, kOpening - 1);
  EXPECT_EQ(events[0].last_before->stamp_ns, Drive::poseOf(kOpening - 1).stamp_ns);
  EXPECT_NEAR(std::get<semantic::JointValue>(*event.after).value, 55.0 * kDegree, 2.0 * kDegree);
  EXPECT_TRUE(!readings.pieces[0].joints[1].stays.empty());
  EXPECT_GT(event.confidence, 0.99);
  EXPECT_LT(events[0].crop.left, events[0].crop.right);
}

/// Something stands before the camera meanwhile: these images cannot tell, and the ones at both ends are found.
TEST(StateReader, OpenedOutOfSightItIsToldBetweenTheImagesThatShowIt) {
  const semantic::Home home = homeWithFridge();
  Frames frames = driveOpeningBefore(7, 55.0 * kDegree, 3);
  for (int i = 5; i < 10; ++i) {
    frames[i].depth_m.setTo(0.6F);
  }
  const auto events = stateEvents(readAll(home, frames, 1), home, {"drive", 0}, {});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event.frame, 10);
  ASSERT_TRUE(events[0].last_before);
  EXPECT_EQ(events[0].last_before->frame, 4);
}

/// The moment is that of the first image in which it has left its place.
TEST(StateReader, ADoorThatTakesItsTimeHasLeftItsPlaceFirst) {
  const semantic::Home home = homeWithFridge();
  const Drive drive(4);
  Frames frames;
  for (int i = 0; i < kFrames; ++i) {
    frames[i] = drive.frame(i, {0.0, std::clamp(16.0 * (i - 4), 0.0, 64.0) * kDegree});  // from frame 5 to frame 8
  }
  const auto events = stateEvents(readAll(home, frames, 1), home, {"drive", 0}, {});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].word, "opened");
  EXPECT_NEAR(std::get<semantic::JointValue>(*events[0].event.after).value, 64.0 * kDegree, 2.0 * kDegree);
  EXPECT_EQ(events[0].event.frame, 5);
  ASSERT_TRUE(events[0].last_before);
  EXPECT_EQ(events[0].last_before->frame, 4);
}

/// Of a door that is open for a moment one of the chosen images tells; by itself it might be a misreading.
TEST(StateReader, AnImageThatDisagreesIsLookedIntoOnceMore) {
  const semantic::Home home = homeWithFridge();
  const Drive drive(12);
  Frames frames;
  for (int i = 0; i < kFrames; ++i) {
    frames[i] = drive.frame(i, {0.0, i >= 7 && i <= 9 ? 60.0 * kDegree : 0.0});
  }
  StateConfig config;
  config.frames.most_frames = 4;
  const auto events = stateEvents(readAll(home, frames, 1, nullptr, config), home, {"drive", 0}, {});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].word, "opened");
  EXPECT_EQ(events[0].event.frame, 7);
  EXPECT_EQ(events[1].word, "closed");
  EXPECT_EQ(events[1].event.frame, 10);
}

TEST(StateReader, ClosedDoorsBesideAWallMakeNoEventFromNoise) {
  const semantic::Home home = homeWithFridge();
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    const RecordingStates readings = readAll(home, driveOpeningBefore(kFrames, 0.0, seed), 2);
    ASSERT_EQ(readings.pieces.size(), 1U);
    ASSERT_EQ(readings.pieces[0].joints.size(), 2U);
    for (const JointReading& joint : readings.pieces[0].joints) {
      ASSERT_FALSE(joint.stays.empty());
      EXPECT_TRUE(joint.stays.back().isFound()) << joint.id.value;
      EXPECT_LT(joint.stays.back().span.value, 2.0 * kDegree) << joint.id.value;
    }
    EXPECT_TRUE(stateEvents(readings, home, {"drive", 0}, {}).empty()) << seed;
  }
}

TEST(StateReader, AHomeThatKnowsItAlreadyHearsNothing) {
  semantic::Home home = homeWithFridge();
  home.rooms[0].objects[0].edit().articulation->joints[1].value = 55.0 * kDegree;
  const RecordingStates readings = readAll(home, driveOpeningBefore(0, 55.0 * kDegree, 6), 1);
  EXPECT_TRUE(stateEvents(readings, home, {"drive", 0}, {}).empty());
}

TEST(StateReader, TheSameForAnyNumberOfThreads) {
  const semantic::Home home = homeWithFridge();
  const Frames frames = driveOpeningBefore(5, 80.0 * kDegree, 7);
  const auto one = readAll(home, frames, 1).pieces;
  const auto three = readAll(home, frames, 3).pieces;
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(three.size(), 1U);
  for (std::size_t j = 0; j < 2; ++j) {
    ASSERT_EQ(one[0].joints[j].stays.size(), three[0].joints[j].stays.size());
    for (std::size_t s = 0; s < one[0].joints[j].stays.size(); ++s) {
      EXPECT_EQ(one[0].joints[j].stays[s].span.value, three[0].joints[j].stays[s].span.value);
      EXPECT_EQ(one[0].joints[j].stays[s].span.variance, three[0].joints[j].stays[s].span.variance);
    }
  }
}

TEST(StateReader, WhatIsOutOfViewOrNotLocatedSaysNothing) {
  const semantic::Home home = homeWithFridge();
  const Drive drive(8);
  StateReader reader(home, {}, test::kinectCamera(), {}, 1);
  LocatedPose lost = Drive::poseOf(0);
  lost.source = PoseSource::kNone;
  reader.look(drive.frame(0, {0.0, 0.0}), lost);
  LocatedPose away = Drive::poseOf(1);
  away.T_map_camera.rotate(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY()));
  reader.look(drive.frame(1, {0.0, 0.0}), away);
  EXPECT_TRUE(reader.wanted().empty());
  EXPECT_TRUE(reader.conclude().empty());
}

/// The camera's place with an error, and a deviation that says so.
LocatedPose carriedPose(int frame, double sigma_m, double sigma_rad) {
  LocatedPose pose = Drive::poseOf(frame);
  pose.source = PoseSource::kCarried;
  geometry::Vector6d sigma;
  sigma << sigma_m, sigma_m, sigma_m, sigma_rad, sigma_rad, sigma_rad;
  pose.covariance = sigma.cwiseAbs2().asDiagonal();
  pose.T_map_camera = pose.T_map_camera * geometry::expSe3(0.8 * sigma);
  return pose;
}

TEST(StateReader, ACarriedPoseServesAsFarAsItIsKnown) {
  const semantic::Home home = homeWithFridge();
  const Drive drive(11);
  for (const double sigma_m : {0.015, 0.08}) {
    StateReader reader(home, {}, test::kinectCamera(), {}, 1);
    Frames frames;
    for (const int number : {3, 6, 9}) {
      frames[number] = drive.frame(number, {0.0, 60.0 * kDegree});
      reader.look(frames[number], carriedPose(number, sigma_m, 0.3 * sigma_m));
    }
    std::vector<camera::RgbdFrame> wanted;
    for (const int number : reader.wanted()) {
      wanted.push_back(frames.at(number));
    }
    ASSERT_EQ(wanted.size(), sigma_m < 0.05 ? 3U : 0U);
    reader.read(wanted);
    const auto readings = reader.conclude();
    ASSERT_EQ(readings.size(), wanted.empty() ? 0U : 1U);
    if (!readings.empty()) {
      const JointReading& door = readings[0].joints[1];
      ASSERT_EQ(door.stays.size(), 1U);
      EXPECT_TRUE(door.stays[0].isFound());
      EXPECT_NEAR(door.stays[0].span.value, 60.0 * kDegree, 3.0 * kDegree);
    }
  }
}

/// home.xml has the lower door's handle 25 mm too high; the upper door opens meanwhile.
TEST(StateReader, HandlesAreMeasuredOnTheirDoors) {
  semantic::Home home = homeWithFridge();
  std::vector<semantic::Handle>& handles = home.rooms[0].objects[0].edit().articulation->handles;
  ASSERT_EQ(handles.size(), 2U);
  handles[0].T_part_handle.position_m.z() += 0.025;
  Frames frames;
  const Drive drive(21);
  for (int i = 0; i < kFrames; ++i) {
    frames[i] = drive.frame(i, {0.0, i < 7 ? 0.0 : 40.0 * kDegree});
  }
  const RecordingStates states = readAll(home, frames, 2);
  ASSERT_EQ(states.pieces.size(), 1U);
  ASSERT_EQ(states.pieces[0].handles.size(), 2U);
  for (const HandleReading& handle : states.pieces[0].handles) {
    EXPECT_GE(handle.found.seen, 2) << handle.id;
    const Eigen::Vector3d truth_m(0.0, 0.0, handle.id == handles[0].id ? -0.025 : 0.0);
    EXPECT_LT((handle.off_m - truth_m).norm(), 0.01) << handle.id << " " << handle.off_m.transpose();
    EXPECT_LT(handle.off_rad, 3.0 * kDegree) << handle.id;
  }
}

TEST(StateReader, OneImageAloneIsAReadingButNoEvent) {
  const semantic::Home home = homeWithFridge();
  const Drive drive(9);
  const RecordingStates states = readAll(home, {{4, drive.frame(4, {0.0, 60.0 * kDegree})}}, 1);
  ASSERT_EQ(states.pieces.size(), 1U);
  const JointReading& door = states.pieces[0].joints[1];
  ASSERT_EQ(door.stays.size(), 1U);
  EXPECT_TRUE(door.stays[0].isFound());
  EXPECT_NEAR(door.stays[0].span.value, 60.0 * kDegree, 2.5 * kDegree);
  EXPECT_TRUE(stateEvents(states, home, {"drive", 0}, {}).empty());
  StateConfig lone;
  lone.change.min_images = 1;
  EXPECT_EQ(stateEvents(states, home, {"drive", 0}, lone).size(), 1U);
}

TEST(StateReader, OnePieceOnDemand) {
  const semantic::Home home = homeWithFridge();
  EXPECT_EQ(StateReader(home, {}, test::kinectCamera(), {}, 1, "fridge").pieces().size(), 1U);
  try {
    const StateReader reader(home, {}, test::kinectCamera(), {}, 1, "frige");
    FAIL() << "no error";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("fridge"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace oikos::tracking
