// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/knob_watch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/config.h"
#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tracking/state/frame_choice.h"

namespace oikos::tracking {

namespace {

using recognition::KnobDescription;

/// The joint that turns it; nothing: none, or there is nothing to see.
std::optional<std::size_t> turningJoint(const model::ArticulatedModel& model, const model::ModelKnob& knob) {
  const auto& mesh = model.parts[static_cast<std::size_t>(knob.part)].mesh_part;
  const auto joint =
      std::find_if(model.joints.begin(), model.joints.end(), [&](const model::ModelJoint& j) { return j.child == knob.part; });
  return joint == model.joints.end() || !mesh || mesh->empty() || knob.states.empty()
             ? std::nullopt
             : std::optional(static_cast<std::size_t>(joint - model.joints.begin()));
}

bool haveSameStates(const KnobDescription& a, const KnobDescription& b) {
  return std::equal(a.states.begin(), a.states.end(), b.states.begin(), b.states.end(),
                    [](const auto& one, const auto& other) { return std::abs(one.angle_rad - other.angle_rad) < 1e-9; });
}

bool lookTheSame(const KnobDescription& a, const KnobDescription& b) {
  constexpr float kSame_m = 1e-5F;  // the meshes come from different places of one part
  const model::TriangleMesh& mesh = *a.mesh_knob;
  const model::TriangleMesh& other = *b.mesh_knob;
  return (a.axis_knob - b.axis_knob).norm() < 1e-9 && haveSameStates(a, b) && mesh.triangles == other.triangles &&
         mesh.triangle_materials == other.triangle_materials && mesh.materials.size() == other.materials.size() &&
         std::equal(mesh.materials.begin(), mesh.materials.end(), other.materials.begin(),
                    [](const auto& one, const auto& two) { return one.color_rgb == two.color_rgb; }) &&
         std::equal(mesh.vertices.begin(), mesh.vertices.end(), other.vertices.begin(), other.vertices.end(),
                    [](const Eigen::Vector3f& one, const Eigen::Vector3f& two) { return (one - two).norm() < kSame_m; });
}

}  // namespace

/// What knobs look like, and what reads them.
struct KnobWatch::Look {
  recognition::KnobReader reader;
};

struct KnobWatch::Watched {
  int piece = 0;
  int carrier = 0;  ///< part of the model
  KnobDescription knob;
  recognition::KnobFace face;
  std::size_t look = 0;
  std::set<int> wanted;  ///< indices of the frames
  std::vector<KnobSighting> sightings;
  std::vector<int> indices;  ///< theirs

  /// Of a frame that was read.
  [[nodiscard]] int indexOf(int frame) const {
    const auto found = std::find_if(sightings.begin(), sightings.end(), [&](const KnobSighting& one) { return one.frame == frame; });
    return indices[static_cast<std::size_t>(found - sightings.begin())];
  }
  /// Indices of the pictures in a stay that have read another state.
  [[nodiscard]] std::vector<int> dissenters(const KnobStay& stay) const {
    std::vector<int> found;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const KnobSighting& one = sightings[i];
      const bool is_within = one.frame >= stay.first_frame && one.frame <= stay.last_frame;
      if (is_within && one.reading.status == recognition::KnobStatus::kRead && one.reading.state != stay.state) {
        found.push_back(indices[i]);
      }
    }
    return found;
  }
  void insert(int index, KnobSighting sighting) {
    const auto place = std::lower_bound(indices.begin(), indices.end(), index) - indices.begin();
    indices.insert(indices.begin() + place, index);
    sightings.insert(sightings.begin() + place, std::move(sighting));
  }
};

KnobWatch::KnobWatch(const std::vector<ArticulatedPiece>& pieces, const camera::PinholeCamera& camera, const KnobTrackConfig& config,
                     const FrameChoiceConfig& frames, int threads)
    : pieces_(pieces), camera_(camera), config_(config), frame_choice_(frames), threads_(threads) {
  OIKOS_CHECK(base::validateConfig(config).empty());
  frame_choice_.most_frames = config.most_frames;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    addKnobs(static_cast<int>(piece));
  }
}

