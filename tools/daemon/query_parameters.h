// SPDX-License-Identifier: Apache-2.0
// A request's parameters, read and checked. All throw Error{kInput} naming the parameter.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "tools/daemon/request_target.h"

namespace oikos::daemon {

/// Which piece of a long list is asked for: `offset` and `limit`.
struct Page {
  static constexpr std::size_t kMostItems = 1000;
  std::size_t offset = 0;
  std::size_t limit = 100;

  [[nodiscard]] bool holds(std::size_t number) const { return number >= offset && number - offset < limit; }
  /// Adds `total` and `next`, the offset to go on with; null: that was the end.
  void describe(nlohmann::ordered_json& json, std::size_t total) const;
};

[[nodiscard]] Page pageOf(const RequestTarget& target);
/// A time as in RFC 3339; nothing if there is no such parameter.
[[nodiscard]] std::optional<std::int64_t> findTime_ns(const RequestTarget& target, std::string_view name);
/// A count; nothing if there is no such parameter.
[[nodiscard]] std::optional<std::int64_t> findCount(const RequestTarget& target, std::string_view name);
/// `at=x,y,yaw` in metres and degrees: where the robot is, on the floor.
[[nodiscard]] std::optional<Eigen::Isometry3d> findRobot(const RequestTarget& target);

}  // namespace oikos::daemon
