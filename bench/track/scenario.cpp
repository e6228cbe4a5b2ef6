// SPDX-License-Identifier: Apache-2.0
#include "bench/track/scenario.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>

#include "bench/track/free_range.h"
#include "bench/track/shown_parts.h"
#include "core/base/config.h"
#include "core/base/number_text.h"
#include "core/base/read_file.h"

namespace oikos::bench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kShown = 0.15;  // of the part's pixels, for an image to show it,
constexpr int kShowing = 2;      // and so many images have to

std::map<std::string, Json> wrongJoints(const Json& states) {
  std::map<std::string, Json> wrong;
  for (const Json& state : states) {
    if (!state["right"].get<bool>() && !state.contains("believed")) {
      wrong[state["id"]] = state;
    }
  }
  return wrong;
}

/// What the last event of the joint says of when it was moved, against the pictures.
MovedInDrive momentOf(const Json& events, const StateChange& change, const ShownParts& shown) {
  MovedInDrive moved;
  moved.id = change.joint.id;
  for (const Json& event : events) {
    if (event["subject"] == change.joint.id) {
      moved.told = event["frame"].get<int>();
      moved.last_before = event["last_before"].is_null() ? -1 : event["last_before"]["frame"].get<int>();
    }
  }
  const std::vector<double> shares = shown.sharesOf(change.joint.id);
  moved.moment = static_cast<int>(std::lround(change.at_s * kDriveRate_hz));  // as the scene has it: to a tenth of a second
  const auto moment = shares.begin() + moved.moment;
  moved.first_shown = static_cast<int>(std::find_if(moment, shares.end(), [](double share) { return share >= kShown; }) - shares.begin());
  moved.is_in_view = moved.moment > 0 && moment[-1] >= kShown && moved.first_shown == moved.moment;
  return moved;
}

/// What a change's images say: how many show it after it has happened, and how much the best one does.
struct Showing {
  int images = 0;
  double best = 0.0;
};
Showing showingOf(const ShownParts& shown, const StateChange& change) {
  Showing showing;
  const std::vector<double> shares = shown.sharesOf(change.joint.id);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (static_cast<double>(i) / kDriveRate_hz >= change.at_s) {
      showing.images += shares[i] >= kShown ? 1 : 0;
      showing.best = std::max(showing.best, shares[i]);
    }
  }
  return showing;
}

}  // namespace

Scenario::Scenario(const ScenarioOptions& options)
    : options_(options), random_(options.seed), routes_(routesWithin(freeUppers(options.demo_home))) {
  fs::create_directories(home());
  fs::create_directories(deployed() / "scenes");
  for (const fs::path& folder : {home(), deployed()}) {
    fs::copy_file(options.demo_home / "home.xml", folder / "home.xml", fs::copy_options::overwrite_existing);
  }
  for (const char* file : {"history.sqlite", "history.sqlite-wal", "history.sqlite-shm"}) {
    fs::remove(home() / file);
  }
  for (const char* door : {"kitchen", "bathroom", "living", "bedroom"}) {
    states_[std::string(door) + "-door-door-joint"] = {95.0, true};
  }
  if (!fs::exists(home() / "map")) {
    deploy();
  }
}

void Scenario::deploy() const {
  auto script = base::loadConfig<simulate::SceneScript>({options_.demo_home / "scenes" / "drive.toml", {}});
  believe(script);
  simulate("deployment", script);
  const ChildRun run = must({"map", drive("deployment").string(), "--out", home().string(), "--quiet"});
  std::printf("deployment mapped in %.0f s\n", run.wall_s);
}

void Scenario::run(int number, ScenarioTally& tally) {
  const Route& route = routes_[static_cast<std::size_t>(number) % routes_.size()];
  const std::vector<StateChange> changes = drawChanges(route, states_, number, random_);
  const std::string name = "drive-" + std::to_string(number);
  simulate(name, scriptOf(number, route, changes));
  const Json before = evaluated(name);
  std::vector<std::string> words = {"track", home().string(), drive(name).string(), "--json", "--quiet"};
  for (const std::string& setting : options_.settings) {
    words.insert(words.end(), {"--set", setting});
  }
  const ChildRun tracked = must(words);
  const Json recording = Json::parse(tracked.out)["recordings"][0];
  tally.cpu_s += tracked.cpu_s;
  tally.peak_mb = std::max(tally.peak_mb, tracked.peak_mb);
  tally.frames += recording["frames"].get<int>();
  tally.seconds += recording["locating_s"].get<double>() + recording["reading_s"].get<double>();
  tally.best_rate = std::max(tally.best_rate, recording["frames_per_s"].get<double>());
  std::printf("%2d %-17s %d of %d frames found, %d registrations, ", number + 1, route.name.c_str(), recording["found"].get<int>(),
              recording["looked_for"].get<int>(), recording["registrations"].get<int>());
  judge(number, changes, before, recording, tally);
}

