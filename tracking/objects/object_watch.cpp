// SPDX-License-Identifier: Apache-2.0
// That an object has gone can be told without recognising it: its place is seen through. Other than a map's free space (mapping/change)
// this works for what is far smaller than a map's errors, since the object's own surface and what is behind it are rendered.
#include "tracking/objects/object_watch.h"

#include <algorithm>
#include <limits>

#include "core/base/config.h"
#include "core/base/error.h"
#include "tracking/objects/carrier_edges.h"
#include "tracking/objects/object_sight.h"

namespace oikos::tracking {

namespace {

constexpr double kSecond_ns = 1e9;
constexpr std::int64_t kAnyTime = std::numeric_limits<std::int64_t>::min();

/// From when on an image shows what is there at the end.
std::int64_t latePart_ns(const std::vector<ObjectCandidate>& candidates, const ObjectViewConfig& config) {
  const auto best = std::max_element(candidates.begin(), candidates.end(),
                                     [](const ObjectCandidate& a, const ObjectCandidate& b) { return a.worth < b.worth; });
  const auto last = std::find_if(candidates.rbegin(), candidates.rend(),
                                 [&](const ObjectCandidate& one) { return one.worth >= config.min_worth * best->worth; });
  return last->stamp_ns - static_cast<std::int64_t>(config.later_s * kSecond_ns);
}

}  // namespace

ObjectWatch::ObjectWatch(const semantic::Home& home, const std::filesystem::path& home_folder, const CarrierReadings& readings,
                         const std::vector<WatchFrame>& frames, const camera::PinholeCamera& camera, const ObjectWatchConfig& config)
    : camera_(camera), config_(config), scene_(home, home_folder, readings) {
  OIKOS_CHECK(base::validateConfig(config).empty());
  for (std::vector<ObjectCandidate>& candidates : findCandidates(scene_, frames, camera, config.views)) {
    tracks_.push_back({std::move(candidates), {}, {}});
  }
  for (const WatchFrame& frame : frames) {
    if (frame.was_read) {
      read_.insert(frame.frame);
    }
  }
}

/// One at the end, where it is seen for longer, and others from elsewhere.
void ObjectWatch::wantFirst(Track& track, std::set<int>& read) const {
  if (track.candidates.empty()) {
    return;
  }
  std::vector<Eigen::Vector3d> places_map;
  std::int64_t from_ns = latePart_ns(track.candidates, config_.views);
  while (static_cast<int>(track.wanted.size()) < config_.views.first_views) {
    const auto best = bestCandidate(track.candidates, from_ns, places_map, read, config_.views);
    if (!best) {
      return;
    }
    track.wanted.insert(best->frame);
    read.insert(best->frame);
    places_map.push_back(best->camera_map);
    from_ns = kAnyTime;
  }
}

/// Where images do not agree, or one alone does not see it, or it was hidden or not measured.
void ObjectWatch::wantAnother(Track& track, std::set<int>& read) const {
  const ObjectReading so_far = testMissed(track.sights, config_.views.apart_m, config_.missed);
  const bool is_open = so_far.status == WatchStatus::kUnclear && so_far.not_there > 0 && so_far.views < config_.views.most_views;
  const bool was_blind = std::any_of(track.sights.begin(), track.sights.end(), [](const TimedSight& one) { return one.sight.is_blind; });
  const bool is_blocked = (so_far.status == WatchStatus::kHidden || (so_far.status == WatchStatus::kUnclear && was_blind)) &&
                          so_far.views < config_.views.first_views + config_.views.more_views;
  if (!is_open && !is_blocked) {
    return;
  }
  std::vector<Eigen::Vector3d> places_map;
  std::int64_t from_ns = kAnyTime;  // what was there and is not any more has gone since
  for (const TimedSight& one : track.sights) {
    places_map.push_back(one.camera_map);
    from_ns = one.sight.verdict == SightVerdict::kThere ? std::max(from_ns, one.stamp_ns) : from_ns;
  }
  if (const auto best = bestCandidate(track.candidates, from_ns, places_map, read, config_.views)) {
    track.wanted.insert(best->frame);
    read.insert(best->frame);
  }
}

std::vector<int> ObjectWatch::wanted() {
  std::set<int> frames;
  for (Track& track : tracks_) {
    has_chosen_ ? wantAnother(track, read_) : wantFirst(track, read_);
    frames.insert(track.wanted.begin(), track.wanted.end());
  }
  has_chosen_ = true;
  return {frames.begin(), frames.end()};
}

void ObjectWatch::look(const camera::RgbdFrame& frame, const WatchFrame& seen) {
  std::vector<std::size_t> objects;
  std::set<int> pushed;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].wanted.erase(frame.index) > 0) {
      objects.push_back(i);
      if (scene_.objects()[i].can_be_pushed) {
        pushed.insert(scene_.objects()[i].carrier_model);
      }
    }
  }
  if (objects.empty()) {
    return;
  }
  scene_.goTo(seen.stamp_ns);
  const DepthView view{frame.depth_m, camera_, seen.T_map_camera, seen.covariance};
  std::map<int, EdgeCount> edges = countEdges(scene_, pushed, view, config_.sight);
  for (const std::size_t i : objects) {
    const WatchedObject& object = scene_.objects()[i];
    TimedSight timed{seen.frame, seen.stamp_ns, seen.T_map_camera.translation(), {}};
    if (const auto stand = scene_.stand(i)) {
      timed.sight = lookAt(scene_, i, *stand, view, config_.sight);
    }
    if (object.can_be_pushed && timed.sight.against > 0.0 && !edges[object.carrier_model].isInPlace(config_.sight)) {
      timed.sight.verdict = SightVerdict::kUnclear;  // it may have gone with what carries it
      timed.sight.against = 0.0;
    }
    auto& sights = tracks_[i].sights;
    sights.insert(std::upper_bound(sights.begin(), sights.end(), timed,
                                   [](const TimedSight& a, const TimedSight& b) { return a.stamp_ns < b.stamp_ns; }),
                  timed);
  }
}

std::vector<ObjectReading> ObjectWatch::conclude() const {
  std::vector<ObjectReading> readings;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].sights.empty()) {
      ObjectReading reading = testMissed(tracks_[i].sights, config_.views.apart_m, config_.missed);
      reading.id = scene_.objects()[i].id;
      reading.placement = scene_.objects()[i].placement;
      readings.push_back(std::move(reading));
    }
  }
  return readings;
}

}  // namespace oikos::tracking
