// SPDX-License-Identifier: Apache-2.0
// The scenario of METHODS S105: short drives through the demo apartment between which doors and drawers are moved, some while they are
// being looked at. After each, what `oikos track` wrote into the home is held against the truth. Drives are simulated, mapped and tracked
// by the program as it is.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/mapping/child_process.h"
#include "core/base/config.h"
#include "core/base/number_text.h"
#include "core/metrics/share_interval.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate/scene_script.h"

namespace {

using namespace oikos;
namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Options {
  fs::path oikos = OIKOS_BUILT_BINARY;
  int recordings = 12;
  double belief_mm = 5.0;
  unsigned seed = 1;
  int threads = 2;
  fs::path keep;
};

/// A joint that is in plain view on a route.
struct Joint {
  std::string id;
  double upper;  ///< degrees or m
  bool turns;
  double seen_s = 0.0;  ///< it is looked at before and after this time of the drive; 0: it is in view too shortly to be moved meanwhile
};

struct Route {
  std::string name;
  std::vector<double> start;
  std::vector<std::string> waypoints;
  std::vector<Joint> joints;
};

const std::vector<Route>& routes() {
  static const std::vector<Route> all = {
      {"kitchen",
       {1.1, 1.6, 75.0},
       {"1.0 2.3 look -45", "1.4 2.3 yaw 178"},
       {{"fridge-door-joint", 110.0, true, 4.0},
        {"fridge-freezer_door-joint", 110.0, true, 4.0},
        {"cupboard-door-joint", 110.0, true, 4.0},
        {"drawers-drawer_0-joint", 0.43, false, 3.5},
        {"drawers-drawer_1-joint", 0.43, false, 3.5},
        {"oven-door-joint", 90.0, true, 3.5},
        {"dishwasher-door-joint", 90.0, true, 3.5},
        {"crockery-left_door-joint", 110.0, true},
        {"crockery-right_door-joint", 110.0, true}}},
      {"living room",
       {2.1, -1.9, -90.0},
       {"2.2 -2.7 look 40", "1.9 -2.6 yaw -165"},
       {{"chest-drawer_0-joint", 0.33, false, 3.5},
        {"chest-drawer_1-joint", 0.33, false, 3.5},
        {"chest-drawer_2-joint", 0.33, false, 3.5},
        {"sideboard-left_door-joint", 110.0, true},
        {"sideboard-right_door-joint", 110.0, true}}},
      {"bedroom",
       {7.0, 0.1, 0.0},
       {"7.6 -0.2 look 50", "7.4 -0.4 yaw -100"},
       {{"wardrobe-left_door-joint", 110.0, true, 3.0},
        {"wardrobe-right_door-joint", 110.0, true, 3.0},
        {"linen-chest-drawer_0-joint", 0.33, false},
        {"linen-chest-drawer_1-joint", 0.33, false}}},
      {"hall and bathroom",
       {2.0, -0.2, 35.0},
       {"3.9 0.1", "4.7 0.4", "4.7 1.4 look -60"},
       {{"shoe-cabinet-left_door-joint", 110.0, true, 1.5},
        {"shoe-cabinet-right_door-joint", 110.0, true, 1.5},
        {"washstand-left_door-joint", 110.0, true, 7.0},
        {"washstand-right_door-joint", 110.0, true, 7.0}}},
  };
  return all;
}

/// Where a joint stands in truth, in the unit of files.
struct Stand {
  double value = 0.0;
  bool turns = true;
};
using States = std::map<std::string, Stand>;

struct Change {
  Joint joint;
  double value;
  double at_s;  ///< below 0: before the drive
};

std::string textOf(const std::string& id, double value, bool turns) {
  return id + " " + base::toFixedText(value, turns ? 1 : 3) + (turns ? " deg" : " m");
}

/// Two joints or three are moved by a fifth of their range or more, one of them while it is in view in every other recording.
std::vector<Change> drawChanges(const Route& route, const States& states, int recording, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Joint> joints = route.joints;
  std::shuffle(joints.begin(), joints.end(), random);
  joints.resize(std::min<std::size_t>(joints.size(), 2 + random() % 2));
  std::vector<Change> changes;
  for (const Joint& joint : joints) {
    const double before = states.contains(joint.id) ? states.at(joint.id).value : 0.0;
    const bool closes = before > 0.0 && share(random) < 0.6;
    double value = 0.0;
    while (!closes && std::abs(value - before) < 0.2 * joint.upper) {
      value = (0.25 + 0.7 * share(random)) * joint.upper;
    }
    changes.push_back({joint, value, -1.0});
  }
  if (recording % 2 == 1 && changes.front().joint.seen_s > 0.0) {
    changes.front().at_s = changes.front().joint.seen_s + 0.4 * (share(random) - 0.5);
  }
  return changes;
}

class Scenario {
 public:
  Scenario(const Options& options, fs::path folder) : options_(options), folder_(std::move(folder)), random_(options.seed) {
    fs::create_directories(home() / "scenes");
    fs::copy_file(fs::path(OIKOS_DEMO_HOME) / "home.xml", home() / "home.xml", fs::copy_options::overwrite_existing);
    for (const char* file : {"history.sqlite", "history.sqlite-wal", "history.sqlite-shm"}) {
      fs::remove(home() / file);
    }
    for (const char* door : {"kitchen", "bathroom", "living", "bedroom"}) {
      states_[std::string(door) + "-door-door-joint"] = {95.0, true};
    }
  }

