// SPDX-License-Identifier: Apache-2.0
// `oikos evaluate states`: what a home believes of its doors, drawers and knobs against a simulated recording's truth.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/read_file.h"
#include "core/metrics/share_interval.h"
#include "semantic/history/history.h"
#include "semantic/history/home_state.h"
#include "tools/command.h"
#include "tools/evaluate_answers.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct StatesOptions {
  fs::path home;
  fs::path truth;
  double within_deg = 5.0;
  double within_m = 0.02;
  double confident = 0.9;
};

/// A state at the truth's end.
struct TrueState {
  std::string value;  ///< a number, or a knob's state
  std::string unit;   ///< deg, m, state
};

/// A recording's folder, its folder `truth`, or the file itself.
fs::path fileOf(const fs::path& truth) {
  for (const fs::path& file : {truth / "truth" / "states.csv", truth / "states.csv"}) {
    if (fs::is_directory(truth) && fs::exists(file)) {
      return file;
    }
  }
  if (fs::is_directory(truth)) {
    throw base::Error(base::ErrorCode::kInput, "no truth/states.csv or states.csv in it, as oikos simulate writes it", truth.string());
  }
  return truth;
}

std::map<std::string, TrueState> readTruth(const fs::path& file) {
  std::istringstream lines(base::readFile(file));
  std::map<std::string, TrueState> states;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto refuse = [&](const std::string& what) {
      throw base::Error(base::ErrorCode::kInput, what, file.string() + ":" + std::to_string(number));
    };
    if (number == 1) {
      if (line != "t,id,value,unit") {
        refuse("'" + line + "', expected t,id,value,unit");
      }
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) {
      cells.push_back(cell);
    }
    if (cells.size() != 4 || !base::findNumber(cells[0])) {
      refuse("'" + line + "', expected a line such as 0,fridge-door-joint,70,deg");
    }
    const bool is_number = cells[3] == "deg" || cells[3] == "m";
    if ((!is_number && cells[3] != "state") || (is_number && !base::findNumber(cells[2]))) {
      refuse("value '" + cells[2] + "' in '" + cells[3] + "', expected a number in deg or m, or a name in state");
    }
    states[cells[1]] = {cells[2], cells[3]};
  }
  return states;
}

/// One state of the home beside the true one.
struct Compared {
  std::string id;
  bool is_knob = false;
  bool turns = false;
  double believed = 0.0;  ///< rad or m
  double truth = 0.0;
  std::string believed_setting;
  std::string true_setting;
  bool is_right = false;
  std::optional<double> confidence;  ///< of the event that it rests on; nothing: it was never observed

  [[nodiscard]] double error() const { return std::abs(believed - truth); }
};

std::optional<Compared> compare(const std::string& id, const TrueState& truth, const semantic::State& believed,
                                const StatesOptions& options) {
  Compared one;
  one.id = id;
  if (const auto* const joint = std::get_if<semantic::JointValue>(&believed); joint != nullptr && truth.unit != "state") {
    one.turns = joint->type == semantic::JointType::kRevolute;
    if (one.turns != (truth.unit == "deg")) {
      return std::nullopt;
    }
    one.believed = joint->value;
    one.truth = *base::findNumber(truth.value) * (one.turns ? base::kRadPerDeg : 1.0);
    one.is_right = one.error() <= (one.turns ? options.within_deg * base::kRadPerDeg : options.within_m);
    return one;
  }
  if (const auto* const knob = std::get_if<semantic::KnobSetting>(&believed); knob != nullptr && truth.unit == "state") {
    one.is_knob = true;
    one.believed_setting = knob->state;
    one.true_setting = truth.value;
    one.is_right = one.believed_setting == one.true_setting;
    return one;
  }
  return std::nullopt;
}

struct Comparison {
  std::vector<Compared> states;
  std::vector<std::string> unknown;  ///< of the truth, that the home does not have, or has as something else
};

Comparison compareAll(const StatesOptions& options) {
  const std::map<std::string, TrueState> truth = readTruth(fileOf(options.truth));
  const semantic::HomeState home(semantic::loadHome(options.home));
  const semantic::History history(options.home / "history.sqlite", semantic::HistoryAccess::kRead);
  Comparison comparison;
  for (const auto& [id, state] : truth) {
    const auto believed = home.findState(id);
    std::optional<Compared> one = believed ? compare(id, state, *believed, options) : std::nullopt;
    if (!one) {
      comparison.unknown.push_back(id);
      continue;
    }
    if (const auto event = history.findStateAt(id, std::numeric_limits<std::int64_t>::max())) {
      one->confidence = event->confidence;
    }
    comparison.states.push_back(*std::move(one));
  }
  return comparison;
}

/// Of joints or of knobs.
struct Tally {
  int count = 0;
  int right = 0;
  int confident_wrong = 0;  ///< wrong, and resting on an event that was sure
  int stale = 0;            ///< wrong, and never observed
  std::vector<double> errors_rad;
  std::vector<double> errors_m;

  void add(const Compared& one, double confident) {
    ++count;
    right += one.is_right ? 1 : 0;
    confident_wrong += !one.is_right && one.confidence && *one.confidence >= confident ? 1 : 0;
    stale += !one.is_right && !one.confidence ? 1 : 0;
    if (!one.is_knob) {
      (one.turns ? errors_rad : errors_m).push_back(one.error());
    }
  }
};

