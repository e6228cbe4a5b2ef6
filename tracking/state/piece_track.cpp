// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/piece_track.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/degrees.h"
#include "registration/articulated/joint_moment.h"
#include "tracking/state/frame_choice.h"

namespace oikos::tracking {

namespace {

using registration::JointSighting;
using registration::JointSpan;
using registration::JointStatus;

/// The images that a change lies between: the second shows it.
struct Stretch {
  std::size_t last_before = 0;
  std::size_t first_after = 0;
};
Stretch stretchOf(const std::vector<JointSighting>& sightings, const JointSpan& before, const JointSpan& after,
                  const registration::JointFusionConfig& config) {
  if (before.status == JointStatus::kFound && after.status == JointStatus::kFound && before.value != after.value) {
    const auto begin = sightings.begin() + static_cast<std::ptrdiff_t>(before.first);
    const auto end = sightings.begin() + static_cast<std::ptrdiff_t>(after.last) + 1;
    const auto moment = registration::findMoment({begin, end}, {before.value, after.value}, config);
    if (moment && moment->last_before) {
      return {before.first + *moment->last_before, before.first + moment->first_after};
    }
  }
  return {before.last, after.first};
}

}  // namespace

const PieceShot* PieceTrack::find(int index) const {
  const auto found = std::find_if(shots.begin(), shots.end(), [&](const PieceShot& shot) { return shot.index == index; });
  return found == shots.end() ? nullptr : &*found;
}

void PieceTrack::insert(PieceShot shot) {
  const auto after = std::find_if(shots.begin(), shots.end(), [&](const PieceShot& other) { return other.index > shot.index; });
  shots.insert(after, std::move(shot));
}

std::vector<int> PieceTrack::indices() const {
  std::vector<int> indices;
  indices.reserve(shots.size());
  for (const PieceShot& shot : shots) {
    indices.push_back(shot.index);
  }
  return indices;
}

void PieceTrack::want(std::optional<int> index) {
  if (index && find(*index) == nullptr) {
    wanted.insert(*index);
  }
}

std::vector<JointSighting> PieceTrack::sightings(std::size_t joint, const std::vector<SeenFrame>& frames) const {
  std::vector<JointSighting> sightings;
  for (const PieceShot& shot : shots) {
    const SeenFrame& frame = frames[static_cast<std::size_t>(shot.index)];
    const registration::JointEstimate& estimate = shot.joints[joint];
    sightings.push_back({frame.stamp_ns, frame.T_map_camera, estimate.status, estimate.confidence, estimate.evidence});
  }
  return sightings;
}

std::vector<std::vector<JointSpan>> PieceTrack::spans(const std::vector<SeenFrame>& frames,
                                                      const registration::JointFusionConfig& config) const {
  std::vector<std::vector<JointSpan>> spans;
  for (std::size_t joint = 0; !shots.empty() && joint < shots.front().joints.size(); ++joint) {
    spans.push_back(shots.size() == 1 ? loneSpan(joint, frames) : registration::fuse(sightings(joint, frames), config));
  }
  return spans;
}

void PieceTrack::wantMoment(const JointSpan& before, const JointSpan& after, std::size_t joint, int piece,
                            const std::vector<SeenFrame>& frames, const registration::JointFusionConfig& config) {
  const Stretch stretch = stretchOf(sightings(joint, frames), before, after, config);
  const std::size_t begin = stretch.last_before;
  const std::size_t end = stretch.first_after;
  want(frameBetween(frames, piece, shots[begin].index, shots[begin + 1].index));
  want(frameBetween(frames, piece, shots[end - 1].index, shots[end].index));
}

int PieceTrack::foundIn(const JointSpan& span, std::size_t joint) const {
  int found = 0;
  for (std::size_t i = span.first; i <= span.last; ++i) {
    found += shots[i].joints[joint].status == JointStatus::kFound ? 1 : 0;
  }
  return found;
}

std::size_t PieceTrack::witnessOf(const JointSpan& span, std::size_t joint) const {
  std::size_t i = span.first;
  while (shots[i].joints[joint].status != JointStatus::kFound) {
    ++i;
  }
  return i;
}

std::vector<std::size_t> PieceTrack::dissenters(const JointSpan& span, std::size_t joint,
                                                const registration::JointDecisionConfig& config) const {
  std::vector<std::size_t> dissenters;
  for (std::size_t i = span.first; i <= span.last; ++i) {
    const registration::JointEstimate& estimate = shots[i].joints[joint];
    const double same = estimate.evidence.is_turn ? config.window_deg * base::kRadPerDeg : config.window_m;
    if (estimate.status == JointStatus::kFound && std::abs(estimate.value - span.value) > same) {
      dissenters.push_back(i);
    }
  }
  return dissenters;
}

int PieceTrack::readAbout(std::size_t shot, const std::vector<SeenFrame>& frames) const {
  constexpr std::int64_t kAbout_ns = 500'000'000;
  const auto stampOf = [&](const PieceShot& one) { return frames[static_cast<std::size_t>(one.index)].stamp_ns; };
  return static_cast<int>(std::count_if(shots.begin(), shots.end(),
                                        [&](const PieceShot& one) { return std::abs(stampOf(one) - stampOf(shots[shot])) <= kAbout_ns; }));
}

JointStay PieceTrack::stayOf(const JointSpan& span, std::size_t joint, const std::vector<SeenFrame>& frames) const {
  JointStay stay;
  stay.span = span;
  const auto seenIn = [&](std::size_t shot) -> const SeenFrame& { return frames[static_cast<std::size_t>(shots[shot].index)]; };
  stay.first_ns = seenIn(span.first).stamp_ns;
  stay.first_frame = seenIn(span.first).frame;
  int most = -1;
  for (std::size_t i = span.first; i <= span.last; ++i) {
    const registration::JointEstimate& estimate = shots[i].joints[joint];
    const bool is_found = estimate.status == JointStatus::kFound;
    stay.images += estimate.status != JointStatus::kNotInView ? 1 : 0;
    if (is_found && stay.found++ == 0) {
      stay.first_ns = seenIn(i).stamp_ns;
      stay.first_frame = seenIn(i).frame;
    }
    const int shown = estimate.sight.agreeing + (is_found ? 1'000'000 : 0);
    if (shown > most) {
      most = shown;
      stay.best_frame = seenIn(i).frame;
    }
  }
  return stay;
}

std::vector<JointSpan> PieceTrack::loneSpan(std::size_t joint, const std::vector<SeenFrame>& frames) const {
  const registration::JointEstimate& estimate = shots.front().joints[joint];
  const std::int64_t stamp_ns = frames[static_cast<std::size_t>(shots.front().index)].stamp_ns;
  if (estimate.status == JointStatus::kNotInView) {
    return {};
  }
  return {{0, 0, stamp_ns, stamp_ns, estimate.status, estimate.value, estimate.variance, estimate.confidence}};
}

}  // namespace oikos::tracking
