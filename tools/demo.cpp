// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <string>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/posix_file.h"
#include "core/base/read_file.h"
#include "core/base/rfc3339.h"
#include "core/geometry/ply.h"
#include "core/metrics/trajectory_error.h"
#include "core/recording/png_encoder.h"
#include "core/recording/recording.h"
#include "core/recording/trajectory.h"
#include "semantic/history/history.h"
#include "semantic/history/home_state.h"
#include "semantic/query/answer.h"
#include "tools/command.h"
#include "tools/demo/demo_page.h"
#include "tools/demo/floor_picture.h"
#include "tools/interrupts.h"
#include "tools/locate_job.h"
#include "tools/map_home.h"
#include "tools/simulate/simulator.h"
#include "tools/terminal_progress.h"
#include "tools/track_answers.h"
#include "tools/track_batch.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "  oikos demo --out demo\n"
    "  oikos demo --home homes/demo --scene drive --then later --out demo --seed 7";

constexpr std::array kQuestions = {"Where is the blue cup?",        "How many cups are there?",
                                   "What is on the kitchen table?", "Is the fridge open?",
                                   "Which doors are open?",         "Where do I stand to reach the oven?",
                                   "What is in the tall cupboard?", "What is nearest to the sofa?",
                                   "How do I open the wardrobe?",   "Bring me the milk."};

constexpr std::array kChangeQuestions = {"Is the fridge open?", "Which drawers are open?", "Is the oven on?", "Where is the red cup?",
                                         "What changed since the last recording?"};

constexpr const char* kLater = "later";

struct DemoOptions {
  fs::path home = "homes/demo";
  std::string scene = "drive";
  std::string then;  ///< a second scene; empty: none
  fs::path out = "oikos-demo";
};

bool hasScene(const DemoOptions& options, const std::string& scene) {
  return fs::exists(options.home / "scenes" / (scene + ".toml"));
}

/// Throws where the scene is none of the home's, which it says.
void checkScene(const DemoOptions& options, const std::string& scene) {
  if (hasScene(options, scene)) {
    return;
  }
  const fs::path scenes = options.home / "scenes";
  std::set<std::string> known;
  for (const auto& entry : fs::exists(scenes) ? fs::directory_iterator(scenes) : fs::directory_iterator()) {
    known.insert(entry.path().stem().string());
  }
  std::string names;
  for (const std::string& name : known) {
    names += (names.empty() ? "" : ", ") + name;
  }
  throw base::Error(base::ErrorCode::kUsage, "has no scene '" + scene + "'; it has: " + (names.empty() ? "none" : names),
                    options.home.string());
}

/// Throws where it is no home, and for scenes that it does not have.
void checkHome(const DemoOptions& options) {
  if (!fs::exists(options.home / "home.xml")) {
    throw base::Error(base::ErrorCode::kUsage, "is no home: it has no home.xml; give the demo's with --home", options.home.string());
  }
  checkScene(options, options.scene);
  if (!options.then.empty()) {
    checkScene(options, options.then);
  }
}

/// Home and scenes, to be mapped into and asked: the original stays as it is.
void copyHome(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const char* made : {"history.sqlite", "history.sqlite-wal", "history.sqlite-shm", "evidence"}) {
    fs::remove_all(to / made);  // of an earlier demo
  }
  for (const char* name : {"home.xml", "scenes", "models"}) {
    if (fs::exists(from / name)) {
      fs::copy(from / name, to / name, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    }
  }
}

void simulateDrive(const fs::path& script, const fs::path& drive, const Session& session) {
  fs::remove_all(drive);
  fs::create_directories(drive);
  TerminalProgress progress(session.options);
  (void)simulate::simulate({script, drive, static_cast<std::uint64_t>(session.options.seed), session.options.threads, progress.sink()});
}

/// Answers to questions about a home, as `oikos ask` gives them.
class Asked {
 public:
  Asked(const fs::path& home, std::int64_t now_ns)
      : home_(semantic::loadHome(home)),
        index_(home_),
        history_(home / "history.sqlite", semantic::HistoryAccess::kRead),
        now_ns_(now_ns) {}

  [[nodiscard]] std::string answer(const char* question) const {
    return semantic::answerQuestion({&index_, &history_, now_ns_, semantic::RobotPlace{}}, question).sentence;
  }
  [[nodiscard]] const semantic::Home& home() const { return home_; }

 private:
  semantic::Home home_;
  semantic::HomeIndex index_;
  semantic::History history_;
  std::int64_t now_ns_;
};

std::vector<std::pair<std::string, std::string>> figures(const fs::path& home, const fs::path& drive, const mapping::MapResult& map) {
  const auto estimate = recording::readTrajectory(home / "map" / "trajectory.txt");
  const auto truth = recording::readTrajectory(drive / "groundtruth.txt");
  const metrics::TrajectoryError error = metrics::evaluateTrajectory(estimate, truth, {});
  double in_place_m = 0.0;
  for (const recording::StampedPose& pose : estimate) {
    const auto same = std::find_if(truth.begin(), truth.end(), [&](const auto& other) { return other.stamp_ns == pose.stamp_ns; });
    if (same != truth.end()) {
      in_place_m = std::max(in_place_m, (same->T_map_camera.translation() - pose.T_map_camera.translation()).norm());
    }
  }
  return {{"frames", std::to_string(map.frames) + ", " + std::to_string(map.lost_frames) + " lost"},
          {"way driven", base::toFixedText(error.truth_path_m, 1) + " m in " + base::toFixedText(error.duration_s, 0) + " s"},
          {"error of the camera's path (ATE RMSE)", base::toFixedText(100.0 * error.absolute_m.rmse, 2) + " cm"},
          {"largest error in the home's own frame", base::toFixedText(100.0 * in_place_m, 1) + " cm"},
          {"keyframes, loops", std::to_string(map.keyframes) + ", " + std::to_string(map.loops)}};
}

