// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/state_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/base/config.h"
#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "registration/articulated/articulated_registration.h"
#include "tracking/furniture/changed_pieces.h"
#include "tracking/state/frame_choice.h"

namespace oikos::tracking {

namespace {

using registration::JointSpan;

/// The pixels of the piece with that joint where it was found, and some beside them.
registration::PixelBox cropOf(const ArticulatedPiece& piece, int joint, double value, const Eigen::Isometry3d& T_map_camera,
                              const camera::PinholeCamera& camera) {
  constexpr double kMargin = 0.08;  // of the box's sides
  std::vector<double> values = piece.believed.joint_values;
  values[static_cast<std::size_t>(joint)] = value;
  const Eigen::AlignedBox3d box_model = boxOf(piece.model, {piece.believed.joint_values, values});
  Eigen::AlignedBox2d box;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
    const Eigen::Vector3d corner_camera = T_map_camera.inverse() * piece.believed.T_map_model * box_model.corner(corner);
    if (corner_camera.z() < 0.1) {
      return {0, 0, camera.width, camera.height};
    }
    box.extend(camera.project(corner_camera));
  }
  const Eigen::Vector2d margin = kMargin * box.sizes();
  const Eigen::Array2d low = (box.min() - margin).array().max(0.0);
  const Eigen::Array2d high = (box.max() + margin).array().min(Eigen::Array2d(camera.width, camera.height));
  return {static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(high.x()), static_cast<int>(high.y())};
}

/// What a frame's pose may be off at a piece: in x and in y, and in yaw.
struct PoseSigma {
  double m = 0.0;
  double deg = 0.0;
};
PoseSigma poseSigmaAt(const ArticulatedPiece& piece, const SeenFrame& frame) {
  const Eigen::Vector3d middle_camera = frame.T_map_camera.inverse() * piece.believed.T_map_model * piece.box_model.center();
  Eigen::Matrix<double, 3, 6> J;  // of T exp(xi) p: R (v + w x p)
  J << Eigen::Matrix3d::Identity(), -geometry::skew(middle_camera);
  const Eigen::Matrix3d R = frame.T_map_camera.linear();
  const Eigen::Matrix3d at_piece = R * J * frame.covariance * J.transpose() * R.transpose();
  const Eigen::Matrix3d turn = R * frame.covariance.bottomRightCorner<3, 3>() * R.transpose();
  return {std::sqrt(0.5 * (at_piece(0, 0) + at_piece(1, 1))), std::sqrt(turn(2, 2)) / base::kRadPerDeg};
}

}  // namespace

StateReader::StateReader(const semantic::Home& home, const std::filesystem::path& home_folder, const camera::PinholeCamera& camera,
                         const StateConfig& config, int threads, const std::string& only)
    : camera_(camera),
      config_(config),
      threads_(threads),
      pieces_(articulatedPieces(home, home_folder, only)),
      surroundings_(home, home_folder) {
  OIKOS_CHECK(base::validateConfig(config).empty());
  config_.registration.threads = 1;  // the pieces of a frame share the threads
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    tracks_.push_back(std::make_unique<PieceTrack>());
  }
}

StateReader::~StateReader() = default;

void StateReader::look(const camera::RgbdFrame& frame, const LocatedPose& pose) {
  OIKOS_CHECK(!has_chosen_ && (frames_.empty() || frames_.back().frame < frame.index));
  if (pose.source == PoseSource::kNone) {
    return;
  }
  frames_.push_back(lookFor(pieces_, frame, camera_, pose, config_.frames));
  std::erase_if(frames_.back().sights, [&](const PieceSight& sight) {
    const PoseSigma off = poseSigmaAt(pieces_[static_cast<std::size_t>(sight.piece)], frames_.back());
    return off.m > config_.frames.max_pose_sigma_m || off.deg > config_.frames.max_pose_sigma_deg;
  });
  for (const PieceSight& sight : frames_.back().sights) {
    ++tracks_[static_cast<std::size_t>(sight.piece)]->frames_in_view;
  }
}

