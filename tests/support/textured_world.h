// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "core/recording/recording.h"
#include "tests/support/analytic_room.h"

namespace oikos::test {

/// A room whose surfaces carry a smooth, irregular texture, rendered exactly from any pose: depth is the analytic distance and
/// the grey value a function of the surface point alone (brightness does not depend on the view), sampled at the pixel's centre.
/// The texture is band-limited: its finest grain is a lattice of 4.5 cm, so that it does not alias nearer than about 4 m in 320 × 240.
class TexturedWorld {
 public:
  /// `seed` picks the texture.
  explicit TexturedWorld(AnalyticRoom room, std::uint64_t seed = 1);
  /// AnalyticRoom::furnished() with texture.
  static TexturedWorld furnished(std::uint64_t seed = 1) { return TexturedWorld(AnalyticRoom::furnished(), seed); }

  /// The texture repeats itself every `period_m` along x, as wallpaper does: places that far apart look alike.
  static TexturedWorld repeating(AnalyticRoom room, double period_m, std::uint64_t seed = 1);

  [[nodiscard]] const AnalyticRoom& room() const { return room_; }
  /// 18 to 238.
  [[nodiscard]] double grayAt(const Eigen::Vector3d& point_map) const;

  [[nodiscard]] camera::RgbdFrame render(const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
                                         recording::Channels channels = recording::Channels::kGray) const;
  /// Rolling shutter: each image row from a pose of its own.
  [[nodiscard]] camera::RgbdFrame renderRows(const camera::PinholeCamera& camera,
                                             const std::function<Eigen::Isometry3d(int row)>& T_map_camera,
                                             recording::Channels channels = recording::Channels::kGray) const;

 private:
  struct Octave {
    Eigen::Matrix3d per_m;   ///< from metres to lattice cells
    Eigen::Vector3d offset;  ///< cells
    double amplitude;
    std::uint64_t seed;
  };

  AnalyticRoom room_;
  double period_m_ = 0.0;  ///< 0: never
  std::array<Octave, 4> octaves_;
};

/// 320×240, 62° wide.
camera::PinholeCamera texturedCamera();

}  // namespace oikos::test