KnobWatch::~KnobWatch() = default;

void KnobWatch::addKnobs(int piece) {
  const model::ArticulatedModel& model = pieces_[static_cast<std::size_t>(piece)].model;
  for (std::size_t i = 0; i < model.knobs.size(); ++i) {
    const auto joint = turningJoint(model, model.knobs[i]);
    if (!joint) {
      continue;
    }
    Watched watched;
    watched.piece = piece;
    watched.carrier = model.joints[*joint].parent;
    watched.knob = recognition::describeKnob(model, i);
    watched.face = recognition::findFace(watched.knob);
    const auto same =
        std::find_if(looks_.begin(), looks_.end(), [&](const auto& look) { return lookTheSame(look->reader.knob(), watched.knob); });
    watched.look = static_cast<std::size_t>(same - looks_.begin());
    if (same == looks_.end()) {
      looks_.push_back(std::make_unique<Look>(Look{recognition::KnobReader(watched.knob, config_.reader)}));
    }
    knobs_.push_back(std::move(watched));
  }
}

/// How well the frame shows the knob: its pixels across and along the tilt, as far as they help. Nothing: it cannot be read.
std::optional<double> KnobWatch::worthOf(const Watched& knob, const camera::RgbdFrame& frame, const Eigen::Isometry3d& T_map_camera) const {
  const ArticulatedPiece& piece = pieces_[static_cast<std::size_t>(knob.piece)];
  const auto T_model_part = model::Kinematics(piece.model).solve(piece.believed.joint_values);
  const Eigen::Isometry3d T_camera_face = T_map_camera.inverse() * piece.believed.T_map_model *
                                          T_model_part[static_cast<std::size_t>(knob.carrier)] * knob.knob.T_part_knob *
                                          knob.face.T_knob_face;
  const Eigen::Vector3d middle_camera = T_camera_face.translation();
  if (middle_camera.z() < 0.1) {
    return std::nullopt;
  }
  const recognition::FaceView view = recognition::viewFace(T_camera_face, camera_);
  const double diameter_px = 2.0 * knob.face.radius_m * view.px_per_m;
  const Eigen::Vector2d pixel = camera_.project(middle_camera);
  const bool is_inside = pixel.x() > diameter_px && pixel.y() > diameter_px && pixel.x() < camera_.width - diameter_px &&
                         pixel.y() < camera_.height - diameter_px;
  if (!is_inside || diameter_px < config_.reader.min_diameter_px || view.tilt_rad > config_.reader.max_tilt_deg * base::kRadPerDeg) {
    return std::nullopt;
  }
  const float depth_m = frame.depth_m.at<float>(static_cast<int>(pixel.y()), static_cast<int>(pixel.x()));
  if (depth_m > 0.0F && depth_m < middle_camera.z() - config_.hidden_m) {
    return std::nullopt;
  }
  return std::min(diameter_px, config_.enough_px) * std::cos(view.tilt_rad);
}

void KnobWatch::look(const camera::RgbdFrame& frame, const LocatedPose& pose) {
  OIKOS_CHECK(rounds_ == 0 && (frames_.empty() || frames_.back().frame < frame.index));
  if (pose.source == PoseSource::kNone) {
    return;
  }
  SeenFrame seen{frame.index, frame.stamp_ns, pose.source, pose.T_map_camera, pose.covariance, {}};
  for (std::size_t k = 0; k < knobs_.size(); ++k) {
    if (const auto worth = worthOf(knobs_[k], frame, pose.T_map_camera)) {
      seen.sights.push_back({static_cast<int>(k), *worth});
    }
  }
  if (!seen.sights.empty()) {
    frames_.push_back(std::move(seen));
  }
}

std::set<int> KnobWatch::firstOf(int knob) const {
  const std::vector<int> chosen = chooseFrames(frames_, knob, frame_choice_);
  return {chosen.begin(), chosen.end()};
}

