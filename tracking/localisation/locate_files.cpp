// SPDX-License-Identifier: Apache-2.0
#include "tracking/localisation/locate_files.h"

#include <algorithm>
#include <string>

#include "core/base/atomic_file.h"
#include "core/base/number_text.h"
#include "core/recording/trajectory.h"

namespace oikos::tracking {

namespace {

using base::toText;

std::string secondsText(std::int64_t stamp_ns) {
  return base::toFixedText(static_cast<double>(stamp_ns) * 1e-9, 6);
}

std::string poseText(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  std::string text;
  for (const double number : {T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()}) {
    text.append(",").append(toText(number));
  }
  return text;
}

std::string csvHead() {
  std::string head = "t_s,frame,source,map_status,map_inliers,landmark_status,tx_m,ty_m,tz_m,qx,qy,qz,qw";
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      head.append(",c").append(std::to_string(row)).append(std::to_string(column));
    }
  }
  return head + "\n";
}

/// A frame that was not found has its statuses and empty fields.
std::string csvLine(const LocatedPose& pose) {
  std::string line = secondsText(pose.stamp_ns) + "," + std::to_string(pose.frame) + "," + std::string(base::toString(pose.source)) + "," +
                     std::string(base::toString(pose.in_map.status)) + "," + std::to_string(pose.in_map.inliers) + "," +
                     (pose.landmarks ? std::string(base::toString(pose.landmarks->status)) : std::string());
  if (pose.source == PoseSource::kNone) {
    return line + std::string(7 + 36, ',') + "\n";
  }
  line += poseText(pose.T_map_camera);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      line.append(",").append(toText(pose.covariance(row, column)));
    }
  }
  return line + "\n";
}

std::string landmarkLines(const LocatedPose& pose) {
  std::string lines;
  for (const registration::LandmarkContribution& piece : pose.landmarks->landmarks) {
    lines += secondsText(pose.stamp_ns) + "," + std::to_string(pose.frame) + "," + piece.id + "," +
             std::string(base::toString(piece.verdict)) + "," + std::to_string(piece.pixels) + "," + std::to_string(piece.agreeing) + "," +
             toText(piece.weight) + "," + toText(piece.contradiction) + ",";
    for (std::size_t i = 0; i < piece.dropped_parts.size(); ++i) {
      lines.append(i > 0 ? " " : "").append(piece.dropped_parts[i]);
    }
    lines += "\n";
  }
  return lines;
}

}  // namespace

std::filesystem::path besideLocated(const std::filesystem::path& file, const char* ending) {
  return file.parent_path() / (file.stem().string() + ending);
}

void writeLocated(const std::vector<LocatedPose>& poses, const std::optional<Eigen::Isometry3d>& T_base_camera,
                  const std::filesystem::path& file) {
  recording::Trajectory found;
  recording::Trajectory before;
  std::string csv = csvHead();
  std::string landmarks = "t_s,frame,id,verdict,pixels,agreeing,weight,contradiction,dropped_parts\n";
  for (const LocatedPose& pose : poses) {
    csv += csvLine(pose);
    if (pose.isFound()) {
      found.push_back({pose.stamp_ns, pose.T_map_camera});
    }
    if (pose.landmarks) {
      before.push_back({pose.stamp_ns, *pose.T_map_camera_before});
      landmarks += landmarkLines(pose);
    }
  }
  recording::writeTrajectory(found, file);
  if (T_base_camera) {
    for (recording::StampedPose& pose : found) {
      pose.T_map_camera = pose.T_map_camera * T_base_camera->inverse();
    }
    recording::writeTrajectory(found, besideLocated(file, ".base.txt"));
  }
  base::writeFileAtomically(besideLocated(file, ".csv"), csv);
  if (!before.empty()) {
    recording::writeTrajectory(before, besideLocated(file, ".before.txt"));
    base::writeFileAtomically(besideLocated(file, ".landmarks.csv"), landmarks);
  }
}

}  // namespace oikos::tracking