const SeenFrame& StateReader::seen(int frame) const {
  const auto found = std::lower_bound(frames_.begin(), frames_.end(), frame, [](const SeenFrame& one, int f) { return one.frame < f; });
  OIKOS_CHECK(found != frames_.end() && found->frame == frame);
  return *found;
}

void StateReader::place(int frame, const LocatedPose& pose) {
  SeenFrame& placed = frames_[static_cast<std::size_t>(&seen(frame) - frames_.data())];
  placed.source = pose.source;
  placed.T_map_camera = pose.T_map_camera;
  placed.covariance = pose.covariance;
}

std::vector<int> StateReader::wanted() {
  if (!has_chosen_) {
    has_chosen_ = true;
    chooseFirst();
  } else if (halvings_ < config_.frames.most_halvings) {
    ++halvings_;
    halve();
  }
  std::set<int> numbers;
  for (const auto& track : tracks_) {
    for (const int index : track->wanted) {
      numbers.insert(frames_[static_cast<std::size_t>(index)].frame);
    }
  }
  return {numbers.begin(), numbers.end()};
}

void StateReader::chooseFirst() {
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const std::vector<int> chosen = chooseFrames(frames_, static_cast<int>(p), config_.frames);
    tracks_[p]->wanted = {chosen.begin(), chosen.end()};
  }
}

/// Between images that disagree about a joint, nearer to the moment; and beside those that are alone with what they say, whether it was
/// believed or put down to a misreading.
void StateReader::halve() {
  constexpr int kEnough = 5;  // images about a moment, to tell a misreading from a short stay
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    PieceTrack& track = *tracks_[p];
    const std::vector<std::vector<JointSpan>> spans = track.spans(frames_, config_.fusion);
    for (std::size_t j = 0; j < spans.size(); ++j) {
      for (std::size_t k = 0; k + 1 < spans[j].size(); ++k) {
        track.wantMoment(spans[j][k], spans[j][k + 1], j, static_cast<int>(p), frames_, config_.fusion);
      }
      for (const JointSpan& span : spans[j]) {
        if (track.foundIn(span, j) == 1 && config_.change.min_images > 1) {
          const std::size_t witness = track.witnessOf(span, j);
          track.want(frameBeside(frames_, static_cast<int>(p), track.indices(), track.shots[witness].index));
        }
        for (const std::size_t dissenter : track.dissenters(span, j, config_.fusion.decision)) {
          if (track.readAbout(dissenter, frames_) < kEnough) {
            track.want(frameBeside(frames_, static_cast<int>(p), track.indices(), track.shots[dissenter].index));
          }
        }
      }
    }
  }
}

/// What the frame's pose and the piece's place may be off, at the piece.
registration::ImageContext StateReader::contextOf(const SeenFrame& frame, const ArticulatedPiece& piece) const {
  const bool is_fixed = piece.movability == semantic::Movability::kFixed;
  const double placed_m = is_fixed ? config_.placement.fixed_sigma_m : config_.placement.shiftable_sigma_m;
  const double placed_deg = is_fixed ? config_.placement.fixed_sigma_deg : config_.placement.shiftable_sigma_deg;
  const PoseSigma located = poseSigmaAt(piece, frame);
  return {std::hypot(placed_m, located.m), std::hypot(placed_deg, located.deg), {}};
}

void StateReader::read(const std::vector<camera::RgbdFrame>& frames) {
  std::vector<registration::Scan> scans(frames.size());
  base::parallelFor(static_cast<int>(frames.size()), threads_, [&](int i) {
    const auto f = static_cast<std::size_t>(i);
    scans[f] = registration::makeScan(frames[f].depth_m, camera_, config_.scan);
  });
  base::parallelFor(static_cast<int>(tracks_.size()), threads_, [&](int p) {
    const auto piece = static_cast<std::size_t>(p);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const SeenFrame& frame = seen(frames[f].index);
      if (tracks_[piece]->wanted.erase(static_cast<int>(&frame - frames_.data())) > 0) {
        registerIn(piece, frame, scans[f], frames[f].depth_m);
      }
    }
  });
}

