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

namespace oikos::recording {

struct RecordingConfig {
  std::string camera;               ///< path of a camera.toml or a preset's name; empty: `camera.toml` of the recording
  double max_association_s = 0.02;  ///< colour and depth farther apart than this are not a pair
};

enum class Channels { kGray, kColor };  ///< kGray leaves RgbdFrame::color empty and is faster

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
};

/// Recognises the format by the folder's content. Throws Error that says what was looked for and what to do.
[[nodiscard]] std::unique_ptr<Recording> openRecording(const std::filesystem::path& folder, const RecordingConfig& config = {});

}  // namespace oikos::recording
