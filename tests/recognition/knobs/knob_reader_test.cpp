// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/knob_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/furniture/appliances.h"
#include "core/model/primitives.h"
#include "core/render/view.h"
#include "tests/support/config_rules_check.h"
#include "tests/support/enum_table_check.h"

namespace oikos::recognition {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
const camera::PinholeCamera kCamera = {640, 480, 525.0, 525.0, 319.5, 239.5};

/// The place is found to half a pixel of a template, 1/28 of the radius: 2 degrees each way at the mark.
constexpr double kTolerance_deg = 4.0;

/// An oven (front towards +x) in a bright kitchen, its middle knob turned; looked at from before it.
class OvenPicture {
 public:
  OvenPicture() : oven(model::makeOven({})), knob(describeKnob(oven, 2)) {}

  model::ArticulatedModel oven;
  KnobDescription knob;
  double angle_rad = 0.0;
  double distance_m = 0.6;
  double tilt_deg = 20.0;   ///< off the panel's normal
  double aside_deg = 35.0;  ///< of the camera, about that normal

  [[nodiscard]] KnobPicture take() const {
    render::Scene scene;
    std::vector<double> values(oven.joints.size(), 0.0);
    for (std::size_t i = 0; i < oven.joints.size(); ++i) {
      values[i] = oven.joints[i].child == oven.knobs[2].part ? angle_rad : 0.0;
    }
    scene.add(oven, Eigen::Isometry3d::Identity(), values);
    scene.commit();
    render::ViewConfig config;
    config.with_color = true;
    config.lighting.lamps.push_back({Eigen::Vector3d(2.0, 1.0, 2.2), Eigen::Vector3f::Constant(2.0F)});
    KnobPicture picture;
    picture.camera = kCamera;
    picture.T_camera_part = T_oven_camera().inverse();
    picture.color = render::renderView(scene, render::CameraRays(kCamera), {T_oven_camera(), {}}, config).color;
    return picture;
  }

