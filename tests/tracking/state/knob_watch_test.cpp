// SPDX-License-Identifier: Apache-2.0
// A robot drives past an oven while its knobs are turned.
#include "tracking/state/knob_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/model/primitives.h"
#include "core/render/view.h"
#include "semantic/model/home_models.h"
#include "tests/registration/furniture_scan.h"
#include "tracking/state/state_events.h"
#include "tracking/state/state_reader.h"

namespace oikos::tracking {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kFrames = 20;
const std::string kTurned = "oven-knob_1";

semantic::Home homeWithOven() {
  semantic::LargeObject oven;
  oven.id = {"oven"};
  oven.type = "oven";
  oven.shape = semantic::Shape{"oven", {}};
  oven.articulation = semantic::articulationOf(semantic::makeShape(*oven.shape, "oven"), oven.id);
  semantic::Room room;
  room.id = {"kitchen"};
  room.outline_map = {{-0.4, -2.0}, {3.5, -2.0}, {3.5, 2.0}, {-0.4, 2.0}};
  room.objects.emplace_back(oven);
  semantic::Home home;
  home.rooms.push_back(room);
  return home;
}

/// The drive: a knob is turned to `state` before frame `turned_at`.
struct Drive {
  semantic::Home home = homeWithOven();
  std::size_t state = 4;
  int turned_at = kFrames / 2;
  bool is_hidden = false;
  double distance_m = 0.75;
  double misplaced_m = 0.0;  ///< the oven, along its front
  KnobTrackConfig config;

  [[nodiscard]] static LocatedPose poseOf(int frame, double distance_m) {
    LocatedPose pose;
    pose.frame = frame;
    pose.stamp_ns = frame * 200'000'000LL;
    pose.source = PoseSource::kLandmarks;
    pose.T_map_camera = test::cameraBefore(Eigen::Isometry3d::Identity(), distance_m, (-15.0 + 1.5 * frame) * kDegree, 0.85);
    geometry::Vector6d sigma;
    sigma << 0.005, 0.005, 0.005, 0.003, 0.003, 0.003;
    pose.covariance = sigma.cwiseAbs2().asDiagonal();
    return pose;
  }

  [[nodiscard]] camera::RgbdFrame frame(int number, const ArticulatedPiece& piece) const {
    std::vector<double> values = piece.believed.joint_values;
    const auto& model = piece.model;
    for (const model::ModelKnob& knob : model.knobs) {
      for (std::size_t j = 0; j < model.joints.size(); ++j) {
        if (model.joints[j].child == knob.part && knob.name == kTurned && number >= turned_at) {
          values[j] = knob.states[state].angle_rad;
        }
      }
    }
    render::Scene scene;
    Eigen::Isometry3d T_map_oven = Eigen::Isometry3d::Identity();
    T_map_oven.translation().y() = misplaced_m;
    scene.add(model, T_map_oven, values);
    if (is_hidden) {
      scene.add(std::make_shared<const model::TriangleMesh>(model::makeBox({0.02F, 0.9F, 0.25F})),
                Eigen::Isometry3d(Eigen::Translation3d(0.45, 0.0, 0.85)));
    }
    scene.commit();
    render::ViewConfig lit;
    lit.with_color = true;
    lit.lighting.lamps.push_back({Eigen::Vector3d(2.0, 1.0, 2.2), Eigen::Vector3f::Constant(2.0F)});
    const camera::PinholeCamera camera = test::kinectCamera();
    const Eigen::Isometry3d T_map_camera = poseOf(number, distance_m).T_map_camera;
    camera::RgbdFrame frame;
    frame.index = number;
    frame.stamp_ns = poseOf(number, distance_m).stamp_ns;
    frame.color = render::renderView(scene, render::CameraRays(camera), {T_map_camera, {}}, lit).color;
    frame.depth_m = test::sensed(test::viewOf(scene, camera, T_map_camera), camera, camera::DepthSensorKind::kKinect1,
                                 100 + static_cast<std::uint64_t>(number));
    return frame;
  }

