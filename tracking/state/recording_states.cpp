// SPDX-License-Identifier: Apache-2.0
#include "tracking/state/recording_states.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/parallel.h"
#include "core/recording/frame_stream.h"

namespace oikos::tracking {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void locate(const recording::Recording& recording, Localiser& localiser, StateReader& reader, int stride,
            const base::ProgressSink& progress, RecordingStates& states) {
  recording::FrameStream stream(recording, {.stride = stride, .capacity = 4});
  while (const auto frame = stream.next()) {
    const LocatedPose pose = localiser.addUnrefined(*frame);
    states.found += pose.source != PoseSource::kNone ? 1 : 0;
    reader.look(*frame, pose);
    base::reportProgress(progress, {"locating", stream.statistics().read + stream.statistics().unreadable, stream.statistics().listed});
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
void readWanted(const recording::Recording& recording, const std::vector<int>& wanted, const Localiser& localiser, StateReader& reader,
                int threads, const base::ProgressSink& progress) {
  constexpr std::size_t kAtOnce = 8;
  for (std::size_t begin = 0; begin < wanted.size(); begin += kAtOnce) {
    std::vector<camera::RgbdFrame> frames(std::min(kAtOnce, wanted.size() - begin));
    base::parallelFor(static_cast<int>(frames.size()), threads, [&](int i) {
      frames[static_cast<std::size_t>(i)] = recording.read(wanted[begin + static_cast<std::size_t>(i)], recording::Channels::kGray);
    });
    for (const camera::RgbdFrame& frame : frames) {
      refine(frame, localiser, reader);
    }
    reader.read(frames);
    base::reportProgress(progress, {"reading doors and drawers", static_cast<int>(begin + frames.size()), static_cast<int>(wanted.size())});
  }
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

RecordingStates readStates(const recording::Recording& recording, Localiser& localiser, StateReader& reader,
                           const FrameChoiceConfig& config, int threads, const base::ProgressSink& progress) {
  RecordingStates states;
  states.frames = recording.frameCount();
  const Clock::time_point begin = Clock::now();
  locate(recording, localiser, reader, strideOf(recording, config.most_hz), progress, states);
  states.locating_s = secondsSince(begin);
  const Clock::time_point located = Clock::now();
  for (std::vector<int> wanted = reader.wanted(); !wanted.empty(); wanted = reader.wanted()) {
    readWanted(recording, wanted, localiser, reader, threads, progress);
  }
  states.pieces = reader.conclude();
  for (const PieceReading& piece : states.pieces) {
    states.registrations += piece.images;
  }
  states.reading_s = secondsSince(located);
  return states;
}

}  // namespace oikos::tracking