Json tallyJson(const Tally& tally) {
  Json json = {{"states", tally.count}, {"right", tally.right}};
  if (tally.count > 0) {
    const metrics::ShareInterval interval = metrics::wilsonInterval(tally.right, tally.count);
    json["right_share"] = static_cast<double>(tally.right) / tally.count;
    json["interval_95"] = {interval.low, interval.high};
  }
  json["confident_wrong"] = tally.confident_wrong;
  json["wrong_never_observed"] = tally.stale;
  if (!tally.errors_rad.empty()) {
    json["hinges"] = statisticsJson(metrics::statisticsOf(tally.errors_rad), degrees(1.0), "deg");
  }
  if (!tally.errors_m.empty()) {
    json["slides"] = statisticsJson(metrics::statisticsOf(tally.errors_m), 1.0, "m");
  }
  return json;
}

Json stateJson(const Compared& one) {
  Json json = {{"id", one.id}, {"right", one.is_right}};
  if (one.is_knob) {
    json["believed"] = one.believed_setting;
    json["true"] = one.true_setting;
  } else {
    const std::string unit = one.turns ? "deg" : "m";
    const double factor = one.turns ? degrees(1.0) : 1.0;
    json["believed_" + unit] = factor * one.believed;
    json["true_" + unit] = factor * one.truth;
    json["error_" + unit] = factor * one.error();
  }
  json["confidence"] = one.confidence ? Json(*one.confidence) : Json(nullptr);
  return json;
}

std::string valueText(const Compared& one, double value) {
  return one.turns ? base::toFixedText(degrees(value), 1) + " deg" : base::toFixedText(100.0 * value, 1) + " cm";
}

void printTally(const std::string& name, const Tally& tally) {
  if (tally.count == 0) {
    return;
  }
  const metrics::ShareInterval interval = metrics::wilsonInterval(tally.right, tally.count);
  std::cout << name << tally.right << " of " << tally.count << " right, " << base::toFixedText(100.0 * tally.right / tally.count, 1)
            << " % (95 %: " << base::toFixedText(100.0 * interval.low, 1) << "-" << base::toFixedText(100.0 * interval.high, 1) << "); "
            << tally.confident_wrong << " wrong and sure, " << tally.stale << " wrong and never observed\n";
  if (!tally.errors_rad.empty()) {
    std::cout << "  hinges  " << row(metrics::statisticsOf(tally.errors_rad), degrees(1.0), "deg") << '\n';
  }
  if (!tally.errors_m.empty()) {
    std::cout << "  slides  " << row(metrics::statisticsOf(tally.errors_m), 100.0, "cm") << '\n';
  }
}

ExitCode evaluateStates(const StatesOptions& options, const Session& session) {
  const Comparison comparison = compareAll(options);
  Tally joints;
  Tally knobs;
  for (const Compared& one : comparison.states) {
    (one.is_knob ? knobs : joints).add(one, options.confident);
  }
  if (session.options.json) {
    Json states = Json::array();
    for (const Compared& one : comparison.states) {
      states.push_back(stateJson(one));
    }
    std::cout
        << Json{{"joints", tallyJson(joints)}, {"knobs", tallyJson(knobs)}, {"not_in_home", comparison.unknown}, {"states", states}}.dump(2)
        << '\n';
  } else {
    printTally("joints  ", joints);
    printTally("knobs   ", knobs);
    for (const Compared& one : comparison.states) {
      if (!one.is_right) {
        std::cout << "  " << one.id << ": believed " << (one.is_knob ? one.believed_setting : valueText(one, one.believed)) << ", true "
                  << (one.is_knob ? one.true_setting : valueText(one, one.truth))
                  << (one.confidence ? ", sure to " + base::toFixedText(100.0 * *one.confidence, 1) + " %" : ", never observed") << '\n';
      }
    }
  }
  if (comparison.states.empty()) {
    std::cerr << "oikos: nothing in " << options.truth.string() << " is a joint or knob of this home\n";
    return ExitCode::kNoAnswer;
  }
  return ExitCode::kDone;
}

}  // namespace

void addStateEvaluation(CLI::App& evaluate) {
  CLI::App& command = addCommand(evaluate, {"states", "Compares what a home believes of doors, drawers and knobs with the truth.",
                                            "  oikos evaluate states ~/homes/flat-3 ~/drives/simulated\n"
                                            "  oikos evaluate states home drive/truth/states.csv --json"});
  const auto options = std::make_shared<StatesOptions>();
  command.add_option("HOME", options->home, "the home's folder")->required();
  command.add_option("TRUTH", options->truth, "a simulated recording, its folder truth, or a states.csv; its last states count")
      ->required();
  command.add_option("--within-deg", options->within_deg, "degrees; a hinge this near to the truth is right")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--within-m", options->within_m, "m; a slide this near to the truth is right")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--confident", options->confident, "an event at least this sure that is wrong counts as wrong and sure")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  setAction(command, [options](const Session& session) { return evaluateStates(*options, session); });
}

}  // namespace oikos::tools
