// SPDX-License-Identifier: Apache-2.0
#include "core/recording/recording.h"

#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/camera/calibration.h"
#include "core/camera/depth_registration.h"
#include "core/camera/rectifier.h"
#include "core/recording/image_file.h"
#include "core/recording/listing.h"

namespace oikos::recording {

namespace {

namespace fs = std::filesystem;
using base::Error;
using base::ErrorCode;

/// A recording whose frames are single image files in a folder.
class FolderRecording : public Recording {
 public:
  FolderRecording(fs::path folder, const camera::Calibration& calibration, Listing listing)
      : folder_(std::move(folder)),
        calibration_(calibration),
        listing_(std::move(listing)),
        rectifier_(calibration.color, calibration.distortion),
        registration_(calibration, rectifier_) {}

  [[nodiscard]] const camera::PinholeCamera& camera() const override { return calibration_.color; }
  [[nodiscard]] int frameCount() const override { return static_cast<int>(listing_.frames.size()); }
  [[nodiscard]] std::int64_t stampNs(int index) const override { return frame(index).stamp_ns; }
  [[nodiscard]] std::string format() const override { return listing_.format; }
  [[nodiscard]] ListingStatistics listing() const override { return listing_.statistics; }
  [[nodiscard]] std::optional<Eigen::Isometry3d> T_base_camera() const override { return calibration_.T_base_camera; }
  [[nodiscard]] double depthDistortion() const override { return calibration_.depth_distortion; }
  [[nodiscard]] std::optional<std::int64_t> startNs() const override { return calibration_.start_ns; }

  [[nodiscard]] std::optional<Trajectory> findOdometry() const override {
    const fs::path file = folder_ / "odometry.txt";
    return fs::exists(file) ? std::optional<Trajectory>(readTrajectory(file)) : std::nullopt;
  }

  [[nodiscard]] camera::RgbdFrame read(int index, Channels channels) const override;

 private:
  [[nodiscard]] const ListedFrame& frame(int index) const {
    OIKOS_CHECK(index >= 0 && index < frameCount());
    return listing_.frames[static_cast<std::size_t>(index)];
  }

  fs::path folder_;
  camera::Calibration calibration_;
  Listing listing_;
  camera::Rectifier rectifier_;
  camera::DepthRegistration registration_;
};

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void checkSize(const cv::Mat& image, const cv::Size& expected, const fs::path& file, const std::string& hint) {
  if (image.size() != expected) {
    throw Error(ErrorCode::kInput,
                "the image is " + sizeText(image.cols, image.rows) + " px, the calibration says " +
                    sizeText(expected.width, expected.height) + hint,
                file.string());
  }
}

/// Adds the line of the list to the complaint about a file that it names.
[[noreturn]] void rethrowWithListing(const Error& error, const ListedFrame& frame) {
  const std::string message = error.what();
  const std::size_t prefix = error.where().empty() ? 0 : error.where().size() + 2;
  throw Error(ErrorCode::kInput, message.substr(prefix) + (frame.listed_at.empty() ? "" : " (listed in " + frame.listed_at + ")"),
              error.where());
}

camera::RgbdFrame FolderRecording::read(int index, Channels channels) const {
  const ListedFrame& files = frame(index);
  camera::RgbdFrame result;
  result.index = index;
  result.stamp_ns = files.stamp_ns;
  try {
    const cv::Size color_size(calibration_.color.width, calibration_.color.height);
    if (channels == Channels::kColor) {
      const cv::Mat color = readColorImage(files.color);
      checkSize(color, color_size, files.color, "");
      result.color = rectifier_.rectifyColor(color);
    }
    const cv::Mat gray = readGrayImage(files.color);
    checkSize(gray, color_size, files.color, "");
    result.gray = rectifier_.rectifyColor(gray);
    const cv::Mat depth = readDepthImage(files.depth);
    checkSize(depth, {registration_.storedWidth(), registration_.storedHeight()}, files.depth,
              calibration_.depth ? " in [depth]" : "; a depth camera of its own needs a [depth] table in camera.toml");
    result.depth_m = registration_.toMetres(depth);
  } catch (const Error& error) {
    rethrowWithListing(error, files);
  }
  return result;
}

camera::Calibration findCalibration(const fs::path& folder, const RecordingConfig& config) {
  if (!config.camera.empty()) {
    return camera::getCalibration(config.camera);
  }
  const fs::path file = folder / "camera.toml";
  if (!fs::exists(file)) {
    std::string presets;
    for (const std::string& name : camera::calibrationPresetNames()) {
      presets += (presets.empty() ? "" : ", ") + name;
    }
    throw Error(
        ErrorCode::kInput,
        "no intrinsics: put width, height, fx, fy, cx, cy and depth_scale into this file, or give --camera a file or one of the presets " +
            presets,
        file.string());
  }
  return camera::readCalibration(file);
}

}  // namespace

std::vector<std::string> RecordingConfig::validate() const {
  std::vector<std::string> problems;
  if (!std::isfinite(max_association_s) || max_association_s < 0.0 || max_association_s > 1.0) {
    problems.push_back("recording.max_association_s = " + std::to_string(max_association_s) + ": must be from 0 to 1");
  }
  return problems;
}

std::unique_ptr<Recording> openRecording(const fs::path& folder, const RecordingConfig& config) {
  if (const auto problems = config.validate(); !problems.empty()) {
    throw Error(ErrorCode::kUsage, problems.front());
  }
  if (!fs::is_directory(folder)) {
    throw Error(fs::exists(folder) ? ErrorCode::kInput : ErrorCode::kIo, fs::exists(folder) ? "not a folder" : "no such folder",
                folder.string());
  }
  const bool is_tum = looksLikeTum(folder);
  if (!is_tum && !looksLikeSevenScenes(folder)) {
    throw Error(ErrorCode::kInput,
                "not a recording: neither rgb.txt and depth.txt (TUM) nor frame-000000.color.png (or .jpg) and frame-000000.depth.png "
                "(7-Scenes) in it",
                folder.string());
  }
  const camera::Calibration calibration = findCalibration(folder, config);
  Listing listing = is_tum ? listTum(folder, std::llround(config.max_association_s * 1e9)) : listSevenScenes(folder, calibration.rate_hz);
  listing.format = is_tum ? "TUM RGB-D" : "7-Scenes";
  return std::make_unique<FolderRecording>(folder, calibration, std::move(listing));
}

}  // namespace oikos::recording
