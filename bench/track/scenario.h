// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "bench/mapping/child_process.h"
#include "bench/track/moments.h"
#include "bench/track/routes.h"
#include "tools/simulate/scene_script.h"

namespace oikos::bench {

constexpr double kDriveRate_hz = 10.0;

struct ScenarioOptions {
  std::filesystem::path oikos;
  std::filesystem::path demo_home;
  std::filesystem::path folder;  ///< to work in; map and drives of the same options that are in it are used again
  double belief_mm = 5.0;
  unsigned seed = 1;
  int threads = 2;
  std::vector<std::string> settings = {};  ///< KEY=VALUE for `oikos track`
};

struct ScenarioTally {
  int recordings = 0;
  int clean = 0;     ///< recordings without a shown change that was missed, and without a false event
  int expected = 0;  ///< changes that at least two images show,
  int found = 0;     ///< and of these, told rightly
  int hardly_shown = 0;
  int hardly_shown_found = 0;
  int events = 0;
  int false_events = 0;
  std::vector<MovedInDrive> moments;  ///< of changes that were found
  int frames = 0;
  double seconds = 0.0;
  double best_rate = 0.0;
  double cpu_s = 0.0;
  double peak_mb = 0.0;
};

/// Of the oven's knobs.
struct KnobTally {
  int expected = 0;  ///< that stand, when the robot stands before them at the drive's end, elsewhere than the home believes,
  int found = 0;     ///< and of these, those that the home has right then
  int events = 0;
  int false_events = 0;  ///< of knobs that the home has wrong then
};

/// Drives of one home, whose joints go on from where the last drive has left them.
class Scenario {
 public:
  /// Makes the home, and, unless the folder has it already, its map.
  explicit Scenario(const ScenarioOptions& options);

  void run(int number, ScenarioTally& tally);
  /// A drive up to the oven, from somewhere else each time, some of its knobs being turned.
  void runOven(int number, KnobTally& tally);

 private:
  [[nodiscard]] std::filesystem::path home() const { return options_.folder / "home"; }
  /// What drives are simulated of: the home as it was believed at the deployment, whatever is told of it later.
  [[nodiscard]] std::filesystem::path deployed() const { return options_.folder / "deployed"; }
  [[nodiscard]] std::filesystem::path drive(const std::string& name) const { return options_.folder / name; }
  ChildRun must(std::vector<std::string> words) const;
  void deploy() const;
  void believe(simulate::SceneScript& script) const;
  void simulate(const std::string& name, const simulate::SceneScript& script) const;
  [[nodiscard]] simulate::SceneScript scriptOf(int number, const Route& route, const std::vector<StateChange>& changes);
  [[nodiscard]] Route drawOvenRoute();
  [[nodiscard]] nlohmann::json evaluated(const std::string& name) const;
  void judge(int number, const std::vector<StateChange>& changes, const nlohmann::json& before, const nlohmann::json& recording,
             ScenarioTally& tally) const;

  ScenarioOptions options_;
  std::mt19937_64 random_;
  std::vector<Route> routes_;
  States states_;
  std::map<std::string, std::string> settings_;  ///< of knobs
};

}  // namespace oikos::bench
