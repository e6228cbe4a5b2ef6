// SPDX-License-Identifier: Apache-2.0
// Normals of a depth image at the points of a scan. Included by this folder's sources only.
#pragma once

#include <Eigen/Core>
#include <cstddef>
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

  void loadRow(int v_px);
  [[nodiscard]] const float* loaded(int du_px) const;
  void addRow(int dv_px);
  void solve(int v_px);

  const cv::Mat& depth_m_;
  camera::PinholeCamera camera_;
  int step_px_;
  int radius_px_;
  int stride_px_;
  float max_step_share_;
  std::size_t columns_;
  std::size_t margin_;       ///< columns of a phase that a window reaches beyond the image
  std::vector<Row> phases_;  ///< inverse depth of an image row (1/m), by u mod step; NaN beyond the image
  Row centre_;               ///< inverse depth in the middle of each window
  Row samples_of_row_;       ///< how many of a window's row lie in the image
  float rows_in_image_ = 0.0F;
  Row row_count_, row_u_, row_uu_, row_q_, row_qu_;  ///< of one row of the windows
  Row count_, u_, v_, uu_, uv_, vv_, q_, qu_, qv_;   ///< of the windows: q less the centre's
  Row x_, y_, z_;
};

}  // namespace oikos::registration
