// SPDX-License-Identifier: Apache-2.0
// What a scene's file says: docs/formats.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/config_rules.h"
#include "core/camera/sensor/depth_sensor.h"
#include "tools/simulate/ceiling_settings.h"
#include "tools/simulate/robot_path.h"

namespace oikos::simulate {

/// The camera on the robot, and how it takes its pictures.
struct CameraSettings {
  int width = 640;
  int height = 480;
  double fx = 525.0;
  double fy = 525.0;
  double cx = 319.5;
  double cy = 239.5;
  std::vector<double> distortion = {0.0, 0.0, 0.0, 0.0, 0.0};  ///< of the colour images: k1, k2, p1, p2, k3
  double forward_m = 0.1;                                      ///< before the middle of the base
  double height_m = 1.0;
  double tilt_deg = 12.0;      ///< downwards
  double depth_delay_s = 0.0;  ///< of the depth image after the colour image, at most 15 ms
  double readout_s = 0.0;      ///< of the rolling shutter
  double lost_share = 0.0;     ///< of the frames
  int jpeg_quality = 92;       ///< of the colour images; 0: PNG

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("width", width);
    visitor("height", height);
    visitor("fx", fx);
    visitor("fy", fy);
    visitor("cx", cx);
    visitor("cy", cy);
    visitor("distortion", distortion);
    visitor("forward_m", forward_m);
    visitor("height_m", height_m);
    visitor("tilt_deg", tilt_deg);
    visitor("depth_delay_s", depth_delay_s);
    visitor("readout_s", readout_s);
    visitor("lost_share", lost_share);
    visitor("jpeg_quality", jpeg_quality);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Where the robot drives.
struct PathSettings {
  std::vector<double> start = {0.0, 0.0, 0.0};  ///< x, y (m), yaw (degrees), in `map`
  std::vector<std::string> waypoints;           ///< `X Y`, then perhaps `look DEGREES` and `yaw DEGREES`
  double speed_mps = 0.4;
  double acceleration_mps2 = 0.5;
  double turn_rate_dps = 40.0;
  double turn_acceleration_dps2 = 90.0;
  double stand_s = 1.0;  ///< before it sets off

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("start", start);
    visitor("waypoints", waypoints);
    visitor("speed_mps", speed_mps);
    visitor("acceleration_mps2", acceleration_mps2);
    visitor("turn_rate_dps", turn_rate_dps);
    visitor("turn_acceleration_dps2", turn_acceleration_dps2);
    visitor("stand_s", stand_s);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct LightSettings {
  std::vector<std::string> lamps;  ///< `X Y Z BRIGHTNESS`; none: one below the middle of each room's ceiling
  double glow = 0.45;              ///< light from all sides
  bool shadows = true;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("lamps", lamps);
    visitor("glow", glow);
    visitor("shadows", shadows);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// How the home that is rendered differs from what its home.xml says. Standard deviations; 0: not at all.
struct BeliefSettings {
  double dimension_m = 0.0;  ///< of each dimension of a piece, as from a tape measure
  double placement_m = 0.0;  ///< of a piece on the floor
  double placement_deg = 0.0;
  double axis_m = 0.0;  ///< of hinges and slides
  double axis_deg = 0.0;
  double wall_deg = 0.0;          ///< by which walls are out of square
  double extra_part_share = 0.0;  ///< of the pieces with a part that is not modelled
  int clutter = 0;                ///< pieces that nobody has modelled
  double mount_m = 0.0;           ///< of the camera's mount
  double mount_deg = 0.0;
  double intrinsics_share = 0.0;   ///< of the focal lengths and the principal point
  double depth_scale_share = 0.0;  ///< readings are too long by this much; no deviation

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("dimension_m", dimension_m);
    visitor("placement_m", placement_m);
    visitor("placement_deg", placement_deg);
    visitor("axis_m", axis_m);
    visitor("axis_deg", axis_deg);
    visitor("wall_deg", wall_deg);
    visitor("extra_part_share", extra_part_share);
    visitor("clutter", clutter);
    visitor("mount_m", mount_m);
    visitor("mount_deg", mount_deg);
    visitor("intrinsics_share", intrinsics_share);
    visitor("depth_scale_share", depth_scale_share);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Deviations of the wheel odometry (`odometry.txt`) and of a localisation like AMCL's (`prior.txt`).
struct OdometrySettings {
  bool is_written = true;
  double drift_share = 0.02;       ///< of the way driven
  double turn_drift_share = 0.02;  ///< of the angle turned
  double prior_m = 0.05;           ///< standard deviation in x and y
  double prior_deg = 3.0;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("is_written", is_written);
    visitor("drift_share", drift_share);
    visitor("turn_drift_share", turn_drift_share);
    visitor("prior_m", prior_m);
    visitor("prior_deg", prior_deg);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

struct SceneScript {
  std::string start = "2026-01-01T08:00:00Z";  ///< RFC 3339: the recording's
  double rate_hz = 10.0;
  double duration_s = 0.0;  ///< 0: until the robot has arrived
  camera::DepthSensorKind sensor = camera::DepthSensorKind::kKinect1;
  std::vector<std::string> changes;  ///< see HomeChange
  bool part_images = false;          ///< of what each pixel of the colour pictures shows
  std::vector<std::string> walkers;  ///< people who walk through: `FROM_S TO_S X Y X Y`
  CameraSettings camera;
  PathSettings path;
  LightSettings light;
  BeliefSettings belief;
  OdometrySettings odometry;
  CeilingSettings ceiling_camera;

  template <class Visitor>
  void visit(Visitor&& visitor) {
    visitor("start", start);
    visitor("rate_hz", rate_hz);
    visitor("duration_s", duration_s);
    visitor("sensor", sensor);
    visitor("changes", changes);
    visitor("part_images", part_images);
    visitor("walkers", walkers);
    visitor("camera", camera);
    visitor("path", path);
    visitor("light", light);
    visitor("belief", belief);
    visitor("odometry", odometry);
    visitor("ceiling_camera", ceiling_camera);
  }
  [[nodiscard]] std::vector<std::string> validate() const;
};

/// Throws Error{kInput} that names file, line or key, what was found and what would be right.
[[nodiscard]] SceneScript readSceneScript(const std::filesystem::path& file);

/// `X Y [look DEGREES] [yaw DEGREES]`. Nothing: it is none.
[[nodiscard]] std::optional<Waypoint> parseWaypoint(const std::string& text);

/// The robot's whole way.
[[nodiscard]] RobotPath pathOf(const SceneScript& script);

}  // namespace oikos::simulate
