// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/query_parameters.h"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/rfc3339.h"
#include "semantic/model/pose.h"

namespace oikos::daemon {

namespace {

[[noreturn]] void refuse(std::string_view name, std::string_view found, std::string_view right) {
  const std::string shown(found.substr(0, 64));
  throw base::Error(base::ErrorCode::kInput, "'" + shown + "' is no " + std::string(right), std::string(name));
}

}  // namespace

void Page::describe(nlohmann::ordered_json& json, std::size_t total) const {
  json["total"] = total;
  json["next"] = offset < total && total - offset > limit ? nlohmann::ordered_json(offset + limit) : nlohmann::ordered_json();
}

Page pageOf(const RequestTarget& target) {
  Page page;
  page.offset = static_cast<std::size_t>(findCount(target, "offset").value_or(0));
  page.limit = static_cast<std::size_t>(findCount(target, "limit").value_or(static_cast<std::int64_t>(page.limit)));
  if (page.limit < 1 || page.limit > Page::kMostItems) {
    refuse("limit", target.find("limit").value_or(""), "number from 1 to " + std::to_string(Page::kMostItems));
  }
  return page;
}

std::optional<std::int64_t> findTime_ns(const RequestTarget& target, std::string_view name) {
  const std::optional<std::string_view> text = target.find(name);
  if (!text) {
    return std::nullopt;
  }
  // A plus sign in a query is a space, but nobody writes the offset of a time as %2B.
  std::string time(*text);
  if (const std::size_t space = time.rfind(' '); space != std::string::npos && space > time.find(':')) {
    time[space] = '+';
  }
  const std::optional<std::int64_t> time_ns = base::parseRfc3339Ns(time);
  if (!time_ns) {
    refuse(name, *text, "time such as 2024-05-17T09:30:00+02:00");
  }
  return time_ns;
}

std::optional<std::int64_t> findCount(const RequestTarget& target, std::string_view name) {
  const std::optional<std::string_view> text = target.find(name);
  if (!text) {
    return std::nullopt;
  }
  std::int64_t count = -1;
  const auto [end, failed] = std::from_chars(text->data(), text->data() + text->size(), count);
  if (failed != std::errc() || end != text->data() + text->size() || count < 0) {
    refuse(name, *text, "whole number from 0 on");
  }
  return count;
}

std::optional<Eigen::Isometry3d> findRobot(const RequestTarget& target) {
  constexpr double kFarthest_m = 1e6;
  const std::optional<std::string_view> text = target.find("at");
  if (!text) {
    return std::nullopt;
  }
  std::array<double, 3> numbers{};
  std::string_view rest = *text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t comma = i + 1 < numbers.size() ? rest.find(',') : rest.size();
    const std::optional<double> number = base::findNumber(rest.substr(0, comma));
    if (comma == std::string_view::npos || !number || !(std::abs(*number) < kFarthest_m)) {
      refuse("at", *text, "x,y,yaw in metres and degrees, such as 1.5,-2,90");
    }
    numbers[i] = *number;
    rest.remove_prefix(std::min(rest.size(), comma + 1));
  }
  return semantic::Pose{{numbers[0], numbers[1], 0.0}, {0.0, 0.0, numbers[2] * semantic::kRadPerDeg}}.toIsometry();
}

}  // namespace oikos::daemon
