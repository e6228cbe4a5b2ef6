// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "mapping/floorplan/wall_scan.h"
#include "semantic/model/home.h"

namespace oikos::bench {

/// A simulated home as a Kinect on a robot sees it: from a few places of each room, all round, without a drive between and without drift.
class SeenHome {
 public:
  /// `folder`: holds home.xml. The true home has walls half a degree out of square and furniture that is a tape's error off; doors stand
  /// open.
  SeenHome(const std::filesystem::path& folder, std::uint64_t seed, int threads);

  /// As a drive that began at `T_map_level`: the frame of its map.
  [[nodiscard]] mapping::WallSketch sketch(const Eigen::Isometry2d& T_map_level) const;
  /// What its home.xml says.
  [[nodiscard]] const semantic::Home& believed() const { return believed_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t viewCount() const { return depths_m_.size(); }

 private:
  std::string name_;
  semantic::Home believed_;
  camera::PinholeCamera camera_;
  std::vector<cv::Mat> depths_m_;
  std::vector<Eigen::Isometry3d> T_map_camera_;
};

}  // namespace oikos::bench
