// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "bench/knobs/belief.h"
#include "bench/knobs/trials.h"
#include "core/base/degrees.h"
#include "core/base/parallel.h"

namespace oikos::bench {

namespace {

using namespace recognition;
constexpr double kTurn = 2.0 * std::numbers::pi;

double errorOf(double angle_rad, double true_rad) {
  return std::abs(std::remainder(angle_rad - true_rad, kTurn)) / base::kRadPerDeg;
}

std::size_t nearestState(double angle_rad, const std::vector<model::ModelKnobState>& states) {
  const auto nearest = std::min_element(states.begin(), states.end(), [&](const auto& a, const auto& b) {
    return errorOf(angle_rad, a.angle_rad) < errorOf(angle_rad, b.angle_rad);
  });
  return static_cast<std::size_t>(nearest - states.begin());
}

/// The true setting: a knob rests a little beside the angle of its state.
struct Setting {
  std::size_t state = 0;
  double angle_rad = 0.0;
};

Setting drawSetting(const KnobDescription& knob, Random& random) {
  const auto state = static_cast<std::size_t>(random.below(kStates));
  return {state, knob.states[state].angle_rad + std::clamp(2.0 * random.normal(), -5.0, 5.0) * base::kRadPerDeg};
}

ShotOrder drawShot(const DrawnKnob& knob, Random& random) {
  ShotOrder order;
  order.target_panel = knob.position_panel;
  order.radius_m = knob.size.radius_m;
  order.diameter_px = 24.0 * std::pow(5.0, random.between(0.0, 1.0));
  order.tilt_rad = random.between(0.0, 50.0) * base::kRadPerDeg;
  order.azimuth_rad = random.between(0.0, kTurn);
  order.roll_rad = 0.1 * random.normal();
  order.width_px = order.height_px = std::max(96, static_cast<int>(3.2 * order.diameter_px));
  order.offset_px = 0.2 * order.diameter_px;
  return order;
}

void readLearnt(const KnobReader& reader, const KnobPicture& picture, const Setting& setting, const TrialSetup& setup,
                ReadingTrial& trial) {
  const FaceView view = viewFace(picture.T_camera_part * reader.face().T_knob_face, picture.camera);
  const FaceImage image{picture.color, picture.camera, view, reader.face().radius_m};
  const std::vector<KnobDetection> found = detectKnobs(image, setup.detector, {});
  const Eigen::Vector2d centre_patch = found.empty() ? Eigen::Vector2d::Zero().eval() : found.front().centre_patch;
  // The models know the mark's angle about the face's z, from its x; the knob's own angle may run the other way from elsewhere.
  const Eigen::Vector3d mark_face = reader.face().T_knob_face.linear().transpose() * Eigen::Vector3d::UnitX();
  const double mark_rad = std::atan2(mark_face.y(), mark_face.x());
  for (const auto& [method, name] : enumTable(AngleMethod{})) {
    const double angle_rad = reader.face().turn_sign * (setup.angle_models->predict(method, image, centre_patch) - mark_rad);
    trial.learnt_error_deg[method] = errorOf(angle_rad, setting.angle_rad);
    trial.learnt_is_right[method] = nearestState(angle_rad, reader.knob().states) == setting.state;
  }
}

/// Where the frame of the knob's part is on the panel.
Eigen::Isometry3d T_panel_part(const DrawnKnob& knob) {
  return Eigen::Isometry3d(Eigen::Translation3d(knob.position_panel.x(), knob.position_panel.y(), 0.0));
}

DrawnKnob placeKnob(DrawnKnob knob, double angle_rad, Random& random) {
  knob.position_panel = {random.between(-0.18, 0.18), random.between(-0.07, 0.07)};
  knob.angle_rad = -angle_rad;  // clockwise
  return knob;
}

/// A photograph as an installer takes it: from the front and near, the knob set to its first state, in the light of that day.
KnobPhoto takePhoto(const PanelLook& look, const DrawnKnob& drawn, const KnobDescription& believed, const TrialSetup& setup,
                    Random& random) {
  const double angle_rad = believed.states.front().angle_rad;
  const DrawnKnob knob = placeKnob(drawn, angle_rad + std::clamp(2.0 * random.normal(), -5.0, 5.0) * base::kRadPerDeg, random);
  const Panel panel = drawPanel(look, {.knob_count = 1, .knob = knob}, random);
  ShotOrder order = drawShot(knob, random);
  order.diameter_px = random.between(80.0, 120.0);
  order.tilt_rad = random.between(0.0, 15.0) * base::kRadPerDeg;
  order.width_px = order.height_px = static_cast<int>(3.2 * order.diameter_px);
  order.offset_px = 0.2 * order.diameter_px;
  const PanelShot shot = shootPanel(panel, order, random);
  Eigen::Isometry3d T_true_believed = drawMisplacement(random);
  if (setup.templates == TemplateSource::kPhoto) {
    constexpr double kMarked_px = 1.0;  // deviation
    const double px_m = 2.0 * knob.size.radius_m / order.diameter_px;
    T_true_believed.translation() = kMarked_px * px_m * Eigen::Vector3d(random.normal(), random.normal(), 0.0);
  }
  return {{shot.color, shot.camera, shot.T_camera_panel * T_panel_part(knob) * T_true_believed}, angle_rad};
}

std::vector<ReadingTrial> runKnob(int number, int count, const TrialSetup& setup) {
  Random knob_random(setup.seed + 1000, static_cast<std::uint64_t>(number));
  PanelLook look = setup.look;
  const std::size_t family = static_cast<std::size_t>(number) % setup.knobs.size();
  look.knobs = {setup.knobs[family].maker};
  const DrawnKnob drawn = drawKnobs(look, 1, knob_random).front();
  const KnobDescription believed = believe(drawn, knob_random.between(0.0, kTurn), knob_random);
  std::optional<KnobPhoto> photo;
  if (setup.templates != TemplateSource::kRender) {
    Random photo_random(setup.seed + 3000, static_cast<std::uint64_t>(number));
    photo = takePhoto(look, drawn, believed, setup, photo_random);
  }
  KnobReader reader(believed, {}, setup.detector, photo);
  std::vector<ReadingTrial> trials;
  for (int i = 0; i < count; ++i) {
    Random random(setup.seed + 2000, static_cast<std::uint64_t>(number * 100'000 + i));
    const Setting setting = drawSetting(reader.knob(), random);
    const DrawnKnob knob = placeKnob(drawn, setting.angle_rad, random);
    const Panel panel = drawPanel(look, {.knob_count = 1, .knob = knob}, random);
    const ShotOrder order = drawShot(knob, random);
    const PanelShot shot = shootPanel(panel, order, random);
    const KnobPicture picture{shot.color, shot.camera, shot.T_camera_panel * T_panel_part(knob) * drawMisplacement(random)};
    ReadingTrial trial;
    (void)reader.read(picture);  // renders the templates
    const double begin_ms = processorTime_ms();
    trial.reading = reader.read(picture);
    trial.ms = processorTime_ms() - begin_ms;
    trial.family = family;
    trial.tilt_deg = order.tilt_rad / base::kRadPerDeg;
    trial.diameter_px = order.diameter_px;
    trial.error_deg = errorOf(trial.reading.angle_rad, setting.angle_rad);
    trial.is_right = trial.reading.state == setting.state;
    if (setup.angle_models != nullptr) {
      readLearnt(reader, picture, setting, setup, trial);
    }
    trials.push_back(trial);
  }
  return trials;
}

}  // namespace

std::vector<ReadingTrial> runReading(int count, const TrialSetup& setup) {
  const int knobs = static_cast<int>(setup.knobs.size()) * setup.variants;
  std::vector<std::vector<ReadingTrial>> slots(static_cast<std::size_t>(knobs));
  base::parallelFor(knobs, setup.threads, [&](int i) {
    const int extra = i < count % knobs ? 1 : 0;
    slots[static_cast<std::size_t>(i)] = runKnob(i, count / knobs + extra, setup);
  });
  std::vector<ReadingTrial> trials;
  for (std::vector<ReadingTrial>& slot : slots) {
    std::move(slot.begin(), slot.end(), std::back_inserter(trials));
  }
  return trials;
}

}  // namespace oikos::bench
