// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/knob_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/config.h"
#include "core/base/config_rules.h"
#include "core/base/degrees.h"
#include "core/base/error.h"

namespace oikos::recognition {

namespace {

constexpr double kTiltStep_rad = 5.0 * base::kRadPerDeg;
constexpr RingShape kCoarse = {7, 36, 0.6F};  // its outline tells where a knob is
constexpr RingShape kFine = {14, 72, 0.1F};
constexpr double kLeastPitch = 1.5;  // in radii: between the axes of two knobs
constexpr double kFitReach = 0.6;    // in radii: how far a detection may be off

KnobDescription checked(KnobDescription knob) {
  if (!knob.mesh_knob || knob.mesh_knob->empty()) {
    throw base::Error(base::ErrorCode::kInput, "knob '" + knob.name + "' has no mesh: give it a model");
  }
  return knob;
}

/// Why a face cannot be read from here; empty if it can.
std::string obstacle(const FaceView& view, const KnobFace& face, const camera::PinholeCamera& camera, const KnobReaderConfig& config) {
  if (!(view.px_per_m > 0.0)) {
    return "behind the camera";
  }
  if (view.tilt_rad > config.max_tilt_deg * base::kRadPerDeg) {
    return "seen from the side";
  }
  if (2.0 * face.radius_m * view.px_per_m < config.min_diameter_px) {
    return "too small in the picture";
  }
  return camera.contains(projectPatch(view, camera, Eigen::Vector2d::Zero())) ? "" : "out of the picture";
}

}  // namespace

std::vector<std::string> KnobReaderConfig::validate() const {
  return base::ConfigRules()
      .between("max_tilt_deg", max_tilt_deg, 0.0, 75.0)
      .greater("min_diameter_px", min_diameter_px, 0.0)
      .greater("registration_sigma_m", registration_sigma_m, 0.0)
      .between("max_proposals", max_proposals, 1, 100)
      .between("min_score", min_score, -100.0, 100.0)
      .between("max_unexplained", max_unexplained, 0.0, 1.0)
      .greater("evidence_share", evidence_share, 0.0)
      .greater("max_evidence", max_evidence, 0.0)
      .greater("detent_sigma_deg", detent_sigma_deg, 0.0)
      .between("between_share", between_share, 0.0, 0.9)
      .between("min_state_probability", min_state_probability, 0.0, 1.0)
      .messages();
}

KnobReader::KnobReader(KnobDescription knob, const KnobReaderConfig& config, DetectorModel detector, std::optional<KnobPhoto> photo)
    : knob_(checked(std::move(knob))), face_(findFace(knob_)), config_(config), detector_(std::move(detector)), photo_(std::move(photo)) {
  OIKOS_CHECK(base::validateConfig(config).empty());
  if (!photo_) {
    return;
  }
  OIKOS_CHECK(photo_->picture.color.type() == CV_8UC3 && std::isfinite(photo_->angle_rad));
  const std::string reason = obstacle(viewOf(photo_->picture), face_, photo_->picture.camera, config_);
  if (!reason.empty()) {
    throw base::Error(base::ErrorCode::kInput, "the photograph of knob '" + knob_.name + "' cannot be read from: it is " + reason);
  }
}

FaceView KnobReader::viewOf(const KnobPicture& picture) const {
  return viewFace(picture.T_camera_part * knob_.T_part_knob * face_.T_knob_face, picture.camera);
}

AngleRing KnobReader::ringOf(double tilt_rad, const RingShape& shape) const {
  if (photo_) {
    const KnobPicture& picture = photo_->picture;
    return {FacePhoto{picture.color, picture.camera, viewOf(picture), photo_->angle_rad}, face_, tilt_rad, shape};
  }
  return {knob_, face_, tilt_rad, shape};
}

const RingPair& KnobReader::ringsOf(double tilt_rad) {
  const int step = static_cast<int>(std::lround(tilt_rad / kTiltStep_rad));
  const auto found = rings_.find(step);
  if (found != rings_.end()) {
    return found->second;
  }
  const double of_step_rad = step * kTiltStep_rad;
  return rings_.emplace(step, RingPair{ringOf(of_step_rad, kCoarse), ringOf(of_step_rad, kFine)}).first->second;
}

void KnobReader::readAngle(const AngleFit& fit, const FaceView& view, KnobReading& reading) const {
  const double pixels = std::numbers::pi / 4.0 * reading.diameter_px * reading.diameter_px * std::cos(view.tilt_rad);
  BeliefRule rule;
  // Turned by the angle, the knob looks from this azimuth as template (azimuth - sign * angle) shows it.
  rule.zero_rad = face_.turn_sign * view.azimuth_rad;
  rule.turn_sign = -face_.turn_sign;
  rule.evidence = std::min(config_.max_evidence, config_.evidence_share * pixels);
  const AngleBelief belief = believeAngle(fit.unexplained, rule);
  reading.angle_rad = belief.angle_rad;
  reading.sigma_rad = belief.sigma_rad;
  reading.unexplained = *std::min_element(fit.unexplained.begin(), fit.unexplained.end());
  reading.state_probabilities = believeStates(belief, knob_.states, {config_.detent_sigma_deg * base::kRadPerDeg, config_.between_share});
  if (!reading.state_probabilities.empty()) {
    const auto best = std::max_element(reading.state_probabilities.begin(), reading.state_probabilities.end());
    reading.state = static_cast<std::size_t>(best - reading.state_probabilities.begin());
    reading.probability = *best;
  }
}

/// What the detector sees, and the place where the knob is believed: of one that hardly stands out from its carrier it sees nothing, or
/// something else, while the mark can be read well.
std::vector<KnobDetection> KnobReader::propose(const FaceImage& image) const {
  std::vector<KnobDetection> proposals = detectKnobs(image, detector_, config_.detector);
  proposals.resize(std::min(proposals.size(), static_cast<std::size_t>(config_.max_proposals)));
  constexpr double kThere = 0.5;  // in radii: a proposal so near to the believed place stands for it
  const Eigen::Vector2d believed_patch = Eigen::Vector2d::Zero();
  if (std::none_of(proposals.begin(), proposals.end(),
                   [&](const KnobDetection& one) { return (one.centre_patch - believed_patch).norm() < kThere * image.radius_m; })) {
    const double score = std::max(config_.detector.min_score, scoreWindow(image, believed_patch, detector_));
    proposals.push_back({believed_patch, image.radius_m, score});
  }
  return proposals;
}

std::vector<KnobReader::Found> KnobReader::find(const KnobPicture& picture, const FaceView& view) {
  std::vector<Found> found;
  for (const KnobDetection& proposal : propose({picture.color, picture.camera, view, face_.radius_m})) {
    Found one;
    one.detection = proposal;
    one.fit = fitAngle({picture.color, picture.camera, view, face_.radius_m, proposal.centre_patch, kFitReach * face_.radius_m,
                        config_.registration_sigma_m},
                       ringsOf(view.tilt_rad));
    std::vector<double> ordered = one.fit.unexplained;
    std::sort(ordered.begin(), ordered.end());
    one.unexplained = ordered.front();
    one.distinctness = std::log(ordered[ordered.size() / 2] / ordered.front());
    // A logistic regression on simulated panels, rounded; the default threshold was then held against looks of the training.
    one.score = 2.0 * proposal.score - std::log(one.unexplained) + 2.0 * one.distinctness;
    if (one.score < config_.min_score) {
      continue;
    }
    found.push_back(std::move(one));
  }
  // Of several the one that is where it is believed to be.
  const auto distance = [&](const Found& one) {
    return 0.5 * one.fit.centre_patch.squaredNorm() / std::pow(config_.registration_sigma_m, 2);
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const Found& a, const Found& b) { return a.score - distance(a) > b.score - distance(b); });
  std::vector<Found> apart;
  for (Found& one : found) {
    if (std::all_of(apart.begin(), apart.end(), [&](const Found& other) {
          return (other.fit.centre_patch - one.fit.centre_patch).norm() > kLeastPitch * face_.radius_m;
        })) {
      apart.push_back(std::move(one));
    }
  }
  return apart;
}

KnobReading KnobReader::read(const KnobPicture& picture) {
  OIKOS_CHECK(picture.color.type() == CV_8UC3);
  KnobReading reading;
  const FaceView view = viewOf(picture);
  reading.reason = obstacle(view, face_, picture.camera, config_);
  if (!reading.reason.empty()) {
    return reading;
  }
  reading.diameter_px = 2.0 * face_.radius_m * view.px_per_m;
  const std::vector<Found> found = find(picture, view);
  if (found.empty()) {
    reading.status = KnobStatus::kNotFound;
    reading.reason = "no knob where it should be";
    return reading;
  }
  const AngleFit& fit = found.front().fit;
  reading.detector_score = found.front().detection.score;
  reading.centre_px = projectPatch(view, picture.camera, fit.centre_patch);
  readAngle(fit, view, reading);
  reading.status = KnobStatus::kCannotTell;
  if (reading.unexplained > config_.max_unexplained) {
    reading.reason = "it does not look like its model";
  } else if (reading.probability < config_.min_state_probability) {
    reading.reason = "it fits none of its states, or several";
  } else {
    reading.status = KnobStatus::kRead;
  }
  return reading;
}

}  // namespace oikos::recognition
