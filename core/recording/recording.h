// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/camera/rgbd_frame.h"
#include "core/recording/trajectory.h"

namespace oikos::recording {

struct RecordingConfig {
  std::string camera;               ///< path of a camera.toml or a preset's name; empty: `camera.toml` of the recording
  double max_association_s = 0.02;  ///< colour and depth farther apart than this are not a pair
  std::vector<std::string> validate() const;
};

enum class Channels { kGray, kColor };  ///< kGray leaves RgbdFrame::color empty and is faster

/// What came of listing a recording, before any image is decoded.
struct ListingStatistics {
  int listed_color = 0;  ///< entries, duplicates included
  int listed_depth = 0;
  int duplicate_color = 0;  ///< entries with the stamp or number of an earlier one; left out
  int duplicate_depth = 0;
  int unmatched_color = 0;  ///< images without a partner; left out
  int unmatched_depth = 0;
};

/// A recorded RGB-D drive, opened and listed, its frames decoded on request.
class Recording {
 public:
  virtual ~Recording() = default;
  /// The rectified colour camera that all frames are in.
  [[nodiscard]] virtual const camera::PinholeCamera& camera() const = 0;
  [[nodiscard]] virtual int frameCount() const = 0;
  [[nodiscard]] virtual std::int64_t stampNs(int index) const = 0;
  /// Decodes, rectifies and registers one frame. Thread-safe. Throws Error{kInput} that names the file.
  [[nodiscard]] virtual camera::RgbdFrame read(int index, Channels channels) const = 0;

  /// Name of the format for a person: "TUM RGB-D", "7-Scenes".
  [[nodiscard]] virtual std::string format() const { return "in memory"; }
  [[nodiscard]] virtual ListingStatistics listing() const { return {}; }
  /// `T_odom_base` from `odometry.txt`, if the recording has one. Throws Error with file and line if it is wrong.
  [[nodiscard]] virtual std::optional<Trajectory> findOdometry() const { return std::nullopt; }
  /// The camera's mount on the robot, if the calibration says it.
  [[nodiscard]] virtual std::optional<Eigen::Isometry3d> T_base_camera() const { return std::nullopt; }
  /// By what share of the distance depth is wrong in a way that varies smoothly over the picture (a standard deviation); 0: not at all.
  [[nodiscard]] virtual double depthDistortion() const { return 0.0; }
  /// UTC of stamp 0 in nanoseconds since 1970, if the calibration says it.
  [[nodiscard]] virtual std::optional<std::int64_t> startNs() const { return std::nullopt; }
};

/// Recognises the format by the folder's content. Throws Error that says what was looked for and what to do.
[[nodiscard]] std::unique_ptr<Recording> openRecording(const std::filesystem::path& folder, const RecordingConfig& config = {});

}  // namespace oikos::recording