  /// Unless a kept folder has the map already.
  void deploy() {
    if (fs::exists(home() / "map")) {
      return;
    }
    auto script = base::loadConfig<simulate::SceneScript>({fs::path(OIKOS_DEMO_HOME) / "scenes" / "drive.toml", {}});
    believe(script);
    simulate("deployment", script);
    const bench::ChildRun run = must({"map", drive("deployment"), "--out", home().string(), "--quiet"});
    std::printf("deployment mapped in %.0f s\n", run.wall_s);
  }

  void run(int number) {
    const Route& route = routes()[static_cast<std::size_t>(number) % routes().size()];
    const std::vector<Change> changes = drawChanges(route, states_, number, random_);
    simulate::SceneScript script;
    const std::string hour = std::to_string(10 + number);
    script.start = "2026-03-03T" + hour + ":00:00Z";
    script.path.start = route.start;
    script.path.waypoints = route.waypoints;
    script.path.speed_mps = 0.6;
    script.path.turn_rate_dps = 50.0;
    script.path.stand_s = 0.4;
    script.duration_s = 9.9;  // a hundred frames
    for (const auto& [id, stand] : states_) {
      script.changes.push_back(textOf(id, stand.value, stand.turns));
    }
    for (const Change& change : changes) {
      states_[change.joint.id] = {change.value, change.joint.turns};
      const std::string text = textOf(change.joint.id, change.value, change.joint.turns);
      script.changes.push_back(change.at_s > 0.0 ? "@" + base::toFixedText(change.at_s, 1) + " " + text : text);
    }
    believe(script);
    const std::string name = "drive-" + std::to_string(number);
    simulate(name, script);
    const Json before = evaluated(name);
    const bench::ChildRun tracked = must({"track", home().string(), drive(name), "--json", "--quiet"});
    judge(number, route, changes, before, Json::parse(tracked.out), evaluated(name));
    cpu_s_ += tracked.cpu_s;
    peak_mb_ = std::max(peak_mb_, tracked.peak_mb);
    if (options_.keep.empty()) {
      fs::remove_all(drive(name));
    }
  }

  void report() const {
    const auto rate = [](int hits, int count) {
      const metrics::ShareInterval interval = metrics::wilsonInterval(hits, count);
      return base::toFixedText(100.0 * hits / std::max(1, count), 1) + " % (95 %: " + base::toFixedText(100.0 * interval.low, 1) + "-" +
             base::toFixedText(100.0 * interval.high, 1) + ")";
    };
    std::printf("state events: found %d of %d, %s; false %d of %d, %s\n", found_, expected_, rate(found_, expected_).c_str(), false_,
                events_, rate(false_, events_).c_str());
    std::printf("moments of joints that moved in view: worst off by %.1f s of %zu\n",
                moments_s_.empty() ? 0.0 : *std::max_element(moments_s_.begin(), moments_s_.end()), moments_s_.size());
    std::printf("recordings after which every joint that was read is right: %d of %d\n", clean_, recordings_);
    std::printf("%d frames, %.1f frames/s in reading (best recording %.1f), %.1f CPU ms a frame with opening; peak %.0f MB\n", frames_,
                frames_ / seconds_, best_rate_, 1000.0 * cpu_s_ / std::max(1, frames_), peak_mb_);
  }

 private:
  [[nodiscard]] fs::path home() const { return folder_ / "home"; }
  [[nodiscard]] std::string drive(const std::string& name) const { return (folder_ / name).string(); }

  bench::ChildRun must(std::vector<std::string> words) const {
    words.insert(words.begin(), options_.oikos.string());
    words.insert(words.end(), {"--threads", std::to_string(options_.threads)});
    bench::ChildRun run = bench::runChild(words, folder_ / "out");
    if (run.exit_code != 0) {
      throw std::runtime_error(words[1] + " " + words[2] + " ended with " + std::to_string(run.exit_code));
    }
    return run;
  }

  void believe(simulate::SceneScript& script) const {
    script.belief.dimension_m = options_.belief_mm / 1000.0;
    script.belief.placement_m = options_.belief_mm / 1000.0;
    script.belief.placement_deg = 0.06 * options_.belief_mm;
    script.belief.axis_m = 0.6 * options_.belief_mm / 1000.0;
    script.belief.axis_deg = 0.1 * options_.belief_mm;
  }

