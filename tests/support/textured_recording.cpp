// SPDX-License-Identifier: Apache-2.0
#include "tests/support/textured_recording.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>
#include <utility>

#include "core/base/error.h"
#include "core/camera/depth_noise.h"
#include "core/geometry/se3.h"

namespace oikos::test {

SyntheticRecording::SyntheticRecording(TexturedWorld world, const camera::PinholeCamera& camera,
                                       std::vector<Eigen::Isometry3d> T_map_camera, SyntheticSensor sensor)
    : world_(std::move(world)), camera_(camera), T_map_camera_(std::move(T_map_camera)), sensor_(std::move(sensor)) {
  OIKOS_CHECK(sensor_.rate_hz > 0.0);
  cv::setNumThreads(1);  // as the program does; and OpenCV's own threads look like races to ThreadSanitizer
}

std::int64_t SyntheticRecording::stampNs(int index) const {
  return std::llround(index * 1e9 / sensor_.rate_hz);
}

Eigen::Isometry3d SyntheticRecording::poseAt(double frame) const {
  if (frameCount() < 2) {
    return T_map_camera_.front();
  }
  const int before = std::clamp(static_cast<int>(std::floor(frame)), 0, frameCount() - 2);
  const auto i = static_cast<std::size_t>(before);
  return geometry::interpolate(T_map_camera_[i], T_map_camera_[i + 1], frame - before);
}

camera::RgbdFrame SyntheticRecording::render(int index, recording::Channels channels) const {
  if (sensor_.readout_s == 0.0) {
    return world_.render(camera_, T_map_camera_[static_cast<std::size_t>(index)], channels);
  }
  const double frames = sensor_.readout_s * sensor_.rate_hz;
  const auto pose_of_row = [&](int row) { return poseAt(index + (static_cast<double>(row) / camera_.height - 0.5) * frames); };
  return world_.renderRows(camera_, pose_of_row, channels);
}

void SyntheticRecording::addNoise(camera::RgbdFrame& frame) const {
  std::seed_seq seeds{static_cast<std::uint32_t>(sensor_.seed), static_cast<std::uint32_t>(frame.index)};
  std::mt19937_64 random(seeds);
  std::normal_distribution<double> normal;
  for (int v = 0; v < camera_.height; ++v) {
    for (int u = 0; u < camera_.width; ++u) {
      const double gray_error = sensor_.gray_sigma * normal(random);
      auto& gray = frame.gray.at<unsigned char>(v, u);
      gray = cv::saturate_cast<unsigned char>(gray + gray_error);
      if (!frame.color.empty()) {
        auto& bgr = frame.color.at<cv::Vec3b>(v, u);
        for (int c = 0; c < 3; ++c) {
          bgr[c] = cv::saturate_cast<unsigned char>(bgr[c] + gray_error);
        }
      }
      auto& depth_m = frame.depth_m.at<float>(v, u);
      depth_m = static_cast<float>(depth_m + sensor_.depth_sigma_scale * camera::depthSigma_m(depth_m) * normal(random));
    }
  }
}

camera::RgbdFrame SyntheticRecording::read(int index, recording::Channels channels) const {
  OIKOS_CHECK(index >= 0 && index < frameCount());
  camera::RgbdFrame frame = render(index, channels);
  frame.index = index;
  frame.stamp_ns = stampNs(index);
  if (sensor_.blank_frames.contains(index)) {
    frame.gray.setTo(128);
    frame.depth_m.setTo(std::numeric_limits<float>::quiet_NaN());
    if (!frame.color.empty()) {
      frame.color.setTo(cv::Scalar::all(128));
    }
  }
  if (sensor_.gray_sigma > 0.0 || sensor_.depth_sigma_scale > 0.0) {
    addNoise(frame);
  }
  frame.depth_m.setTo(std::numeric_limits<float>::quiet_NaN(), frame.depth_m > sensor_.max_depth_m);
  return frame;
}

recording::Trajectory SyntheticRecording::truth() const {
  recording::Trajectory trajectory;
  for (int i = 0; i < frameCount(); ++i) {
    trajectory.push_back({stampNs(i), T_map_camera_[static_cast<std::size_t>(i)]});
  }
  return trajectory;
}

}  // namespace oikos::test
