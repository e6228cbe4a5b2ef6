// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <ctime>

#include "bench/knobs/belief.h"
#include "bench/knobs/trials.h"
#include "core/base/parallel.h"

namespace oikos::bench {

namespace {

using namespace recognition;

/// A picture and its true knobs.
struct Picture {
  DetectionScene scene;
  std::vector<Eigen::Vector2d> whole_px;  ///< middles of the faces of knobs that are wholly in it
  std::vector<Eigen::Vector2d> cut_px;    ///< of the others: neither asked for nor wrong
  std::vector<FaceView> regions;          ///< where knobs are believed
  double radius_px = 0.0;
};

Picture takePicture(const KnobFace& face, DetectionScene scene, Random& random) {
  Picture picture;
  picture.scene = std::move(scene);
  const camera::PinholeCamera& camera = picture.scene.camera;
  const Eigen::Vector2d off = 0.003 * Eigen::Vector2d(random.normal(), random.normal());
  for (const DrawnKnob& knob : picture.scene.panel.knobs) {
    const Eigen::Vector2d& at = knob.position_panel;
    const Eigen::Isometry3d T_panel_face(Eigen::Translation3d(at.x() + off.x(), at.y() + off.y(), face.height_m));
    const FaceView view = viewFace(picture.scene.T_camera_panel * T_panel_face, camera);
    const Eigen::Vector2d middle_px = camera.project(picture.scene.T_camera_panel * Eigen::Vector3d(at.x(), at.y(), knob.size.height_m));
    picture.radius_px = knob.size.radius_m * view.px_per_m;
    if (camera.contains(middle_px, 1.2 * picture.radius_px + 1.0)) {
      picture.whole_px.push_back(middle_px);
      picture.regions.push_back(view);
    } else {
      picture.cut_px.push_back(middle_px);
    }
  }
  if (picture.scene.panel.knobs.empty()) {  // one is believed where there is none
    picture.regions.push_back(picture.scene.view);
    picture.radius_px = picture.scene.radius_m * picture.scene.view.px_per_m;
  }
  return picture;
}

struct Candidate {
  Eigen::Vector2d middle_px;
  double detector_score;
  double score;
};

/// The best of those that are nearer to each other than two knobs can be, each held against the truth; a knob counts once.
std::vector<Alarm> judge(std::vector<Candidate> candidates, const Picture& picture) {
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<Candidate> kept;
  std::vector<Alarm> alarms;
  for (const Candidate& one : candidates) {
    const auto isNear = [&](const Eigen::Vector2d& other_px, double radii) {
      return (other_px - one.middle_px).norm() < radii * picture.radius_px;
    };
    if (std::any_of(kept.begin(), kept.end(), [&](const Candidate& k) { return isNear(k.middle_px, 1.0); })) {
      continue;
    }
    kept.push_back(one);
    if (std::none_of(picture.cut_px.begin(), picture.cut_px.end(), [&](const auto& cut) { return isNear(cut, 1.0); })) {
      const bool is_knob = std::any_of(picture.whole_px.begin(), picture.whole_px.end(), [&](const auto& p) { return isNear(p, 0.5); });
      alarms.push_back({is_knob, one.detector_score, one.score});
    }
  }
  return alarms;
}

DetectionTrial runTrial(int number, const TrialSetup& setup) {
  Random random(setup.seed, static_cast<std::uint64_t>(number));
  const int count = number % 3 == 0 ? 0 : number % 3 == 1 ? 1 : 2 + random.below(4);
  DetectionScene scene = drawDetectionScene(setup.look, count, random);
  DrawnKnob drawn = drawKnobs(setup.look, 1, random).front();
  drawn.size.radius_m = static_cast<float>(scene.radius_m);
  drawn.size.height_m = static_cast<float>(scene.height_m);
  if (!scene.panel.knobs.empty()) {
    drawn = scene.panel.knobs.front();
  }
  KnobReader reader(believe(drawn, 0.0, random), {}, setup.detector);
  const Picture picture = takePicture(reader.face(), std::move(scene), random);
  const KnobPicture taken{picture.scene.color, picture.scene.camera, {}};
  DetectionTrial trial;
  trial.knobs = static_cast<int>(picture.whole_px.size());
  trial.regions = static_cast<int>(picture.regions.size());
  std::vector<Candidate> alone;
  std::vector<Candidate> confirmed;
  for (const FaceView& view : picture.regions) {
    if (setup.has_confirmation) {
      (void)reader.find(taken, view);  // renders the templates
      const double begin_ms = processorTime_ms();
      const std::vector<KnobReader::Found> found = reader.find(taken, view);
      trial.ms += processorTime_ms() - begin_ms;
      for (const KnobReader::Found& one : found) {
        confirmed.push_back({projectPatch(view, taken.camera, one.fit.centre_patch), one.detection.score, one.score});
      }
    }
    const double begin_ms = processorTime_ms();
    const std::vector<KnobDetection> found = detectKnobs({taken.color, taken.camera, view, reader.face().radius_m}, setup.detector, {});
    trial.alone_ms += processorTime_ms() - begin_ms;
    for (const KnobDetection& one : found) {
      alone.push_back({projectPatch(view, taken.camera, one.centre_patch), one.score, one.score});
    }
  }
  trial.alone = judge(std::move(alone), picture);
  trial.confirmed = judge(std::move(confirmed), picture);
  return trial;
}

}  // namespace

double processorTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

std::vector<DetectionTrial> runDetection(int images, const TrialSetup& setup) {
  std::vector<DetectionTrial> trials(static_cast<std::size_t>(images));
  base::parallelFor(images, setup.threads, [&](int i) { trials[static_cast<std::size_t>(i)] = runTrial(i, setup); });
  return trials;
}

}  // namespace oikos::bench
