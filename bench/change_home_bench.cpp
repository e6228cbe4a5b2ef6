// SPDX-License-Identifier: Apache-2.0
// What `oikos map --extend` tells about a second drive through a simulated living room whose furniture the home believes to 5 mm: desk and
// sofa are shifted, a chair is moved, a door is opened; every other pair of drives is of an unchanged room. Pairs are simulated, mapped and
// extended by the program as it is.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/mapping/child_process.h"
#include "core/base/config.h"
#include "core/base/number_text.h"
#include "semantic/history/home_state.h"
#include "semantic/xml/home_writer.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate/scene_script.h"

namespace {

using namespace oikos;
namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Options {
  fs::path oikos = OIKOS_BUILT_BINARY;
  int pairs = 4;
  std::vector<int> only;  ///< numbers of pairs; none: all of `pairs`
  fs::path keep;          ///< where recordings and maps stay, and are taken from; none: they are deleted
  double belief_mm = 5.0;
  unsigned seed = 1;
};

/// A piece and where it is put, as a scene's change says it.
struct Move {
  std::string id;
  double x_m;
  double y_m;
  double yaw_deg;

  [[nodiscard]] std::string text() const {
    const auto number = [](double value) { return base::toFixedText(value, 4); };
    return id + " at " + number(x_m) + " " + number(y_m) + " 0 0 0 " + number(yaw_deg);
  }
};

const std::vector<double> kStart = {1.6, -2.2, 0.0};

/// The demo home's living room with its door, as a home of its own: a drive through one room does not show the whole apartment.
void writeLivingRoom(const fs::path& folder) {
  semantic::Home home = semantic::loadHome(OIKOS_DEMO_HOME);
  const auto getRoom = [&](const char* id) -> const semantic::Room& {
    return *std::find_if(home.rooms.begin(), home.rooms.end(), [&](const semantic::Room& room) { return room.id.value == id; });
  };
  const std::vector<semantic::LargeObject> hall(getRoom("hall").objects.begin(), getRoom("hall").objects.end());
  const semantic::LargeObject door =
      *std::find_if(hall.begin(), hall.end(), [](const semantic::LargeObject& object) { return object.id.value == "living-door"; });
  const semantic::Room living_room = getRoom("living_room");
  home.rooms = {living_room};
  home.rooms.front().objects.push_back(door);
  home.T_map_dock.position_m = {kStart[0], kStart[1], 0.0};
  fs::create_directories(folder / "scenes");
  std::ofstream(folder / "home.xml") << semantic::toXml(home);
}

fs::path writeScene(const fs::path& home, const std::string& name, const std::vector<std::string>& changes, double belief_m) {
  simulate::SceneScript script;
  script.rate_hz = 8.0;
  script.changes = changes;
  script.path.start = kStart;
  script.path.waypoints = {"2.7 -2.2 look 45", "2.6 -3.0 look 50", "1.7 -2.5 yaw 0"};
  script.path.speed_mps = 0.5;
  script.path.turn_rate_dps = 50.0;
  script.path.stand_s = 0.3;
  script.belief.dimension_m = belief_m;
  script.belief.placement_m = belief_m;
  script.belief.placement_deg = 60.0 * belief_m;
  const fs::path file = home / "scenes" / (name + ".toml");
  std::ofstream(file) << base::writeConfig(script);
  return file;
}

bench::ChildRun mustRun(const std::vector<std::string>& words, const fs::path& out) {
  bench::ChildRun run = bench::runChild(words, out);
  if (run.exit_code != 0) {
    throw std::runtime_error(words[1] + " " + words[2] + " ended with " + std::to_string(run.exit_code));
  }
  return run;
}

struct Score {
  int moved = 0;  ///< shiftable pieces that were
  int found = 0;  ///< to 3 cm and 2 degrees
  std::vector<double> error_m;
  std::vector<double> error_deg;
  int false_moves = 0;  ///< pieces said to have moved that have not
  int chairs = 0;
  int chairs_gone = 0;
  int chairs_new = 0;
  int boxes = 0;
  int boxes_of_nothing = 0;  ///< of no piece, and not where one was put
  int unchanged_pairs = 0;
  int false_boxes = 0;  ///< in them
};

bool holds(const Json& change, double x_m, double y_m, double margin_m) {
  return std::abs(change["center_map_m"][0].get<double>() - x_m) <= 0.5 * change["size_m"][0].get<double>() + margin_m &&
         std::abs(change["center_map_m"][1].get<double>() - y_m) <= 0.5 * change["size_m"][1].get<double>() + margin_m;
}

double turned_deg(double a_deg, double b_deg) {
  return std::abs(std::remainder(a_deg - b_deg, 360.0));
}

void judgeMoved(const Json& answer, const std::vector<Move>& shifted, Score& score) {
  for (const Json& piece : answer["moved_furniture"]) {
    const auto truth = std::find_if(shifted.begin(), shifted.end(), [&](const Move& move) { return move.id == piece["id"]; });
    if (truth == shifted.end()) {
      ++score.false_moves;
      std::printf("  false move: %s\n", piece["id"].get<std::string>().c_str());
      continue;
    }
    score.error_m.push_back(std::hypot(piece["x_m"].get<double>() - truth->x_m, piece["y_m"].get<double>() - truth->y_m));
    score.error_deg.push_back(turned_deg(piece["yaw_deg"].get<double>(), truth->yaw_deg));
    score.found += score.error_m.back() <= 0.03 && score.error_deg.back() <= 2.0 ? 1 : 0;
    std::printf("  %s: off by %.1f mm, %.2f deg\n", truth->id.c_str(), 1000.0 * score.error_m.back(), score.error_deg.back());
  }
  score.moved += static_cast<int>(shifted.size());
}

void judgeBoxes(const Json& changes, const std::vector<Move>& shifted, const Move& chair, Score& score) {
  bool is_gone = false;
  bool is_new = false;
  for (const Json& change : changes) {
    ++score.boxes;
    const bool is_new_kind = change["kind"] == "new";
    is_gone = is_gone || (!is_new_kind && holds(change, 4.2, -1.72, 0.1));
    const bool at_chair = is_new_kind && holds(change, chair.x_m, chair.y_m, 0.3);
    is_new = is_new || at_chair;
    const bool at_shifted = is_new_kind && std::any_of(shifted.begin(), shifted.end(), [&](const Move& move) {
                              return holds(change, move.x_m, move.y_m, 1.1);  // the sofa's half length
                            });
    score.boxes_of_nothing += change["piece"] == "" && !at_chair && !at_shifted ? 1 : 0;
  }
  ++score.chairs;
  score.chairs_gone += is_gone ? 1 : 0;
  score.chairs_new += is_new ? 1 : 0;
}

/// Simulates both drives and maps the first, where that was not kept; what the second one says goes to a copy.
Json extendByPair(const fs::path& pair, const std::vector<std::string>& changes, unsigned seed, const Options& options) {
  const fs::path home = pair / "home";
  const std::string oikos = options.oikos.string();
  const std::string first = (pair / "first").string();
  const std::string second = (pair / "second").string();
  if (!fs::exists(home / "map")) {
    writeLivingRoom(home);
    const auto simulate = [&](const fs::path& scene, const std::string& recording) {
      fs::remove_all(recording);
      mustRun({oikos, "simulate", scene.string(), "--out", recording, "--quiet", "--seed", std::to_string(seed)}, pair / "out");
    };
    simulate(writeScene(home, "first", {}, options.belief_mm / 1000.0), first);
    simulate(writeScene(home, "second", changes, options.belief_mm / 1000.0), second);
    mustRun({oikos, "map", first, "--out", home.string(), "--quiet"}, pair / "out");
  }
  const fs::path extended = pair / "extended";
  fs::remove_all(extended);
  fs::copy(home, extended, fs::copy_options::recursive);
  return Json::parse(mustRun({oikos, "map", second, "--out", extended.string(), "--extend", "--quiet", "--json"}, pair / "out").out);
}

void runPair(int number, const Options& options, const fs::path& folder, Score& score) {
  std::mt19937_64 random(options.seed * 1'000'003 + static_cast<std::uint64_t>(number));
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const std::vector<Move> shifted = {
      {"desk", 4.2 - 0.1 - 0.2 * share(random), -1.18 - 0.1 - 0.15 * share(random), -90.0 + 12.0 * share(random)},
      {"sofa", 4.72 - 0.1 - 0.15 * share(random), -3.2 + 0.3 * (share(random) - 0.5), 180.0 - 8.0 * share(random)}};
  const Move chair{"desk-chair", 3.0 + 0.2 * share(random), -1.5 + 0.1 * share(random), 360.0 * share(random)};
  const bool is_changed = number % 2 == 0;
  std::vector<std::string> changes;
  if (is_changed) {
    for (const Move& move : shifted) {
      changes.push_back(move.text());
    }
    changes.push_back(chair.text());
    changes.push_back("living-door-door-joint " + base::toFixedText(60.0 + 30.0 * share(random), 1) + " deg");
  }
  const fs::path pair = folder / ("pair" + std::to_string(number));
  const Json answer = extendByPair(pair, changes, options.seed * 1000 + static_cast<unsigned>(number), options);
  std::printf("pair %d, %s: %d keyframes and %d more, %zu boxes\n", number, is_changed ? "changed" : "unchanged",
              answer["earlier_keyframes"].get<int>(), answer["keyframes"].get<int>() - answer["earlier_keyframes"].get<int>(),
              answer["changes"].size());
  judgeMoved(answer, is_changed ? shifted : std::vector<Move>(), score);
  if (is_changed) {
    judgeBoxes(answer["changes"], shifted, chair, score);
  } else {
    ++score.unchanged_pairs;
    score.false_boxes += static_cast<int>(answer["changes"].size());
    for (const Json& change : answer["changes"]) {
      std::printf("  false box: %s\n", change.dump().c_str());
    }
  }
  std::fflush(stdout);
  if (options.keep.empty()) {
    fs::remove_all(pair);
  }
}

void report(const Score& score) {
  const auto worst = [](const std::vector<double>& values) {
    return values.empty() ? std::nan("") : *std::max_element(values.begin(), values.end());
  };
  std::printf("moved pieces found to 3 cm and 2 deg: %d of %d; worst off by %.1f mm, %.2f deg; said to have moved and have not: %d\n",
              score.found, score.moved, 1000.0 * worst(score.error_m), worst(score.error_deg), score.false_moves);
  std::printf("moved chair: gone %d, new %d of %d; boxes of no piece and no place of one: %d of %d\n", score.chairs_gone, score.chairs_new,
              score.chairs, score.boxes_of_nothing, score.boxes);
  std::printf("unchanged pairs: %d, boxes in them: %d\n", score.unchanged_pairs, score.false_boxes);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Changes that oikos map --extend tells, in simulated pairs of drives", "change_home_bench");
  app.add_option("--oikos", options.oikos, "the program to run")->check(CLI::ExistingFile);
  app.add_option("--pairs", options.pairs, "every other one of an unchanged room");
  app.add_option("--only", options.only, "numbers of pairs, instead of the first --pairs")->delimiter(',');
  app.add_option("--keep", options.keep, "a folder in which recordings and maps stay, and from which they are taken");
  app.add_option("--belief-mm", options.belief_mm, "standard deviation of believed dimensions and places");
  app.add_option("--seed", options.seed);
  CLI11_PARSE(app, argc, argv);
  try {
    const test::TemporaryFolder folder;
    Score score;
    if (options.only.empty()) {
      options.only.resize(static_cast<std::size_t>(std::max(0, options.pairs)));
      std::iota(options.only.begin(), options.only.end(), 0);
    }
    for (const int pair : options.only) {
      runPair(pair, options, options.keep.empty() ? folder.path() : options.keep, score);
    }
    report(score);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "change_home_bench: %s\n", error.what());
    return 1;
  }
}
