// SPDX-License-Identifier: Apache-2.0
// Upkeep: recordings of a home, read side by side, and what they say folded into its history one after the other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/recording/recording.h"
#include "semantic/history/history.h"
#include "semantic/model/home.h"
#include "tools/command.h"
#include "tools/floor_place.h"
#include "tools/mount_options.h"
#include "tools/track_changes.h"
#include "tracking/localisation/localiser.h"
#include "tracking/state/recording_states.h"
#include "tracking/state/state_events.h"

namespace oikos::tools {

struct TrackConfig {
  tracking::LocaliseConfig locate;
  tracking::StateConfig states;
  TrackChangesConfig changes;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("locate", locate);
    visitor("states", states);
    visitor("changes", changes);
  }
  [[nodiscard]] std::vector<std::string> validate() const { return {}; }
};

struct TrackTask {
  std::filesystem::path home;
  std::vector<std::filesystem::path> recordings;
  TrackConfig config;
  std::string camera = {};                    ///< as of `--camera`
  std::optional<std::int64_t> start_ns = {};  ///< of recordings that do not say it
  std::filesystem::path prior = {};           ///< TUM file, `T_map_base`; of a single recording
  std::optional<FloorPlace> from = {};        ///< likewise
  MountOptions mount = {};
  std::string object = {};   ///< one piece on demand; empty: all
  bool is_dry = false;       ///< nothing is written
  bool has_changes = false;  ///< also what the map does not explain
  int jobs = 1;              ///< recordings that are read at the same time
};

enum class TrackStatus {
  kFailed,    ///< it cannot be read, or the home cannot be written
  kKnown,     ///< its content was tracked before
  kNotFound,  ///< none of its frames was found in the home: it says nothing, and will be read again
  kTracked,
};
constexpr auto enumTable(TrackStatus) {
  return std::to_array<base::EnumName<TrackStatus>>({{TrackStatus::kFailed, "failed"},
                                                     {TrackStatus::kKnown, "tracked before"},
                                                     {TrackStatus::kNotFound, "not found"},
                                                     {TrackStatus::kTracked, "tracked"}});
}

/// What became of one recording.
struct TrackedRecording {
  std::filesystem::path folder;
  std::string name;           ///< in the history
  std::string digest;         ///< of its content; empty: of a dry run
  std::int64_t start_ns = 0;  ///< UTC of stamp 0
  TrackStatus status = TrackStatus::kFailed;
  std::string problem;              ///< why it failed,
  ExitCode code = ExitCode::kDone;  ///< and what that is
  double opening_s = 0.0;           ///< of map and home
  tracking::RecordingStates states;
  std::vector<tracking::StateEvent> events;  ///< committed, unless the run is dry
  double comparing_s = 0.0;                  ///< with the map, and recalling it
  std::vector<tracking::ChangeBox> changes;  ///< if they were asked for
  std::vector<std::string> pictures;         ///< of these, below the home; empty in a dry run
};

struct TrackOutcome {
  std::vector<TrackedRecording> recordings;  ///< in the order of time, those whose time is not known last
  std::string checkpoint_problem;            ///< why home.xml was left to be written by another process; empty: it was written
};

/// Throws Error for what is wrong with home or task. What is wrong with a recording is in the outcome, and the others go on. `done` is told
/// of each recording in that order as soon as what it says is on the disk.
[[nodiscard]] TrackOutcome trackRecordings(const TrackTask& task, const Session& session,
                                           const std::function<void(const TrackedRecording&)>& done);

}  // namespace oikos::tools