std::vector<std::string> someFrames(const fs::path& drive) {
  constexpr std::size_t kFrames = 12;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(drive / "rgb")) {
    files.push_back(entry.path());
  }
  // By time: names are seconds with a fixed number of decimals.
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(a.string().size(), a.string()) < std::pair(b.string().size(), b.string());
  });
  std::vector<std::string> frames;
  for (std::size_t i = 0; i < std::min(kFrames, files.size()); ++i) {
    frames.push_back(base::readFile(files[i * files.size() / std::min(kFrames, files.size())]));
  }
  return frames;
}

std::int64_t timeOf(const recording::Recording& recording) {
  return recording.startNs().value_or(0);
}

std::string pngOf(const fs::path& home, const semantic::Home& known) {
  const auto floor = recording::encodePng(demo::drawFloor({geometry::readPly(home / "map" / "cloud.ply"), known,
                                                           recording::readTrajectory(home / "map" / "base_trajectory.txt")}),
                                          6);
  return {floor.begin(), floor.end()};
}

/// A second drive, tracked in the mapped home: what it changes there.
demo::DemoChanges trackLater(const DemoOptions& options, const fs::path& home, const Session& session) {
  const fs::path drive = options.out / options.then;
  simulateDrive(home / "scenes" / (options.then + ".toml"), drive, session);
  const auto recording = recording::openRecording(drive, {});
  const std::int64_t now_ns = timeOf(*recording) + recording->stampNs(recording->frameCount() - 1);
  const Asked before(home, now_ns);
  demo::DemoChanges changes;
  for (const char* question : kChangeQuestions) {
    changes.questions.push_back({question, before.answer(question), {}});
  }
  TrackTask task;
  task.home = home;
  task.recordings = {drive};
  task.config.locate = localiseConfigOf(home, session.options.threads);
  const TrackOutcome outcome = trackRecordings(task, session, [](const TrackedRecording&) {});
  const TrackedRecording& tracked = outcome.recordings.front();
  if (tracked.status == TrackStatus::kFailed) {
    throw base::Error(base::ErrorCode::kInput, tracked.problem);
  }
  for (const tracking::StateEvent& event : tracked.events) {
    changes.events.push_back({eventText(event), base::readFile(home / event.event.evidence)});
  }
  const Asked after(home, now_ns);
  for (demo::AnsweredTwice& one : changes.questions) {
    one.after = after.answer(one.question.c_str());
  }
  changes.floor_png = pngOf(home, after.home());
  return changes;
}

void print(const demo::DemoPage& page) {
  for (const auto& [name, value] : page.facts) {
    std::cout << name << ": " << value << '\n';
  }
  for (const auto& [question, answer] : page.questions) {
    std::cout << "\n> " << question << '\n' << answer << '\n';
  }
  if (!page.later) {
    return;
  }
  std::cout << "\nA second recording:\n";
  for (const demo::DemoEvent& event : page.later->events) {
    std::cout << "  " << event.text << '\n';
  }
  for (const demo::AnsweredTwice& one : page.later->questions) {
    std::cout << "\n> " << one.question << "\nbefore: " << one.before << "\nafter:  " << one.after << '\n';
  }
}

ExitCode runDemo(const DemoOptions& options, const Session& session) {
  const fs::path home = options.out / "home";
  const fs::path drive = options.out / "drive";
  checkHome(options);
  copyHome(options.home, home);
  simulateDrive(home / "scenes" / (options.scene + ".toml"), drive, session);
  const auto recording = recording::openRecording(drive, {});
  const mapping::MapResult map = mapIntoHome({*recording, home, mapping::MapConfig{}, recording->T_base_camera()}, session);
  demo::DemoPage page;
  const Asked known(home, timeOf(*recording));
  for (const char* question : kQuestions) {
    page.questions.emplace_back(question, known.answer(question));
  }
  page.facts = figures(home, drive, map);
  page.frames_jpg = someFrames(drive);
  page.floor_png = pngOf(home, known.home());
  if (!options.then.empty()) {
    page.later = trackLater(options, home, session);
    base::writeFileAtomically(options.out / "floor-later.png", page.later->floor_png);
  }
  base::writeFileAtomically(options.out / "floor.png", page.floor_png);
  base::writeFileAtomically(options.out / "report.html", demo::toHtml(page));
  print(page);
  std::cout << "\nreport: " << (options.out / "report.html").string() << '\n';
  return ExitCode::kDone;
}

}  // namespace

void addDemoCommand(CLI::App& root) {
  CLI::App& command = addCommand(
      root,
      {"demo", "Simulates a drive through a home, maps it, asks about it, tracks a second drive, and makes a page to look at.", kExamples});
  const auto options = std::make_shared<DemoOptions>();
  command.add_option("--home", options->home, "the home, with its scenes; default: homes/demo");
  command.add_option("--scene", options->scene, "which of its scenes; default: drive");
  auto* const then = command.add_option(
      "--then", options->then, "a second of its scenes, which the mapped home is tracked in; default: later, where there is one; '': none");
  command.add_option("--out", options->out, "folder of what is made; default: oikos-demo");
  setAction(command, [options, then](const Session& session) {
    DemoOptions all = *options;
    if (then->count() == 0 && hasScene(all, kLater)) {
      all.then = kLater;
    }
    return runDemo(all, session);
  });
}

}  // namespace oikos::tools