void StateReader::registerIn(std::size_t piece, const SeenFrame& frame, const registration::Scan& scan, const cv::Mat& depth_m) {
  PieceTrack& track = *tracks_[piece];
  const ArticulatedPiece& of = pieces_[piece];
  if (!track.registration) {
    track.registration = std::make_unique<registration::ArticulatedRegistration>(of.model, config_.registration);
    track.about = std::make_unique<render::Scene>(surroundings_.sceneWithout(of));
    track.handles = std::make_unique<PieceHandles>(of.model, config_.handles);
  }
  registration::ImageContext context = contextOf(frame, of);
  context.surroundings = surroundingsIn(*track.about, scan, frame.T_map_camera);
  registration::ArticulatedResult result = track.registration->run(scan, frame.T_map_camera, of.believed, context);
  track.handles->add({depth_m, camera_, frame.T_map_camera}, result);
  const int index = static_cast<int>(&frame - frames_.data());
  const bool is_in_place =
      result.status == registration::BaseStatus::kRegistered && 2 * result.base_counts.agreeing > result.base_counts.read;
  track.insert({index, result.status, is_in_place, {result.T_map_model, std::move(result.joint_values)}, std::move(result.joints)});
}

std::optional<registration::Standing> StateReader::standingIn(const camera::RgbdFrame& frame, int piece) {
  const SeenFrame& of = seen(frame.index);
  const int index = static_cast<int>(&of - frames_.data());
  const auto number = static_cast<std::size_t>(piece);
  if (tracks_[number]->find(index) == nullptr) {
    registerIn(number, of, registration::makeScan(frame.depth_m, camera_, config_.scan), frame.depth_m);
  }
  const PieceShot& shot = *tracks_[number]->find(index);
  return shot.base == registration::BaseStatus::kNotThere ? std::nullopt : std::optional(shot.standing);
}

std::vector<PieceReading> StateReader::conclude() const {
  std::vector<PieceReading> readings;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const PieceTrack& track = *tracks_[p];
    if (track.frames_in_view == 0) {
      continue;
    }
    PieceReading reading{pieces_[p].id, track.frames_in_view, static_cast<int>(track.shots.size()), 0, 0, {}, {}};
    for (const PieceShot& shot : track.shots) {
      reading.in_place += shot.is_in_place ? 1 : 0;
      reading.not_there += shot.base == registration::BaseStatus::kNotThere ? 1 : 0;
    }
    const std::vector<std::vector<JointSpan>> spans = track.spans(frames_, config_.fusion);
    for (std::size_t j = 0; j < spans.size(); ++j) {
      const semantic::Joint& joint = pieces_[p].joints[static_cast<std::size_t>(track.shots.front().joints[j].joint)];
      JointReading of_joint{joint.id, joint.type, {}, track.sightings(j, frames_), {}};
      for (const PieceShot& shot : track.shots) {
        of_joint.frames.push_back(frames_[static_cast<std::size_t>(shot.index)].frame);
      }
      for (const JointSpan& span : spans[j]) {
        JointStay stay = track.stayOf(span, j, frames_);
        stay.crop = cropOf(pieces_[p], track.shots.front().joints[j].joint, span.value, seen(stay.best_frame).T_map_camera, camera_);
        of_joint.stays.push_back(stay);
      }
      reading.joints.push_back(std::move(of_joint));
    }
    reading.handles = track.handles ? track.handles->conclude() : std::vector<HandleReading>();
    readings.push_back(std::move(reading));
  }
  return readings;
}

}  // namespace oikos::tracking
