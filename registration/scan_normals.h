// SPDX-License-Identifier: Apache-2.0
// Normals of a depth image at the points of a scan. Included by this folder's sources only.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "registration/scan.h"

namespace oikos::registration {

/// A normal comes from the inverse depth around a point, which on a plane is linear in the image: q(u, v) = (n · ray(u, v)) / d. All points
/// of a row are fitted at once, in floats that lie as vector instructions want them; a reading of another surface weighs nothing.
class RowNormals {
 public:
  /// `depth_m`: CV_32FC1 of the camera's size, NaN = no reading; read as long as this object lives.
  RowNormals(const cv::Mat& depth_m, const camera::PinholeCamera& camera, const ScanConfig& config);

  /// Of the pixels (0, v), (step, v), (2 * step, v), …
  void fit(int v_px);
  /// Towards the camera, length 1; 0 where too little of the window is on the same surface.
  [[nodiscard]] Eigen::Vector3f at(std::size_t column) const { return {x_[column], y_[column], z_[column]}; }

 private:
  using Row = std::vector<float>;
  struct Moments;

  void load(int v_px);
  [[nodiscard]] Row& rowOf(int v_px) { return rows_[static_cast<std::size_t>(v_px) % rows_.size()]; }
  [[nodiscard]] std::size_t offsetOf(int du_px) const;
  [[nodiscard]] Moments momentsOf(std::size_t first, const float* centre) const;
  void solve(std::size_t first, float v_px, const Moments& moments);

  const cv::Mat& depth_m_;
  camera::PinholeCamera camera_;
  int step_px_;
  int radius_px_;
  float max_step_share_;
  std::size_t columns_;       ///< in whole blocks: the last ones may lie beyond the image
  std::size_t margin_;        ///< columns of a phase that a window reaches beyond the image
  std::vector<int> samples_;  ///< of a window, in each direction (px)
  std::vector<std::size_t> offset_of_sample_;
  std::vector<Row> rows_;  ///< inverse depth of the last image rows (1/m), by u mod step; NaN beyond the image
  int next_row_ = 0;       ///< of the image, to be loaded
  Row samples_of_row_;     ///< how many of a window's row lie in the image
  struct SampledRow {
    const float* inverse_depth = nullptr;
    float dv_px = 0.0F;
  };
  std::vector<SampledRow> sampled_rows_;  ///< of the windows being fitted that lie in the image
  Row x_, y_, z_;
};

}  // namespace oikos::registration
