// SPDX-License-Identifier: Apache-2.0
#include "core/recording/trajectory.h"

#include <array>
#include <sstream>
#include <string>
#include <string_view>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/read_file.h"
#include "core/geometry/pose_numbers.h"
#include "core/recording/decimal.h"

namespace oikos::recording {

namespace {

constexpr std::size_t kFieldCount = 8;

[[noreturn]] void fail(const std::string& what, const std::filesystem::path& file, int line) {
  throw base::Error(base::ErrorCode::kInput, what, file.string() + ":" + std::to_string(line));
}

StampedPose parsePose(const std::vector<std::string_view>& fields, const std::filesystem::path& file, int line) {
  if (fields.size() != kFieldCount) {
    fail(std::to_string(fields.size()) + " fields instead of 8: t tx ty tz qx qy qz qw", file, line);
  }
  const auto stamp_ns = parseStampNs(fields[0]);
  if (!stamp_ns) {
    fail("'" + std::string(fields[0]) + "' is not a stamp in decimal seconds", file, line);
  }
  std::array<double, 7> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = parseNumber(fields[i + 1]);
    if (!number) {
      fail("'" + std::string(fields[i + 1]) + "' is not a finite number", file, line);
    }
    numbers[i] = *number;
  }
  const auto T_map_camera = geometry::poseFromNumbers(numbers);
  if (!T_map_camera) {
    fail("the quaternion qx qy qz qw must have norm 1 (within 0.001)", file, line);
  }
  return {*stamp_ns, *T_map_camera};
}

}  // namespace

Trajectory readTrajectory(const std::filesystem::path& file) {
  std::istringstream lines(base::readFile(file));
  Trajectory trajectory;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto fields = splitFields(line);
    if (fields.empty()) {
      continue;
    }
    const StampedPose pose = parsePose(fields, file, number);
    if (!trajectory.empty() && pose.stamp_ns < trajectory.back().stamp_ns) {
      fail("stamp " + std::string(fields[0]) + " is before the one above it", file, number);
    }
    trajectory.push_back(pose);
  }
  if (trajectory.empty()) {
    throw base::Error(base::ErrorCode::kInput, "no pose in it; a line is t tx ty tz qx qy qz qw", file.string());
  }
  return trajectory;
}

void writeTrajectory(const Trajectory& trajectory, const std::filesystem::path& file) {
  base::AtomicFile output(file);
  std::ostream& text = output.stream();
  text << "# t tx ty tz qx qy qz qw (s, m)\n";
  for (const StampedPose& pose : trajectory) {
    OIKOS_CHECK(pose.T_map_camera.matrix().allFinite());
    const Eigen::Vector3d t = pose.T_map_camera.translation();
    const Eigen::Quaterniond q = Eigen::Quaterniond(pose.T_map_camera.rotation()).normalized();
    text << formatStamp(pose.stamp_ns);
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      text << ' ' << formatValue(value);
    }
    text << '\n';
  }
  output.commit();
}

}  // namespace oikos::recording
