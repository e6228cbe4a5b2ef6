// SPDX-License-Identifier: Apache-2.0
#include "bench/track/shown_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "core/base/read_file.h"
#include "core/recording/depth_png.h"
#include "core/recording/recording.h"
#include "core/recording/trajectory.h"
#include "semantic/model/home_models.h"
#include "semantic/xml/home_reader.h"

namespace oikos::bench {

namespace {

namespace fs = std::filesystem;

/// The number of a part in the images; `table`: `number,id,part`.
int numberOf(const fs::path& table, const std::string& object, const std::string& part) {
  std::ifstream lines(table);
  const std::string wanted = "," + object + "," + part;
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > wanted.size() && line.ends_with(wanted)) {
      return std::stoi(line);
    }
  }
  throw std::runtime_error(table.string() + ": no line '" + wanted + "'");
}

double largestFace(const model::TriangleMesh& mesh) {
  const Eigen::Vector3d size = mesh.bounds().sizes().cast<double>();
  std::array<double, 3> sizes = {size.x(), size.y(), size.z()};
  std::sort(sizes.begin(), sizes.end());
  return sizes[1] * sizes[2];
}

}  // namespace

ShownParts::ShownParts(const fs::path& drive)
    : drive_(drive), home_(semantic::getHome(semantic::readHome(drive / "truth" / "home.xml"), drive / "truth" / "home.xml")) {}

ShownParts::Part ShownParts::partOf(const std::string& joint_id) const {
  for (const semantic::Room& room : home_.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (!object.articulation) {
        continue;
      }
      const auto& joints = object.articulation->joints;
      const auto joint = std::find_if(joints.begin(), joints.end(), [&](const semantic::Joint& one) { return one.id.value == joint_id; });
      if (joint == joints.end()) {
        continue;
      }
      const model::ArticulatedModel model = semantic::ModelMaker(drive_ / "truth").make(object);
      const auto child = static_cast<std::size_t>(model.joints[static_cast<std::size_t>(joint - joints.begin())].child);
      const model::TriangleMesh& mesh = *model.parts[child].mesh_part;
      const Eigen::Isometry3d T_map_part =
          object.T_map_object.toIsometry() * model::Kinematics(model).solve(semantic::jointValues(object))[child];
      const std::string& part = object.articulation->parts[child].id.value;
      return {numberOf(drive_ / "truth" / "parts.csv", object.id.value, part), largestFace(mesh),
              T_map_part * mesh.bounds().center().cast<double>()};
    }
  }
  throw std::runtime_error(drive_.string() + ": no joint '" + joint_id + "'");
}

std::vector<double> ShownParts::sharesOf(const std::string& joint_id) const {
  const Part part = partOf(joint_id);
  const auto recording = recording::openRecording(drive_);
  const recording::Trajectory truth = recording::readTrajectory(drive_ / "groundtruth.txt");
  const camera::PinholeCamera& camera = recording->camera();
  std::vector<double> shares;
  for (int i = 0; i < recording->frameCount(); ++i) {
    const camera::RgbdFrame frame = recording->read(i, recording::Channels::kGray);
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%.6f.png", static_cast<double>(frame.stamp_ns) * 1e-9);
    const fs::path file = drive_ / "truth" / "parts" / name.data();
    const cv::Mat numbers = recording::decodeDepthPng(base::readFile(file), file.string());
    int pixels = 0;
    for (int v = 0; v < numbers.rows; ++v) {
      for (int u = 0; u < numbers.cols; ++u) {
        pixels += numbers.at<std::uint16_t>(v, u) == part.number && frame.depth_m.at<float>(v, u) > 0.0F ? 1 : 0;
      }
    }
    const double far_m = (truth[static_cast<std::size_t>(i)].T_map_camera.inverse() * part.middle_map).norm();
    shares.push_back(pixels * far_m * far_m / (part.face_sqm * camera.fx * camera.fy));
  }
  return shares;
}

}  // namespace oikos::bench