 private:
  [[nodiscard]] Eigen::Isometry3d T_oven_camera() const {
    const double across = std::sin(tilt_deg * kDegree);
    const Eigen::Vector3d away(std::cos(tilt_deg * kDegree), across * std::cos(aside_deg * kDegree),
                               across * std::sin(aside_deg * kDegree));
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(away).normalized();
    T.linear() << right, (-away).cross(right), -away;
    T.translation() = knob.T_part_knob.translation() + distance_m * away;
    return T;
  }
};

double errorDeg(const KnobReading& reading, double angle_rad) {
  return std::abs(std::remainder(reading.angle_rad - angle_rad, 2.0 * std::numbers::pi)) / kDegree;
}

TEST(KnobReader, ReadsAllStatesOfAnOvensKnob) {
  OvenPicture oven;
  KnobReader reader(oven.knob, {});
  for (std::size_t state = 0; state < oven.knob.states.size(); ++state) {
    oven.angle_rad = oven.knob.states[state].angle_rad;
    const KnobReading reading = reader.read(oven.take());
    ASSERT_EQ(reading.status, KnobStatus::kRead) << state << ": " << reading.reason;
    EXPECT_EQ(reading.state, state);
    EXPECT_GT(reading.probability, 0.9);
    EXPECT_LT(errorDeg(reading, oven.angle_rad), kTolerance_deg) << state;
    EXPECT_LT(reading.sigma_rad, 8.0 * kDegree);
  }
}

TEST(KnobReader, ReadsFromAllSides) {
  OvenPicture oven;
  oven.angle_rad = 120.0 * kDegree;
  KnobReader reader(oven.knob, {});
  for (const double aside_deg : {-140.0, -60.0, 30.0, 90.0, 170.0}) {
    oven.aside_deg = aside_deg;
    oven.tilt_deg = 45.0;
    const KnobReading reading = reader.read(oven.take());
    EXPECT_EQ(reading.status, KnobStatus::kRead) << aside_deg << ": " << reading.reason;
    EXPECT_LT(errorDeg(reading, oven.angle_rad), kTolerance_deg) << aside_deg;
  }
}

TEST(KnobReader, ForgivesAWrongRegistration) {
  OvenPicture oven;
  oven.angle_rad = 60.0 * kDegree;
  KnobPicture picture = oven.take();
  picture.T_camera_part = picture.T_camera_part * Eigen::Translation3d(0.004, -0.008, 0.006);
  KnobReader reader(oven.knob, {});
  const KnobReading reading = reader.read(picture);
  EXPECT_EQ(reading.status, KnobStatus::kRead) << reading.reason;
  EXPECT_EQ(reading.state, std::optional<std::size_t>(2));
  // It says where the knob really is.
  const KnobPicture right = oven.take();
  const Eigen::Vector3d face_camera = right.T_camera_part * oven.knob.T_part_knob * reader.face().T_knob_face.translation();
  EXPECT_LT((reading.centre_px - kCamera.project(face_camera)).norm(), 0.15 * reading.diameter_px);
}

TEST(KnobReader, HalfWayBetweenStatesItCannotTell) {
  OvenPicture oven;
  oven.angle_rad = 75.0 * kDegree;
  KnobReader reader(oven.knob, {});
  const KnobReading reading = reader.read(oven.take());
  EXPECT_EQ(reading.status, KnobStatus::kCannotTell);
  EXPECT_FALSE(reading.reason.empty());
  EXPECT_LT(errorDeg(reading, oven.angle_rad), kTolerance_deg);
}

/// As the oven's knob, with nothing that tells its angle.
std::shared_ptr<const model::TriangleMesh> knobWithoutMark() {
  model::TriangleMesh bare = model::makeCylinder({.radius_m = 0.021F, .length_m = 0.02F, .segments = 48});
  model::Material dark;
  dark.color_rgb = Eigen::Vector3f::Constant(0.17F);
  bare.materials = {dark};
  model::TriangleMesh mesh_part;
  model::append(
      mesh_part, bare,
      Eigen::Translation3d(0.01, 0.0, 0.0) * Eigen::Isometry3d(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitY())));
  return std::make_shared<const model::TriangleMesh>(mesh_part);
}

TEST(KnobReader, WithoutAMarkItCannotTell) {
  OvenPicture oven;
  oven.oven.parts[static_cast<std::size_t>(oven.oven.knobs[2].part)].mesh_part = knobWithoutMark();
  oven.knob = describeKnob(oven.oven, 2);
  KnobReader reader(oven.knob, {});
  const KnobReading reading = reader.read(oven.take());
  EXPECT_NE(reading.status, KnobStatus::kRead);
  EXPECT_LT(reading.probability, 0.5);
}

/// What is known of the oven's knob is its size; from the front and near, turned by `angle_rad`, a photograph is taken.
KnobReader readerByPhoto(double angle_rad) {
  OvenPicture installed;
  installed.angle_rad = angle_rad;
  installed.distance_m = 0.25;  // 88 px
  installed.tilt_deg = 8.0;
  installed.aside_deg = 100.0;
  model::ArticulatedModel unmarked = installed.oven;
  unmarked.parts[static_cast<std::size_t>(unmarked.knobs[2].part)].mesh_part = knobWithoutMark();
  return {describeKnob(unmarked, 2), {}, shippedDetector(), KnobPhoto{installed.take(), angle_rad}};
}

TEST(KnobReader, APhotographTellsWhatTheModelDoesNot) {
  OvenPicture oven;
  for (const double of_photo_rad : {0.0, 100.0 * kDegree}) {
    KnobReader reader = readerByPhoto(of_photo_rad);
    for (std::size_t state = 0; state < oven.knob.states.size(); ++state) {
      oven.angle_rad = oven.knob.states[state].angle_rad;
      const KnobReading reading = reader.read(oven.take());
      ASSERT_EQ(reading.status, KnobStatus::kRead) << state << ": " << reading.reason;
      EXPECT_EQ(reading.state, state);
      // The mark's edge in the photograph is told to a fraction of a template's pixel, too.
      EXPECT_LT(errorDeg(reading, oven.angle_rad), 1.5 * kTolerance_deg) << state;
    }
  }
}