  /// By knob; `reads`: pictures.
  [[nodiscard]] std::map<std::string, TrackedKnob> read(int threads = 2, int* reads = nullptr) const {
    StateReader reader(home, {}, test::kinectCamera(), {}, threads);
    KnobWatch watch(reader.pieces(), test::kinectCamera(), config, {}, threads);
    std::map<int, camera::RgbdFrame> frames;
    for (int i = 0; i < kFrames; ++i) {
      frames[i] = frame(i, reader.pieces().front());
      reader.look(frames[i], poseOf(i, distance_m));
      watch.look(frames[i], poseOf(i, distance_m));
    }
    for (std::vector<WantedKnobs> wanted = watch.wanted(); !wanted.empty(); wanted = watch.wanted()) {
      for (const WantedKnobs& one : wanted) {
        EXPECT_EQ(one.pieces, std::vector<int>{0});
        const auto standing = reader.standingIn(frames.at(one.frame), 0);
        EXPECT_TRUE(standing);
        watch.read(frames.at(one.frame), poseOf(one.frame, distance_m).T_map_camera, 0, *standing);
        if (reads != nullptr) {
          ++*reads;
        }
      }
    }
    std::map<std::string, TrackedKnob> knobs;
    for (TrackedKnob& knob : watch.conclude()) {
      knobs[knob.id.value] = knob;
    }
    return knobs;
  }
};

TEST(KnobWatch, FindsTheKnobThatIsTurnedAndItsMoment) {
  const Drive drive;
  int reads = 0;
  const auto knobs = drive.read(2, &reads);
  ASSERT_EQ(knobs.size(), 5U);
  for (const auto& [id, knob] : knobs) {
    EXPECT_EQ(knob.stays.size(), id == kTurned ? 2U : 1U) << id;
    EXPECT_EQ(knob.stays.front().state, 0U) << id;
    EXPECT_TRUE(knob.stays.front().isTold({})) << id;
  }
  const KnobStay& turned = knobs.at(kTurned).stays.back();
  EXPECT_EQ(knobs.at(kTurned).states[turned.state], "4");
  EXPECT_EQ(turned.first_frame, drive.turned_at);  // halved down to the frame
  EXPECT_TRUE(turned.isTold({}));
  EXPECT_LT(reads, kFrames);

  RecordingStates states;
  states.knobs = {knobs.at(kTurned)};
  const std::vector<StateEvent> events = stateEvents(states, drive.home, {"drive", 1'000}, {});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event.kind, semantic::EventKind::kKnob);
  EXPECT_EQ(events[0].event.subject, kTurned);
  EXPECT_EQ(events[0].event.before, semantic::State(semantic::KnobSetting{"0"}));
  EXPECT_EQ(events[0].event.after, semantic::State(semantic::KnobSetting{"4"}));
  EXPECT_EQ(events[0].event.frame, drive.turned_at);
  EXPECT_EQ(events[0].event.time_ns, 1'000 + drive.turned_at * 200'000'000LL);
  EXPECT_EQ(events[0].word, "turned");
  semantic::Home other = drive.home;  // which has no such knob any more
  other.rooms.front().objects.front().edit().articulation->knobs.clear();
  EXPECT_TRUE(stateEvents(states, other, {"drive", 0}, {}).empty());
}

TEST(KnobWatch, ReadsThemWhereTheOvenReallyStands) {
  Drive drive;
  drive.misplaced_m = 0.012;  // half a knob
  drive.turned_at = 0;
  for (const auto& [id, knob] : drive.read()) {
    ASSERT_EQ(knob.stays.size(), 1U) << id;
    EXPECT_EQ(knob.states[knob.stays.front().state], id == kTurned ? "4" : "0") << id;
    EXPECT_TRUE(knob.stays.front().isTold({})) << id;
  }
}

TEST(KnobWatch, LooksOnceMoreWhereOnePictureIsAlone) {
  Drive drive;
  drive.turned_at = 0;
  drive.config.most_frames = 1;
  for (const auto& [id, knob] : drive.read()) {
    ASSERT_EQ(knob.stays.size(), 1U) << id;
    EXPECT_EQ(knob.stays.front().found, 2) << id;
    EXPECT_TRUE(knob.stays.front().isTold({})) << id;
  }
}

/// Of the first pictures one alone shows what it was turned to, which is less than turning costs.
TEST(KnobWatch, LooksBesideThePictureThatDissents) {
  Drive drive;
  drive.turned_at = kFrames - 4;
  const std::vector<KnobStay> stays = drive.read().at(kTurned).stays;
  ASSERT_EQ(stays.size(), 2U);
  EXPECT_EQ(stays.back().state, drive.state);
  EXPECT_EQ(stays.back().first_frame, drive.turned_at);
  EXPECT_TRUE(stays.back().isTold({}));
}

TEST(KnobWatch, WhatIsHiddenOrFarIsNotRead) {
  Drive hidden;
  hidden.is_hidden = true;
  for (const auto& [id, knob] : hidden.read()) {  // what hides them is too near for its depth, so that pictures are looked at
    EXPECT_TRUE(knob.stays.empty()) << id;
    EXPECT_EQ(knob.reason, "no knob where it should be") << id;
  }
  hidden.distance_m = 1.2;
  EXPECT_TRUE(hidden.read().empty());
  Drive far;
  far.distance_m = 2.2;
  EXPECT_TRUE(far.read().empty());
}

TEST(KnobWatch, GivesTheSameForAnyNumberOfThreads) {
  const Drive drive;
  const auto one = drive.read(1);
  const auto three = drive.read(3);
  ASSERT_EQ(one.size(), three.size());
  for (const auto& [id, knob] : one) {
    ASSERT_EQ(knob.stays.size(), three.at(id).stays.size());
    for (std::size_t i = 0; i < knob.stays.size(); ++i) {
      EXPECT_EQ(knob.stays[i].probability, three.at(id).stays[i].probability);
      EXPECT_EQ(knob.stays[i].first_frame, three.at(id).stays[i].first_frame);
    }
  }
}

}  // namespace
}  // namespace oikos::tracking
