// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "core/recording/recording.h"
#include "tests/support/textured_world.h"

namespace oikos::test {

/// What a synthetic camera does to the exact images.
struct SyntheticSensor {
  double rate_hz = 30.0;                                         ///< frame i has the stamp i / rate_hz
  double gray_sigma = 0.0;                                       ///< grey values, each pixel for itself
  double depth_sigma_scale = 0.0;                                ///< times camera::depthSigma_m, each pixel for itself; 0: exact depth
  double max_depth_m = std::numeric_limits<double>::infinity();  ///< no reading beyond
  double readout_s = 0.0;           ///< rolling shutter: row y is exposed at stamp + (y / height - 0.5) * readout_s
  std::set<int> blank_frames = {};  ///< a covered lens: even grey, no depth
  std::uint64_t seed = 1;           ///< of the noise
};

/// A drive through a textured world, rendered frame by frame on request: nothing is kept, so that any number of frames is cheap to
/// hold. The same frame is the same bytes each time it is read. Thread-safe.
class SyntheticRecording : public recording::Recording {
 public:
  SyntheticRecording(TexturedWorld world, const camera::PinholeCamera& camera, std::vector<Eigen::Isometry3d> T_map_camera,
                     SyntheticSensor sensor = {});

  [[nodiscard]] const camera::PinholeCamera& camera() const override { return camera_; }
  [[nodiscard]] int frameCount() const override { return static_cast<int>(T_map_camera_.size()); }
  [[nodiscard]] std::int64_t stampNs(int index) const override;
  [[nodiscard]] camera::RgbdFrame read(int index, recording::Channels channels) const override;

  /// The true camera poses at the stamps, one a frame.
  [[nodiscard]] recording::Trajectory truth() const;
  [[nodiscard]] const TexturedWorld& world() const { return world_; }

 private:
  [[nodiscard]] Eigen::Isometry3d poseAt(double frame) const;
  [[nodiscard]] camera::RgbdFrame render(int index, recording::Channels channels) const;
  void addNoise(camera::RgbdFrame& frame) const;

  TexturedWorld world_;
  camera::PinholeCamera camera_;
  std::vector<Eigen::Isometry3d> T_map_camera_;
  SyntheticSensor sensor_;
};

}  // namespace oikos::test
