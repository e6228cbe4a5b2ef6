// SPDX-License-Identifier: Apache-2.0
#include "core/tags/tag_path.h"

#include <algorithm>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/recording/image_file.h"
#include "core/recording/listing.h"
#include "core/tags/board_pose.h"
#include "core/tags/tag_setup.h"

namespace oikos::tags {

namespace {

namespace fs = std::filesystem;

BoardCamera cameraOf(const fs::path& file) {
  const camera::Calibration calibration = camera::readCalibration(file);
  return {calibration.color, calibration.distortion};
}

cv::Mat readPicture(const fs::path& file, const camera::PinholeCamera& camera) {
  cv::Mat gray = recording::readGrayImage(file);
  if (gray.cols != camera.width || gray.rows != camera.height) {
    throw base::Error(base::ErrorCode::kInput,
                      "is " + std::to_string(gray.cols) + "x" + std::to_string(gray.rows) + " pixels, but camera.toml says " +
                          std::to_string(camera.width) + "x" + std::to_string(camera.height),
                      file.string());
  }
  return gray;
}

/// Looks at one picture after another.
class PictureReader {
 public:
  PictureReader(const TagSetup& setup, const BoardCamera& camera, const TagPathConfig& config)
      : board_(setup.board),
        camera_(camera),
        config_(config),
        T_map_camera_(poseOf(setup.T_map_camera)),
        T_board_base_(poseOf(setup.T_base_board).inverse()) {}

  [[nodiscard]] TagPicture look(const recording::ListedImage& image, const TagDetector& detector) const {
    TagPicture picture;
    picture.stamp_ns = image.stamp_ns;
    const std::vector<TagDetection> detections = detector.detect(readPicture(image.file, camera_.pinhole));
    picture.tags = static_cast<int>(
        std::count_if(detections.begin(), detections.end(), [&](const auto& tag) { return board_.findCorners(tag.id).has_value(); }));
    if (picture.tags < board_.tagCount()) {
      return picture;
    }
    const std::optional<BoardPose> pose = estimateBoardPose(board_, detections, camera_);
    picture.rms_px = pose ? pose->rms_px : 0.0;
    if (!pose || pose->rms_px > config_.max_rms_px) {
      picture.status = TagPictureStatus::kBadFit;
      return picture;
    }
    picture.distance_m = pose->T_camera_board.translation().norm();
    picture.status = picture.distance_m <= config_.max_distance_m ? TagPictureStatus::kKept : TagPictureStatus::kTooFar;
    picture.T_map_base = T_map_camera_ * pose->T_camera_board * T_board_base_;
    return picture;
  }

 private:
  TagBoard board_;
  BoardCamera camera_;
  TagPathConfig config_;
  Eigen::Isometry3d T_map_camera_;
  Eigen::Isometry3d T_board_base_;
};

}  // namespace

std::vector<std::string> TagPathConfig::validate() const {
  return base::ConfigRules()
      .greater("max_distance_m", max_distance_m, 0.0)
      .greater("max_rms_px", max_rms_px, 0.0)
      .atLeast("threads", threads, 1)
      .messages();
}

std::vector<TagPicture> readTagPath(const fs::path& folder, const TagPathConfig& config, const base::ProgressSink& progress) {
  const BoardCamera camera = cameraOf(folder / "camera.toml");
  const PictureReader reader(readTagSetup(folder / "tags.toml"), camera, config);
  const std::vector<recording::ListedImage> images = recording::listTumColor(folder);
  const auto count = static_cast<int>(images.size());
  std::vector<TagPicture> pictures(images.size());
  const int workers = std::min(config.threads, count);
  base::parallelFor(workers, workers, [&](int worker) {
    const TagDetector detector;  // one each: it is not thread-safe
    for (int i = worker; i < count; i += workers) {
      pictures[static_cast<std::size_t>(i)] = reader.look(images[static_cast<std::size_t>(i)], detector);
      if (worker == 0) {
        base::reportProgress(progress, {"reading tags", i + 1, count});
      }
    }
  });
  return pictures;
}

recording::Trajectory keptPath(const std::vector<TagPicture>& pictures) {
  recording::Trajectory path;
  for (const TagPicture& picture : pictures) {
    if (picture.status == TagPictureStatus::kKept) {
      path.push_back({picture.stamp_ns, picture.T_map_base});
    }
  }
  return path;
}

}  // namespace oikos::tags
