// SPDX-License-Identifier: Apache-2.0
// Drives up to the oven whose knobs are turned, before them and meanwhile.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

#include "bench/track/scenario.h"
#include "core/base/number_text.h"

namespace oikos::bench {

namespace {

using Json = nlohmann::json;

constexpr int kKnobs = 5;
const Eigen::Vector2d kOvenFront(1.55, 4.0);  // of homes/demo, facing -y

std::string textOf(const char* format, double a, double b, double c) {
  char text[64];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

/// Knobs of the home that are not as they are at the drive's end.
std::set<std::string> wrongKnobs(const Json& states) {
  std::set<std::string> wrong;
  for (const Json& state : states) {
    if (!state["right"].get<bool>() && state.contains("believed")) {
      wrong.insert(state["id"].get<std::string>());
    }
  }
  return wrong;
}

}  // namespace

Route Scenario::drawOvenRoute() {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double x = 1.2 + 0.6 * unit(random_);
  const double y = 2.75 + 0.35 * unit(random_);
  const double yaw_deg = std::atan2(kOvenFront.y() - y, kOvenFront.x() - x) * 180.0 / std::numbers::pi;
  const auto aside = [&](double most) { return most * (2.0 * unit(random_) - 1.0); };
  Route route;
  route.name = "oven";
  route.start = {x - 0.2, y - 0.7, 90.0};
  route.waypoints = {textOf("%.3f %.3f yaw %.1f", x, y, yaw_deg + aside(8.0)),
                     textOf("%.3f %.3f yaw %.1f", x + aside(0.1), y + 0.05, yaw_deg + aside(8.0))};
  return route;
}

void Scenario::runOven(int number, KnobTally& tally) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::string name = "oven-" + std::to_string(number);
  simulate::SceneScript script = scriptOf(number, drawOvenRoute(), {});
  script.duration_s = 6.0;
  script.path.speed_mps = 0.3;
  script.path.stand_s = 0.8;
  script.part_images = false;
  for (int knob = 0; knob < kKnobs; ++knob) {
    const std::string id = "oven-knob_" + std::to_string(knob);
    if (unit(random_) < 0.4) {
      settings_[id] = std::to_string(random_() % 10);
    }
    script.changes.push_back(id + " " + (settings_.contains(id) ? settings_[id] : "0"));
  }
  const std::string turned = "oven-knob_" + std::to_string(random_() % kKnobs);
  settings_[turned] = std::to_string(random_() % 10);
  script.changes.push_back("@" + base::toFixedText(2.2 + 1.3 * unit(random_), 1) + " " + turned + " " + settings_[turned]);
  simulate(name, script);
  const std::set<std::string> pending = wrongKnobs(evaluated(name));
  const Json recording = Json::parse(must({"track", home().string(), drive(name).string(), "--json", "--quiet"}).out)["recordings"][0];
  const std::set<std::string> wrong = wrongKnobs(evaluated(name));
  int events = 0;
  for (const Json& event : recording["events"]) {
    const bool is_knob = event["kind"] == "knob";
    events += is_knob ? 1 : 0;
    tally.false_events += is_knob && wrong.contains(event["subject"].get<std::string>()) ? 1 : 0;
  }
  tally.events += events;
  tally.expected += static_cast<int>(pending.size());
  for (const std::string& id : pending) {
    tally.found += wrong.contains(id) ? 0 : 1;
  }
  std::printf("%2d oven: %zu knobs set anew, %d events, %zu knobs wrong\n", number + 1, pending.size(), events, wrong.size());
  for (const std::string& id : wrong) {
    std::printf("     wrong: %s\n", id.c_str());
  }
  std::fflush(stdout);
}

}  // namespace oikos::bench
