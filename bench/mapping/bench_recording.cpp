// SPDX-License-Identifier: Apache-2.0
#include "bench/mapping/bench_recording.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <locale>
#include <sstream>

#include "bench/mapping/recording_variants.h"
#include "core/base/error.h"
#include "core/base/read_file.h"
#include "core/camera/calibration.h"
#include "core/recording/recording.h"

namespace oikos::bench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFiveHz = "kitchen-5hz";
constexpr const char* kLaps = "kitchen-10-laps";
constexpr int kFiveHzStep = 6;
constexpr int kLapCount = 10;

/// A 4x4 matrix in rows.
Eigen::Isometry3d readMatrix(const fs::path& file) {
  std::istringstream text(base::readFile(file));
  text.imbue(std::locale::classic());
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      text >> matrix(row, column);
    }
  }
  if (!text || !matrix.allFinite()) {
    throw base::Error(base::ErrorCode::kInput, "is no 4x4 matrix", file.string());
  }
  Eigen::Isometry3d T_truth_camera = Eigen::Isometry3d::Identity();
  T_truth_camera.linear() = Eigen::Quaterniond(matrix.topLeftCorner<3, 3>()).normalized().toRotationMatrix();
  T_truth_camera.translation() = matrix.topRightCorner<3, 1>();
  return T_truth_camera;
}

/// `frame-NNNNNN.pose.txt` of every frame of a recording.
recording::Trajectory readPoseFiles(const fs::path& folder) {
  const double rate_hz = camera::readCalibration(folder / "camera.toml").rate_hz;
  const auto recorded = recording::openRecording(folder);
  recording::Trajectory truth;
  for (int i = 0; i < recorded->frameCount(); ++i) {
    const std::int64_t stamp_ns = recorded->stampNs(i);
    const std::string digits = std::to_string(std::llround(static_cast<double>(stamp_ns) * 1e-9 * rate_hz));
    const std::string number = std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
    truth.push_back({stamp_ns, readMatrix(folder / ("frame-" + number + ".pose.txt"))});
  }
  return truth;
}

recording::Trajectory readTruth(const fs::path& folder) {
  for (const char* file : {"groundtruth_sfm.txt", "groundtruth.txt"}) {
    if (fs::exists(folder / file)) {
      return recording::readTrajectory(folder / file);
    }
  }
  return readPoseFiles(folder);
}

}  // namespace

const std::vector<std::string>& benchRecordingNames() {
  static const std::vector<std::string> names{"kitchen", "desk-rpy", "household-box", kFiveHz, kLaps};
  return names;
}

fs::path sourceFolder(const std::string& name, const fs::path& data) {
  return data / (name == kFiveHz || name == kLaps ? "kitchen" : name);
}

BenchRecording prepareRecording(const std::string& name, const fs::path& data, const fs::path& scratch) {
  const fs::path source = sourceFolder(name, data);
  BenchRecording recording{name, source, 0, readTruth(source)};
  if (name == kFiveHz) {
    recording.folder = scratch / name;
    writeHalfSize(source, kFiveHzStep, recording.folder);
  } else if (name == kLaps) {
    recording.folder = scratch / name;
    recording.truth = linkLaps(source, kLapCount, recording.truth, recording.folder);
  }
  recording.frames = recording::openRecording(recording.folder)->frameCount();
  return recording;
}

}  // namespace oikos::bench