TEST(KnobReader, RefusesAPhotographThatDoesNotShowTheKnob) {
  OvenPicture oven;
  KnobPhoto photo{oven.take(), 0.0};
  photo.picture.T_camera_part = Eigen::Translation3d(0.6, 0.0, 0.0) * photo.picture.T_camera_part;
  try {
    const KnobReader reader(oven.knob, {}, shippedDetector(), photo);
    FAIL() << "it was taken";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("the photograph of knob '" + oven.knob.name + "'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("out of the picture"), std::string::npos) << error.what();
  }
}

TEST(KnobReader, AKnobThatIsGoneIsNotFound) {
  OvenPicture oven;
  KnobReader reader(oven.knob, {});
  oven.oven.parts[static_cast<std::size_t>(oven.oven.knobs[2].part)].mesh_part = nullptr;
  const KnobReading reading = reader.read(oven.take());
  EXPECT_EQ(reading.status, KnobStatus::kNotFound);
  EXPECT_FALSE(reading.state.has_value());
}

TEST(KnobReader, SaysWhyAKnobIsNotInView) {
  OvenPicture oven;
  KnobReader reader(oven.knob, {});
  KnobPicture behind = oven.take();
  behind.T_camera_part = Eigen::Translation3d(0.0, 0.0, -2.0) * behind.T_camera_part;
  EXPECT_EQ(reader.read(behind).reason, "behind the camera");
  KnobPicture beside = oven.take();
  beside.T_camera_part = Eigen::Translation3d(0.6, 0.0, 0.0) * beside.T_camera_part;
  EXPECT_EQ(reader.read(beside).status, KnobStatus::kNotInView);
  EXPECT_EQ(reader.read(beside).reason, "out of the picture");
  oven.tilt_deg = 70.0;
  EXPECT_EQ(reader.read(oven.take()).reason, "seen from the side");
  oven.tilt_deg = 10.0;
  oven.distance_m = 2.0;
  EXPECT_EQ(reader.read(oven.take()).reason, "too small in the picture");
}

TEST(KnobReader, GivesTheSameTwice) {
  OvenPicture oven;
  oven.angle_rad = 1.0;
  const KnobPicture picture = oven.take();
  const KnobReading one = KnobReader(oven.knob, {}).read(picture);
  const KnobReading other = KnobReader(oven.knob, {}).read(picture);
  EXPECT_EQ(one.angle_rad, other.angle_rad);
  EXPECT_EQ(one.state_probabilities, other.state_probabilities);
  EXPECT_EQ(one.centre_px, other.centre_px);
}

TEST(KnobReader, NeedsAMesh) {
  EXPECT_THROW(KnobReader({}, {}), base::Error);
}

TEST(KnobReaderConfig, RefusesWhatMakesNoSense) {
  test::checkConfigRules<KnobReaderConfig>({{"max_tilt_deg", "80", "must be from 0 to 75"},
                                            {"min_diameter_px", "0", "must be > 0"},
                                            {"registration_sigma_m", "0", "must be > 0"},
                                            {"max_proposals", "0", "must be from 1 to 100"},
                                            {"min_score", "101", "must be from -100 to 100"},
                                            {"max_unexplained", "nan", "must be from 0 to 1"},
                                            {"evidence_share", "-1", "must be > 0"},
                                            {"max_evidence", "0", "must be > 0"},
                                            {"detent_sigma_deg", "0", "must be > 0"},
                                            {"between_share", "1", "must be from 0 to 0.9"},
                                            {"min_state_probability", "2", "must be from 0 to 1"}});
}

}  // namespace
}  // namespace oikos::recognition
