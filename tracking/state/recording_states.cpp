// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/recording_states.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "core/base/parallel.h"
#include "core/recording/frame_stream.h"
#include "tracking/state/base_check.h"
#include "tracking/state/object_readings.h"

namespace oikos::tracking {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Frames that were decoded already, of a recording that is not longer than this: an answer on demand does not wait for them twice.
constexpr int kKeptFrames = 8;
using KeptFrames = std::map<int, camera::RgbdFrame>;

void locate(const recording::Recording& recording, const StateTools& tools, int stride, KnobWatch& knobs, KeptFrames& kept,
            RecordingStates& states) {
  recording::FrameStream stream(recording, {.stride = stride, .capacity = 4});
  while (const auto frame = stream.next()) {
    const LocatedPose pose = tools.localiser.addUnrefined(*frame);
    states.found += pose.isFound() ? 1 : 0;
    tools.reader.look(*frame, pose);
    knobs.look(*frame, pose);
    if (recording.frameCount() <= kKeptFrames) {
      kept.emplace(frame->index, *frame);
    }
    base::reportProgress(tools.progress,
                         {"locating", stream.statistics().read + stream.statistics().unreadable, stream.statistics().listed});
  }
  states.located = stream.statistics().read;
  states.unreadable = stream.statistics().unreadable;
}

/// One that was found in the map, by the furniture in view as well.
void refine(const camera::RgbdFrame& frame, const Localiser& localiser, StateReader& reader) {
  const SeenFrame& seen = reader.seen(frame.index);
  if (seen.source != PoseSource::kMap) {
    return;
  }
  LocatedPose pose{seen.frame, seen.stamp_ns, seen.source, seen.T_map_camera, seen.covariance, seen.T_map_camera, {}, {}};
  localiser.refine(frame, pose);
  reader.place(seen.frame, pose);
}

/// All that the reader wants at this time, a few at once.
void readWanted(const recording::Recording& recording, const std::vector<int>& wanted, const KeptFrames& kept, const StateTools& tools) {
  constexpr std::size_t kAtOnce = 8;
  for (std::size_t begin = 0; begin < wanted.size(); begin += kAtOnce) {
    std::vector<camera::RgbdFrame> frames(std::min(kAtOnce, wanted.size() - begin));
    base::parallelFor(static_cast<int>(frames.size()), tools.threads, [&](int i) {
      const int number = wanted[begin + static_cast<std::size_t>(i)];
      const auto found = kept.find(number);
      frames[static_cast<std::size_t>(i)] = found != kept.end() ? found->second : recording.read(number, recording::Channels::kGray);
    });
    for (const camera::RgbdFrame& frame : frames) {
      refine(frame, tools.localiser, tools.reader);
    }
    tools.reader.read(frames);
    base::reportProgress(tools.progress,
                         {"reading doors and drawers", static_cast<int>(begin + frames.size()), static_cast<int>(wanted.size())});
  }
}

/// In colour, each in a piece that was registered in the same frame.
void readKnobs(const recording::Recording& recording, const StateTools& tools, KnobWatch& knobs) {
  for (std::vector<WantedKnobs> wanted = knobs.wanted(); !wanted.empty(); wanted = knobs.wanted()) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const camera::RgbdFrame frame = recording.read(wanted[i].frame, recording::Channels::kColor);
      refine(frame, tools.localiser, tools.reader);
      for (const int piece : wanted[i].pieces) {
        if (const auto standing = tools.reader.standingIn(frame, piece)) {
          knobs.read(frame, tools.reader.seen(frame.index).T_map_camera, piece, *standing);
        }
      }
      base::reportProgress(tools.progress, {"reading knobs", static_cast<int>(i + 1), static_cast<int>(wanted.size())});
    }
  }
}

/// Each shiftable piece in the views that are best for it.
std::vector<FurniturePlace> placesOf(const recording::Recording& recording, const StateTools& tools,
                                     const std::vector<PieceReading>& pieces) {
  std::vector<FurnitureView> frames;
  for (const SeenFrame& seen : tools.reader.frames()) {
    if (seen.source != PoseSource::kCarried) {
      frames.push_back({seen.frame, seen.stamp_ns, seen.T_map_camera});
    }
  }
  MovedFurnitureConfig config = tools.config.furniture;
  config.threads = tools.threads;
  std::vector<FurniturePlace> places;
  for (const semantic::Room& room : tools.home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (object.movability != semantic::Movability::kShiftable || (!tools.only.empty() && object.id.value != tools.only)) {
        continue;
      }
      const std::vector<FurnitureView> views = viewsFor(object, frames, recording.camera(), config);
      std::vector<mapping::LocatedScan> scans;
      for (const FurnitureView& view : views) {
        const camera::RgbdFrame frame = recording.read(view.frame, recording::Channels::kGray);
        refine(frame, tools.localiser, tools.reader);
        scans.push_back(halvedScan(frame.depth_m, recording.camera(), tools.reader.seen(view.frame).T_map_camera));
      }
      if (const auto place = placeOf(tools.home, tools.home_folder, object.id, scans, config)) {
        const FurniturePlace found{object.id,  place->T_map_after,     place->views,       place->spread_m,
                                   place->fit, views.front().stamp_ns, views.front().frame};
        if (!isRefuted(found, object, pieces)) {
          places.push_back(found);
        }
      }
    }
  }
  return places;
}

}  // namespace

int strideOf(const recording::Recording& recording, double most_hz) {
  const int count = recording.frameCount();
  if (count < 2) {
    return 1;
  }
  const double length_s = static_cast<double>(recording.stampNs(count - 1) - recording.stampNs(0)) / 1e9;
  return length_s > 0.0 ? std::max(1, static_cast<int>(std::lround((count - 1) / length_s / most_hz))) : 1;
}

RecordingStates readStates(const recording::Recording& recording, const StateTools& tools) {
  RecordingStates states;
  states.frames = recording.frameCount();
  const Clock::time_point begin = Clock::now();
  const int stride = strideOf(recording, tools.config.frames.most_hz);
  KnobWatch knobs(tools.reader.pieces(), recording.camera(), tools.config.knobs, tools.config.frames, tools.threads);
  KeptFrames kept;
  locate(recording, tools, stride, knobs, kept, states);
  states.locating_s = secondsSince(begin);
  const Clock::time_point located = Clock::now();
  for (std::vector<int> wanted = tools.reader.wanted(); !wanted.empty(); wanted = tools.reader.wanted()) {
    readWanted(recording, wanted, kept, tools);
  }
  readKnobs(recording, tools, knobs);
  states.knobs = knobs.conclude();
  states.pieces = tools.reader.conclude();
  for (const PieceReading& piece : states.pieces) {
    states.registrations += piece.images;
  }
  states.furniture = placesOf(recording, tools, states.pieces);
  states.objects = readObjects(states, recording.camera(), tools, [&](int number) {
    camera::RgbdFrame frame = recording.read(number, recording::Channels::kGray);
    refine(frame, tools.localiser, tools.reader);
    return frame;
  });
  states.reading_s = secondsSince(located);
  return states;
}

}  // namespace oikos::tracking
