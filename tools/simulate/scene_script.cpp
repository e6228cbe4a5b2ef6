// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/scene_script.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/base/error.h"
#include "core/base/rfc3339.h"
#include "tools/simulate/home_change.h"

namespace oikos::simulate {

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// A rule about the text of a list's item.
void refuse(std::vector<std::string>& messages, const std::string& key, const std::string& text, const std::string& rule) {
  messages.push_back(key + " = '" + text + "': " + rule);
}

std::optional<std::vector<double>> numbersOf(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    const std::optional<double> number = base::findNumber(word);
    if (!number || !std::isfinite(*number)) {
      return std::nullopt;
    }
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

std::vector<std::string> CameraSettings::validate() const {
  base::ConfigRules rules;
  rules.between("width", width, 16, 4096).between("height", height, 16, 4096);
  rules.greater("fx", fx, 0.0).greater("fy", fy, 0.0).between("cx", cx, 0.0, width).between("cy", cy, 0.0, height);
  rules.require(distortion.size() == 5, "distortion", static_cast<double>(distortion.size()), "must be five numbers: k1, k2, p1, p2, k3");
  rules.between("height_m", height_m, 0.05, 3.0).between("tilt_deg", tilt_deg, -89.0, 89.0).between("forward_m", forward_m, -2.0, 2.0);
  rules.between("depth_delay_s", depth_delay_s, 0.0, 0.015).between("readout_s", readout_s, 0.0, 0.1);
  rules.between("lost_share", lost_share, 0.0, 0.9).between("jpeg_quality", jpeg_quality, 0, 100);
  return rules.messages();
}

std::vector<std::string> PathSettings::validate() const {
  base::ConfigRules rules;
  rules.require(start.size() == 3, "start", static_cast<double>(start.size()), "must be three numbers: x, y (m), yaw (degrees)");
  rules.greater("speed_mps", speed_mps, 0.0).greater("acceleration_mps2", acceleration_mps2, 0.0);
  rules.greater("turn_rate_dps", turn_rate_dps, 0.0).greater("turn_acceleration_dps2", turn_acceleration_dps2, 0.0);
  rules.between("stand_s", stand_s, 0.0, 3600.0);
  std::vector<std::string> messages = rules.messages();
  for (const std::string& waypoint : waypoints) {
    if (!parseWaypoint(waypoint)) {
      refuse(messages, "waypoints", waypoint, "must be 'X Y', with 'look DEGREES' or 'yaw DEGREES' behind it or not");
    }
  }
  return messages;
}

std::vector<std::string> LightSettings::validate() const {
  std::vector<std::string> messages = base::ConfigRules().between("glow", glow, 0.0, 1.0).messages();
  for (const std::string& lamp : lamps) {
    if (const auto numbers = numbersOf(lamp); !numbers || numbers->size() != 4) {
      refuse(messages, "lamps", lamp, "must be 'X Y Z BRIGHTNESS'");
    }
  }
  return messages;
}

std::vector<std::string> BeliefSettings::validate() const {
  base::ConfigRules rules;
  rules.between("dimension_m", dimension_m, 0.0, 0.05).between("placement_m", placement_m, 0.0, 0.1);
  rules.between("placement_deg", placement_deg, 0.0, 10.0).between("axis_m", axis_m, 0.0, 0.05).between("axis_deg", axis_deg, 0.0, 10.0);
  rules.between("wall_deg", wall_deg, 0.0, 5.0)
      .between("extra_part_share", extra_part_share, 0.0, 1.0)
      .between("clutter", clutter, 0, 1000);
  rules.between("mount_m", mount_m, 0.0, 0.05).between("mount_deg", mount_deg, 0.0, 5.0);
  rules.between("intrinsics_share", intrinsics_share, 0.0, 0.05).between("depth_scale_share", depth_scale_share, -0.1, 0.1);
  return rules.messages();
}

std::vector<std::string> OdometrySettings::validate() const {
  base::ConfigRules rules;
  rules.between("drift_share", drift_share, 0.0, 1.0).between("turn_drift_share", turn_drift_share, 0.0, 1.0);
  rules.between("prior_m", prior_m, 0.0, 1.0).between("prior_deg", prior_deg, 0.0, 45.0);
  return rules.messages();
}

std::vector<std::string> SceneScript::validate() const {
  base::ConfigRules rules;
  rules.between("rate_hz", rate_hz, 0.1, 120.0).between("duration_s", duration_s, 0.0, 24.0 * 3600.0);
  std::vector<std::string> messages = rules.messages();
  if (!base::parseRfc3339Ns(start)) {
    refuse(messages, "start", start, "must be a time with its offset, for instance 2026-03-02T08:00:00Z");
  }
  for (const std::string& change : changes) {
    if (!parseHomeChange(change)) {
      refuse(messages, "changes", change,
             "must be '[@SECONDS] ID VALUE deg|m', 'ID STATE', 'ID gone', 'ID at POSE' or 'ID on|in|under PARENT at POSE'");
    }
  }
  for (const std::string& walker : walkers) {
    if (const auto numbers = numbersOf(walker); !numbers || numbers->size() != 6 || (*numbers)[1] <= (*numbers)[0]) {
      refuse(messages, "walkers", walker, "must be 'FROM_S TO_S X Y X Y'");
    }
  }
  return messages;
}

SceneScript readSceneScript(const std::filesystem::path& file) {
  return base::loadConfig<SceneScript>({file, {}});
}

std::optional<Waypoint> parseWaypoint(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> all;
  for (std::string word; words >> word;) {
    all.push_back(word);
  }
  const auto number = [&](std::size_t i) {
    const std::optional<double> found = i < all.size() ? base::findNumber(all[i]) : std::nullopt;
    return found && std::isfinite(*found) ? found : std::nullopt;
  };
  if (all.size() % 2 != 0 || !number(0) || !number(1)) {
    return std::nullopt;
  }
  Waypoint waypoint;
  waypoint.position_map = {*number(0), *number(1)};
  for (std::size_t i = 2; i < all.size(); i += 2) {
    const bool is_again =
        std::find(all.begin() + 2, all.begin() + static_cast<std::ptrdiff_t>(i), all[i]) != all.begin() + static_cast<std::ptrdiff_t>(i);
    if (!number(i + 1) || is_again || (all[i] != "look" && all[i] != "yaw")) {
      return std::nullopt;
    }
    const double angle_rad = *number(i + 1) * kRadPerDeg;
    if (all[i] == "look") {
      waypoint.look_around_rad = angle_rad;
    } else {
      waypoint.yaw_rad = angle_rad;
    }
  }
  return waypoint;
}

RobotPath pathOf(const SceneScript& script) {
  const PathSettings& path = script.path;
  std::vector<Waypoint> waypoints;
  for (const std::string& text : path.waypoints) {
    waypoints.push_back(*parseWaypoint(text));
  }
  const FloorPose start{{path.start[0], path.start[1]}, path.start[2] * kRadPerDeg};
  return RobotPath(start, waypoints,
                   {path.speed_mps, path.acceleration_mps2, path.turn_rate_dps * kRadPerDeg, path.turn_acceleration_dps2 * kRadPerDeg});
}

}  // namespace oikos::simulate