/// Between pictures that disagree, nearer to the moment; and beside those that are too few to tell what they show, or alone with another
/// state than their stay's: misread, or the first of a stay that one picture is not enough for.
std::set<int> KnobWatch::furtherOf(int number) const {
  const Watched& knob = knobs_[static_cast<std::size_t>(number)];
  const std::vector<KnobStay> stays = fuseSightings(knob.sightings, knob.knob.states.size(), config_.test);
  std::set<int> further;
  const auto want = [&](std::optional<int> index) {
    if (index && !std::binary_search(knob.indices.begin(), knob.indices.end(), *index)) {
      further.insert(*index);
    }
  };
  for (std::size_t i = 0; i < stays.size(); ++i) {
    if (i + 1 < stays.size()) {
      want(frameBetween(frames_, number, knob.indexOf(stays[i].last_frame), knob.indexOf(stays[i + 1].first_frame)));
    }
    if (stays[i].found > 0 && !stays[i].isTold(config_.test)) {
      want(frameBeside(frames_, number, knob.indices, knob.indexOf(stays[i].best_frame)));
    }
    for (const int index : knob.dissenters(stays[i])) {
      want(frameBeside(frames_, number, knob.indices, index));
    }
  }
  return further;
}

std::vector<WantedKnobs> KnobWatch::wanted() {
  std::map<int, std::set<int>> pieces_by_index;
  for (std::size_t k = 0; k < knobs_.size() && rounds_ <= frame_choice_.most_halvings; ++k) {
    Watched& knob = knobs_[k];
    knob.wanted = rounds_ == 0 ? firstOf(static_cast<int>(k)) : furtherOf(static_cast<int>(k));
    for (const int index : knob.wanted) {
      pieces_by_index[index].insert(knob.piece);
    }
  }
  ++rounds_;
  std::vector<WantedKnobs> wanted;
  for (const auto& [index, pieces] : pieces_by_index) {
    wanted.push_back({frames_[static_cast<std::size_t>(index)].frame, {pieces.begin(), pieces.end()}});
  }
  return wanted;
}

void KnobWatch::read(const camera::RgbdFrame& frame, const Eigen::Isometry3d& T_map_camera, int piece,
                     const registration::Standing& standing) {
  const auto seen =
      std::lower_bound(frames_.begin(), frames_.end(), frame.index, [](const SeenFrame& one, int f) { return one.frame < f; });
  OIKOS_CHECK(seen != frames_.end() && seen->frame == frame.index);
  const auto index = static_cast<int>(seen - frames_.begin());
  const auto T_model_part = model::Kinematics(pieces_[static_cast<std::size_t>(piece)].model).solve(standing.joint_values);
  // Knobs of one look share a reader, which is not thread-safe.
  base::parallelFor(static_cast<int>(looks_.size()), threads_, [&](int look) {
    recognition::KnobReader& reader = looks_[static_cast<std::size_t>(look)]->reader;
    for (Watched& knob : knobs_) {
      if (knob.piece != piece || knob.look != static_cast<std::size_t>(look) || knob.wanted.erase(index) == 0) {
        continue;
      }
      const Eigen::Isometry3d T_map_part = standing.T_map_model * T_model_part[static_cast<std::size_t>(knob.carrier)];
      // The reader's knob sits elsewhere on its part.
      const Eigen::Isometry3d T_part_part = knob.knob.T_part_knob * reader.knob().T_part_knob.inverse();
      knob.insert(index,
                  {frame.index, frame.stamp_ns, reader.read({frame.color, camera_, T_map_camera.inverse() * T_map_part * T_part_part})});
    }
  });
}

std::vector<TrackedKnob> KnobWatch::conclude() const {
  std::vector<TrackedKnob> tracked;
  for (const Watched& knob : knobs_) {
    if (knob.sightings.empty()) {
      continue;
    }
    TrackedKnob one;
    one.piece = pieces_[static_cast<std::size_t>(knob.piece)].id;
    one.id = {knob.knob.name};
    for (const model::ModelKnobState& state : knob.knob.states) {
      one.states.push_back(state.name);
    }
    one.stays = fuseSightings(knob.sightings, one.states.size(), config_.test);
    one.images = static_cast<int>(knob.sightings.size());
    one.reason = knob.sightings.back().reading.reason;
    tracked.push_back(std::move(one));
  }
  return tracked;
}

}  // namespace oikos::tracking