  void simulate(const std::string& name, const simulate::SceneScript& script) const {
    const fs::path file = home() / "scenes" / (name + ".toml");
    std::ofstream(file) << base::writeConfig(script);
    fs::remove_all(drive(name));
    must({"simulate", file.string(), "--out", drive(name), "--quiet", "--seed", std::to_string(options_.seed)});
  }

  [[nodiscard]] Json evaluated(const std::string& name) const {
    return Json::parse(must({"evaluate", "states", home().string(), drive(name), "--json"}).out)["states"];
  }

  static std::map<std::string, Json> wrongJoints(const Json& states) {
    std::map<std::string, Json> wrong;
    for (const Json& state : states) {
      if (!state["right"].get<bool>() && !state.contains("believed")) {
        wrong[state["id"]] = state;
      }
    }
    return wrong;
  }

  void judge(int number, const Route& route, const std::vector<Change>& changes, const Json& before, const Json& answer,
             const Json& after) {
    const std::map<std::string, Json> pending = wrongJoints(before);  // by the end of the drive
    const std::map<std::string, Json> wrong = wrongJoints(after);
    const Json& recording = answer["recordings"][0];
    std::set<std::string> told;
    int false_here = 0;
    for (const Json& event : recording["events"]) {
      const std::string id = event["subject"];
      told.insert(id);
      ++events_;
      false_here += !pending.contains(id) || wrong.contains(id) ? 1 : 0;
    }
    false_ += false_here;
    int missed = 0;
    for (const Change& change : changes) {
      if (!pending.contains(change.joint.id)) {
        continue;  // it is back where the home has it: an earlier change was missed
      }
      ++expected_;
      const bool is_found = told.contains(change.joint.id) && !wrong.contains(change.joint.id);
      found_ += is_found ? 1 : 0;
      missed += is_found ? 0 : 1;
      if (is_found && change.at_s > 0.0) {
        moments_s_.push_back(momentError_s(recording["events"], change));
      }
    }
    const bool is_clean = missed == 0 && false_here == 0;
    clean_ += is_clean ? 1 : 0;
    ++recordings_;
    frames_ += recording["frames"].get<int>();
    seconds_ += recording["locating_s"].get<double>() + recording["reading_s"].get<double>();
    best_rate_ = std::max(best_rate_, recording["frames_per_s"].get<double>());
    std::printf(
        "%2d %-17s %d of %d frames found, %d registrations, %zu changes, %zu events, %d missed, %d false, %zu joints of the home wrong\n",
        number + 1, route.name.c_str(), recording["found"].get<int>(), recording["looked_for"].get<int>(),
        recording["registrations"].get<int>(), changes.size(), recording["events"].size(), missed, false_here, wrong.size());
    for (const auto& [id, state] : wrong) {
      std::printf("     wrong: %s\n", state.dump().c_str());
    }
    std::fflush(stdout);
  }

  /// The event's time against the change's; frames are a tenth of a second apart.
  static double momentError_s(const Json& events, const Change& change) {
    double error_s = 0.0;
    for (const Json& event : events) {
      if (event["subject"] == change.joint.id) {
        error_s = std::abs(event["frame"].get<double>() / 10.0 - change.at_s);
      }
    }
    return error_s;
  }

  const Options& options_;
  fs::path folder_;
  std::mt19937_64 random_;
  States states_;
  int expected_ = 0;
  int found_ = 0;
  int events_ = 0;
  int false_ = 0;
  int clean_ = 0;
  int recordings_ = 0;
  int frames_ = 0;
  double seconds_ = 0.0;
  double best_rate_ = 0.0;
  double cpu_s_ = 0.0;
  double peak_mb_ = 0.0;
  std::vector<double> moments_s_;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("What oikos track makes of short drives between which doors and drawers are moved", "track_bench");
  app.add_option("--oikos", options.oikos, "the program to run")->check(CLI::ExistingFile);
  app.add_option("--recordings", options.recordings, "drives; four routes take turns")->check(CLI::Range(1, 13));
  app.add_option("--belief-mm", options.belief_mm, "standard deviation of believed dimensions and places");
  app.add_option("--threads", options.threads);
  app.add_option("--seed", options.seed);
  app.add_option("--keep", options.keep, "a folder to work in, which stays; a map that is in it is used again");
  CLI11_PARSE(app, argc, argv);
  try {
    const test::TemporaryFolder folder;
    Scenario scenario(options, options.keep.empty() ? folder.path() : options.keep);
    scenario.deploy();
    for (int recording = 0; recording < options.recordings; ++recording) {
      scenario.run(recording);
    }
    scenario.report();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "track_bench: %s\n", error.what());
    return 1;
  }
}
