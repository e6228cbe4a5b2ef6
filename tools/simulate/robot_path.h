// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace oikos::simulate {

/// A place of the robot on the floor of `map`.
struct FloorPose {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;

  [[nodiscard]] Eigen::Isometry3d T_map_base() const;
};

struct Waypoint {
  Eigen::Vector2d position_map = Eigen::Vector2d::Zero();
  std::optional<double> yaw_rad;  ///< to turn to once there
  double look_around_rad = 0.0;   ///< to turn about there first, to the left if positive
};

struct RobotMotion {
  double speed_mps = 0.4;
  double acceleration_mps2 = 0.4;
  double turn_rate_radps = 0.7;
  double turn_acceleration_radps2 = 1.4;
};

/// The way of a robot with two driven wheels: it turns on the spot towards each waypoint, then drives there in a straight line, with a
/// trapezoid of speed each time (or a triangle, where it is short). Immutable, so thread-safe.
class RobotPath {
 public:
  RobotPath(const FloorPose& start, const std::vector<Waypoint>& waypoints, const RobotMotion& motion);

  [[nodiscard]] double duration_s() const { return end_s_; }
  /// Before the start and after the end it stands still.
  [[nodiscard]] FloorPose at(double time_s) const;

 private:
  struct Piece {
    double start_s = 0.0;
    FloorPose from;
    double length = 0.0;  ///< m to drive, or rad to turn
    double rate = 0.0;    ///< m/s or rad/s
    double acceleration = 0.0;
    bool is_turn = false;
  };
  void add(bool is_turn, double length, const RobotMotion& motion);

  std::vector<Piece> pieces_;
  FloorPose end_;
  double end_s_ = 0.0;
};

}  // namespace oikos::simulate
