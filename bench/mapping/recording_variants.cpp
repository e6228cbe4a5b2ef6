// SPDX-License-Identifier: Apache-2.0
#include "bench/mapping/recording_variants.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/camera/calibration.h"
#include "core/recording/image_file.h"
#include "core/recording/listing.h"

namespace oikos::bench {

namespace {

namespace fs = std::filesystem;

std::string frameName(std::int64_t number) {
  const std::string digits = std::to_string(number);
  return "frame-" + std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

void write(const cv::Mat& image, const fs::path& file) {
  if (!cv::imwrite(file.string(), image)) {
    throw base::Error(base::ErrorCode::kIo, "cannot be written", file.string());
  }
}

/// Every second pixel of every second row: depths must not be mixed across edges.
cv::Mat decimate(const cv::Mat& image) {
  cv::Mat half(image.rows / 2, image.cols / 2, image.type());
  for (int y = 0; y < half.rows; ++y) {
    for (int x = 0; x < half.cols; ++x) {
      half.at<std::uint16_t>(y, x) = image.at<std::uint16_t>(2 * y, 2 * x);
    }
  }
  return half;
}

/// A pixel of the half-size colour image is the mean of 2x2: its centre lies between theirs.
camera::PinholeCamera halvedByMean(const camera::PinholeCamera& camera) {
  return {camera.width / 2, camera.height / 2, camera.fx / 2, camera.fy / 2, (camera.cx + 0.5) / 2 - 0.5, (camera.cy + 0.5) / 2 - 0.5};
}

/// Pixel x of the decimated depth image is pixel 2x of the large one, not the middle of two.
camera::PinholeCamera halvedByDecimation(const camera::PinholeCamera& camera) {
  return {camera.width / 2, camera.height / 2, camera.fx / 2, camera.fy / 2, camera.cx / 2, camera.cy / 2};
}

std::string pinholeText(const camera::PinholeCamera& camera) {
  using base::toText;
  return "width = " + std::to_string(camera.width) + "\nheight = " + std::to_string(camera.height) + "\nfx = " + toText(camera.fx) +
         "\nfy = " + toText(camera.fy) + "\ncx = " + toText(camera.cx) + "\ncy = " + toText(camera.cy) + "\n";
}

void writeHalvedCalibration(const fs::path& source, const fs::path& file) {
  const camera::Calibration calibration = camera::readCalibration(source);
  if (!calibration.depth || !calibration.distortion.isZero()) {
    throw base::Error(base::ErrorCode::kInput, "half size is made of recordings with a depth camera of its own and no distortion only",
                      source.string());
  }
  std::ofstream stream(file, std::ios::binary);
  stream << pinholeText(halvedByMean(calibration.color)) << "depth_scale = " << base::toText(calibration.depth_scale)
         << "\nrate_hz = " << base::toText(calibration.rate_hz) << "\n[depth]\n"
         << pinholeText(halvedByDecimation(calibration.depth->pinhole)) << "T_color_depth = [";
  const char* separator = "";
  const Eigen::Vector3d t = calibration.depth->T_color_depth.translation();
  const Eigen::Quaterniond q(calibration.depth->T_color_depth.linear());
  for (const double number : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    stream << separator << base::toText(number);
    separator = ", ";
  }
  stream << "]\n";
  stream.close();
  if (!stream) {
    throw base::Error(base::ErrorCode::kIo, "cannot be written", file.string());
  }
}

recording::Listing listFrames(const fs::path& source) {
  return recording::listSevenScenes(source, camera::readCalibration(source / "camera.toml").rate_hz);
}

std::int64_t stampOf(std::int64_t number, double rate_hz) {
  return std::llround(static_cast<double>(number) * 1e9 / rate_hz);
}

}  // namespace

void writeHalfSize(const fs::path& source, int step, const fs::path& folder) {
  fs::create_directories(folder);
  writeHalvedCalibration(source / "camera.toml", folder / "camera.toml");
  const double rate_hz = camera::readCalibration(source / "camera.toml").rate_hz;
  for (const recording::ListedFrame& frame : listFrames(source).frames) {
    const std::int64_t number = std::llround(static_cast<double>(frame.stamp_ns) * 1e-9 * rate_hz);
    if (number % step != 0) {
      continue;
    }
    const cv::Mat color = recording::readColorImage(frame.color);
    cv::Mat half;
    cv::resize(color, half, {color.cols / 2, color.rows / 2}, 0.0, 0.0, cv::INTER_AREA);
    write(half, folder / (frameName(number) + ".color.png"));
    write(decimate(recording::readDepthImage(frame.depth)), folder / (frameName(number) + ".depth.png"));
  }
}

recording::Trajectory linkLaps(const fs::path& source, int laps, const recording::Trajectory& truth, const fs::path& folder) {
  fs::create_directories(folder);
  const fs::path absolute = fs::absolute(source);
  const double rate_hz = camera::readCalibration(absolute / "camera.toml").rate_hz;
  const std::vector<recording::ListedFrame> frames = listFrames(absolute).frames;
  if (frames.size() != truth.size()) {
    throw base::Error(base::ErrorCode::kInput, "laps need a true pose for every frame", source.string());
  }
  fs::create_symlink(absolute / "camera.toml", folder / "camera.toml");
  recording::Trajectory poses;
  for (int lap = 0; lap < laps; ++lap) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const std::size_t k = lap % 2 == 0 ? i : frames.size() - 1 - i;
      const auto number = static_cast<std::int64_t>(poses.size());
      const std::string name = frameName(number);
      fs::create_symlink(frames[k].color, folder / (name + ".color" + frames[k].color.extension().string()));
      fs::create_symlink(frames[k].depth, folder / (name + ".depth.png"));
      poses.push_back({stampOf(number, rate_hz), truth[k].T_map_camera});
    }
  }
  return poses;
}

void linkFrames(const fs::path& source, int first, int end, const fs::path& folder) {
  fs::create_directories(folder);
  const fs::path absolute = fs::absolute(source);
  fs::create_symlink(absolute / "camera.toml", folder / "camera.toml");
  const double rate_hz = camera::readCalibration(absolute / "camera.toml").rate_hz;
  for (const recording::ListedFrame& frame : listFrames(absolute).frames) {
    const std::int64_t number = std::llround(static_cast<double>(frame.stamp_ns) * 1e-9 * rate_hz);
    if (number >= first && number < end) {
      fs::create_symlink(frame.color, folder / (frameName(number) + ".color" + frame.color.extension().string()));
      fs::create_symlink(frame.depth, folder / (frameName(number) + ".depth.png"));
    }
  }
}

}  // namespace oikos::bench
