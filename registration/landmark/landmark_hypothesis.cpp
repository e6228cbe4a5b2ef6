// SPDX-License-Identifier: Apache-2.0
#include "registration/landmark/landmark_hypothesis.h"

#include <algorithm>
#include <optional>

#include "registration/landmark/start_search.h"
#include "registration/motion.h"

namespace oikos::registration {

bool LandmarkHypothesis::contradictsAnywhere() const {
  for (std::size_t s = 0; s < used.size(); ++s) {
    if (contradicts(s)) {
      return true;
    }
  }
  return false;
}

HypothesisTester::HypothesisTester(LandmarkScene& scene, const Scan& scan, const CameraPrior& prior, const LandmarkConfig& config)
    : scene_(scene), scan_(scan), edges_(scan), prior_(prior), config_(config) {}

void HypothesisTester::evaluate(LandmarkHypothesis& h, const Eigen::Isometry3d& T_map_camera_start) {
  scene_.show(h.used);
  CameraMotion motion(scene_.scene(), T_map_camera_start, PoseFreedom::kPlanar, prior_.robot_camera);
  h.fit.align = align(motion, scan_, config_.align);
  h.fit.T_map_camera = motion.T_map_camera();
  examine(h);
}

void HypothesisTester::examine(LandmarkHypothesis& h) const {
  const CameraMotion motion(scene_.scene(), h.fit.T_map_camera, PoseFreedom::kPlanar, prior_.robot_camera);
  h.checks = checkSurfaces(scene_, motion, scan_, edges_, h.fit.align.covariance, config_.check, config_.align.threads);
  h.score = 0.0;
  Readings readings{static_cast<int>(scan_.points.size())};
  for (std::size_t s = 0; s < h.used.size(); ++s) {
    readings.on += h.checks[s].agreeing;
    readings.through += h.checks[s].through;
    readings.before += h.checks[s].before + h.checks[s].just_before;
    h.score += h.contradicts(s) ? -h.checks[s].visible() : h.used[s] * h.checks[s].agreeing;
  }
  h.explained = explains(readings, h.fit.T_map_camera, prior_, config_.search);
}

std::vector<std::size_t> suspectsOf(const LandmarkHypothesis& h, const LandmarkScene& scene) {
  constexpr std::size_t kMost = 3;
  std::vector<std::size_t> suspects;
  std::optional<std::size_t> heaviest;
  for (std::size_t s = 0; s < h.used.size(); ++s) {
    if (h.contradicts(s)) {
      suspects.push_back(s);
    } else if (h.used[s] != 0 && scene.surfaces()[s].is_base && h.checks[s].agreeing > (heaviest ? h.checks[*heaviest].agreeing : 0)) {
      heaviest = s;
    }
  }
  std::stable_sort(suspects.begin(), suspects.end(),
                   [&](std::size_t a, std::size_t b) { return h.checks[a].contradiction > h.checks[b].contradiction; });
  suspects.resize(std::min(suspects.size(), kMost));
  if (heaviest) {
    suspects.push_back(*heaviest);
  }
  return suspects;
}

void leaveOut(std::size_t surface, const LandmarkScene& scene, LandmarkHypothesis& h) {
  const LandmarkSurface& out = scene.surfaces()[surface];
  h.used[surface] = 0;
  if (!out.is_base) {
    h.dropped.push_back(static_cast<int>(surface));
    return;
  }
  h.moved[static_cast<std::size_t>(out.landmark)] = std::max(1.0, h.checks[surface].contradiction);
  for (std::size_t s = 0; s < h.used.size(); ++s) {
    if (scene.surfaces()[s].landmark == out.landmark) {
      h.used[s] = 0;
    }
  }
}

}  // namespace oikos::registration
