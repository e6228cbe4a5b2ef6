// SPDX-License-Identifier: Apache-2.0
#include "tools/simulate/robot_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oikos::simulate {

namespace {

/// From one angle to another by the shorter way.
double turnBetween(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

/// A way that is sped up to `rate` at most, and slowed down to a stop.
struct Trapezoid {
  double ramp_s = 0.0;
  double cruise_s = 0.0;
  double rate = 0.0;

  Trapezoid(double length, double rate_limit, double acceleration) : rate(std::min(rate_limit, std::sqrt(length * acceleration))) {
    ramp_s = rate / acceleration;
    cruise_s = rate > 0.0 ? length / rate - ramp_s : 0.0;
  }
  [[nodiscard]] double duration_s() const { return 2.0 * ramp_s + cruise_s; }
  [[nodiscard]] double doneAfter(double time_s) const {
    const double length = rate * (ramp_s + cruise_s);
    if (ramp_s <= 0.0 || time_s >= duration_s()) {
      return length;
    }
    const double acceleration = rate / ramp_s;
    if (time_s < ramp_s) {
      return 0.5 * acceleration * time_s * time_s;
    }
    if (time_s < ramp_s + cruise_s) {
      return rate * (time_s - 0.5 * ramp_s);
    }
    const double left_s = duration_s() - time_s;
    return length - 0.5 * acceleration * left_s * left_s;
  }
};

FloorPose advanced(const FloorPose& from, bool is_turn, double way) {
  FloorPose pose = from;
  if (is_turn) {
    pose.yaw_rad += way;
  } else {
    pose.position_m += way * Eigen::Vector2d(std::cos(from.yaw_rad), std::sin(from.yaw_rad));
  }
  return pose;
}

}  // namespace

Eigen::Isometry3d FloorPose::T_map_base() const {
  return Eigen::Translation3d(position_m.x(), position_m.y(), 0.0) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
}

RobotPath::RobotPath(const FloorPose& start, const std::vector<Waypoint>& waypoints, const RobotMotion& motion) : end_(start) {
  constexpr double kThere_m = 1e-6;
  for (const Waypoint& waypoint : waypoints) {
    const Eigen::Vector2d way = waypoint.position_map - end_.position_m;
    if (way.norm() > kThere_m) {
      add(true, turnBetween(end_.yaw_rad, std::atan2(way.y(), way.x())), motion);
      add(false, way.norm(), motion);
    }
    add(true, waypoint.look_around_rad, motion);
    if (waypoint.yaw_rad) {
      add(true, turnBetween(end_.yaw_rad, *waypoint.yaw_rad), motion);
    }
  }
}

void RobotPath::add(bool is_turn, double length, const RobotMotion& motion) {
  constexpr double kNothing = 1e-9;
  if (std::abs(length) < kNothing) {
    return;
  }
  const Piece piece{end_s_,
                    end_,
                    length,
                    is_turn ? motion.turn_rate_radps : motion.speed_mps,
                    is_turn ? motion.turn_acceleration_radps2 : motion.acceleration_mps2,
                    is_turn};
  pieces_.push_back(piece);
  end_s_ += Trapezoid(std::abs(length), piece.rate, piece.acceleration).duration_s();
  end_ = advanced(end_, is_turn, length);
}

FloorPose RobotPath::at(double time_s) const {
  if (pieces_.empty() || time_s >= end_s_) {
    return end_;
  }
  const auto next =
      std::upper_bound(pieces_.begin(), pieces_.end(), time_s, [](double t, const Piece& piece) { return t < piece.start_s; });
  const Piece& piece = next == pieces_.begin() ? pieces_.front() : *std::prev(next);
  const double done = Trapezoid(std::abs(piece.length), piece.rate, piece.acceleration).doneAfter(std::max(0.0, time_s - piece.start_s));
  return advanced(piece.from, piece.is_turn, std::copysign(done, piece.length));
}

}  // namespace oikos::simulate