simulate::SceneScript Scenario::scriptOf(int number, const Route& route, const std::vector<StateChange>& changes) {
  constexpr int kADay = 12;
  simulate::SceneScript script;
  const std::string day = base::toFixedText(number / kADay + 103, 0).substr(1);
  script.start = "2026-03-" + day + "T" + std::to_string(10 + number % kADay) + ":00:00Z";
  script.rate_hz = kDriveRate_hz;
  script.path.start = route.start;
  script.path.waypoints = route.waypoints;
  script.path.speed_mps = 0.6;
  script.path.turn_rate_dps = 50.0;
  script.path.stand_s = 0.4;
  script.duration_s = 9.9;  // a hundred frames
  script.part_images = true;
  for (const auto& [id, stand] : states_) {
    script.changes.push_back(changeText(id, stand));
  }
  for (const StateChange& change : changes) {
    const Stand stand{change.value, change.joint.turns};
    states_[change.joint.id] = stand;
    const std::string text = changeText(change.joint.id, stand);
    script.changes.push_back(change.at_s > 0.0 ? "@" + base::toFixedText(change.at_s, 1) + " " + text : text);
  }
  believe(script);
  return script;
}

void Scenario::believe(simulate::SceneScript& script) const {
  script.belief.dimension_m = options_.belief_mm / 1000.0;
  script.belief.placement_m = options_.belief_mm / 1000.0;
  script.belief.placement_deg = 0.06 * options_.belief_mm;
  script.belief.axis_m = 0.6 * options_.belief_mm / 1000.0;
  script.belief.axis_deg = 0.1 * options_.belief_mm;
}

void Scenario::simulate(const std::string& name, const simulate::SceneScript& script) const {
  const fs::path file = deployed() / "scenes" / (name + ".toml");
  const std::string text = base::writeConfig(script);
  if (fs::exists(drive(name)) && fs::exists(file) && base::readFile(file) == text) {
    return;
  }
  std::ofstream(file) << text;
  fs::remove_all(drive(name));
  must({"simulate", file.string(), "--out", drive(name).string(), "--quiet", "--seed", std::to_string(options_.seed)});
}

ChildRun Scenario::must(std::vector<std::string> words) const {
  words.insert(words.begin(), options_.oikos.string());
  words.insert(words.end(), {"--threads", std::to_string(options_.threads)});
  ChildRun run = runChild(words, options_.folder / "out");
  if (run.exit_code != 0) {
    throw std::runtime_error(words[1] + " " + words[2] + " ended with " + std::to_string(run.exit_code));
  }
  return run;
}

Json Scenario::evaluated(const std::string& name) const {
  return Json::parse(must({"evaluate", "states", home().string(), drive(name).string(), "--json"}).out)["states"];
}

void Scenario::judge(int number, const std::vector<StateChange>& changes, const Json& before, const Json& recording,
                     ScenarioTally& tally) const {
  const std::string name = "drive-" + std::to_string(number);
  const std::map<std::string, Json> pending = wrongJoints(before);  // by the end of the drive
  const std::map<std::string, Json> wrong = wrongJoints(evaluated(name));
  const ShownParts shown(drive(name));
  std::set<std::string> told;
  int false_here = 0;
  for (const Json& event : recording["events"]) {
    const std::string id = event["subject"];
    told.insert(id);
    false_here += !pending.contains(id) || wrong.contains(id) ? 1 : 0;
  }
  int missed = 0;
  std::string hardly;
  for (const StateChange& change : changes) {
    if (!pending.contains(change.joint.id)) {
      continue;  // it is back where the home has it: an earlier change was missed
    }
    const bool is_found = told.contains(change.joint.id) && !wrong.contains(change.joint.id);
    const Showing showing = showingOf(shown, change);
    if (showing.images < kShowing) {
      ++tally.hardly_shown;
      tally.hardly_shown_found += is_found ? 1 : 0;
      hardly += "     hardly shown: " + change.joint.id + ", at best " + base::toFixedText(100.0 * showing.best, 1) + " %" +
                (is_found ? ", found\n" : "\n");
      continue;
    }
    ++tally.expected;
    tally.found += is_found ? 1 : 0;
    missed += is_found ? 0 : 1;
    if (!is_found) {
      hardly += "     missed: " + change.joint.id + ", shown by " + std::to_string(showing.images) + " images, at best " +
                base::toFixedText(100.0 * showing.best, 1) + " %\n";
    }
    if (is_found && change.at_s > 0.0) {
      tally.moments.push_back(momentOf(recording["events"], change, shown));
      hardly += "     " + textOf(tally.moments.back()) + "\n";
    }
  }
  tally.events += static_cast<int>(recording["events"].size());
  tally.false_events += false_here;
  tally.clean += missed == 0 && false_here == 0 ? 1 : 0;
  ++tally.recordings;
  std::printf("%zu changes, %zu events, %d missed, %d false, %zu joints of the home wrong\n%s", changes.size(), recording["events"].size(),
              missed, false_here, wrong.size(), hardly.c_str());
  for (const auto& [id, state] : wrong) {
    if (told.contains(id)) {
      std::printf("     wrong: %s\n", state.dump().c_str());
    }
  }
  std::fflush(stdout);
}

}  // namespace oikos::bench
