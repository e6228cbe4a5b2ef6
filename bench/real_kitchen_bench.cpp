// SPDX-License-Identifier: Apache-2.0
// A real camera put right by real furniture: frames 0-299 of `kitchen` are mapped, homes/kitchen-real stands in that map, and each fifth of
// frames 300-599 is disturbed by 5 to 20 cm and 2 to 10 degrees and refined by the furniture alone; once more with each piece left out.
//   real_kitchen_bench [--pictures FOLDER [--on-white]] [--maps FOLDER] [--verbose] [--set KEY=VALUE]…
// Errors are against groundtruth_sfm.txt, moved into the map by the mapped frames, and against the map's own path of all 600 frames.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "bench/locate/locate_score.h"
#include "bench/locate/mapped_truth.h"
#include "bench/mapping/mapping_run.h"
#include "bench/mapping/recording_variants.h"
#include "core/base/config.h"
#include "core/recording/recording.h"
#include "registration/landmark/landmark_refiner.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"
#include "tracking/localisation/home_landmarks.h"
#include "tracking/localisation/localiser.h"

namespace {

using namespace oikos;
using namespace oikos::bench;
namespace fs = std::filesystem;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kMapped = 300;
constexpr int kAll = 600;
constexpr int kStride = 5;

struct Options {
  fs::path pictures;
  fs::path maps;             ///< empty: mapped into a temporary folder
  bool is_on_white = false;  ///< the pictures: nothing of the recording in them
  bool is_verbose = false;
  std::vector<std::string> settings;
  bool leaves_out = true;
};

/// A frame and where it truly was, in the map, by two witnesses.
struct Asked {
  int frame = 0;
  camera::RgbdFrame images;
  registration::Scan scan;
  Eigen::Isometry3d T_map_camera_true;
  Eigen::Isometry3d T_map_camera_mapped;
  Eigen::Isometry3d T_map_camera_disturbed;
};

/// In x, y and yaw about the camera, as a robot's belief is off.
Eigen::Isometry3d disturbed(const Eigen::Isometry3d& T_map_camera, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double way_m = 0.05 + 0.15 * uniform(random);
  const double direction_rad = 2.0 * std::numbers::pi * uniform(random);
  const double turn_rad = (uniform(random) < 0.5 ? -1.0 : 1.0) * (2.0 + 8.0 * uniform(random)) * kDegree;
  Eigen::Isometry3d T = T_map_camera;
  T.linear() = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()) * T_map_camera.linear();
  T.translation() += way_m * Eigen::Vector3d(std::cos(direction_rad), std::sin(direction_rad), 0.0);
  return T;
}

std::vector<Asked> readAsked(const recording::Recording& recording, const recording::Trajectory& truth,
                             const recording::Trajectory& mapped) {
  std::mt19937_64 random(5);
  std::vector<Asked> asked;
  for (int i = kMapped; i < kAll; i += kStride) {
    Asked a;
    a.frame = i;
    a.images = recording.read(i, recording::Channels::kColor);
    a.scan = registration::makeScan(a.images.depth_m, recording.camera(), {});
    a.T_map_camera_true = poseAt(truth, a.images.stamp_ns);
    a.T_map_camera_mapped = poseAt(mapped, a.images.stamp_ns);
    a.T_map_camera_disturbed = disturbed(a.T_map_camera_true, random);
    asked.push_back(std::move(a));
  }
  return asked;
}

struct Row {
  int refined = 0;
  std::vector<double> before_m, before_deg, after_m, after_deg, to_map_m, to_map_deg;
  std::map<std::string, int> statuses;
};

double degreesBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() / kDegree;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// Outlines of the believed furniture, drawn into the picture.
void drawOutlines(const registration::LandmarkScene& landmarks, const camera::PinholeCamera& camera, const Eigen::Isometry3d& T_map_camera,
                  const cv::Scalar& stroke, cv::Mat& picture) {
  render::ViewConfig config;
  config.with_parts = true;
  const render::View view = render::renderView(landmarks.scene(), render::CameraRays(camera), {T_map_camera, {}}, config);
  for (int v = 0; v + 1 < picture.rows; ++v) {
    for (int u = 0; u + 1 < picture.cols; ++u) {
      const int part = view.part.at<int>(v, u);
      if (view.part.at<int>(v, u + 1) != part || view.part.at<int>(v + 1, u) != part) {
        cv::circle(picture, {u, v}, 1, stroke, cv::FILLED);
      }
    }
  }
}

/// The furniture where the camera truly was (grey), beside each other before (orange) and after (green); over the frame, or on white.
cv::Mat drawOverlay(registration::LandmarkScene& landmarks, const camera::PinholeCamera& camera, const Asked& a,
                    const Eigen::Isometry3d& T_map_camera, bool is_on_white) {
  landmarks.show(std::vector<char>(landmarks.surfaces().size(), 1));
  const cv::Mat paper = is_on_white ? cv::Mat(a.images.color.size(), CV_8UC3, cv::Scalar::all(255)) : a.images.color;
  cv::Mat before = paper.clone();
  drawOutlines(landmarks, camera, a.T_map_camera_true, cv::Scalar::all(170), before);
  cv::Mat after = before.clone();
  drawOutlines(landmarks, camera, a.T_map_camera_disturbed, cv::Scalar(0, 120, 255), before);
  drawOutlines(landmarks, camera, T_map_camera, cv::Scalar(0, 150, 0), after);
  cv::Mat both;
  cv::hconcat(before, after, both);
  return both;
}

/// A line a frame: how far off along the longer row of cupboards and across it, and what each piece was taken for.
void printFrame(const Asked& a, const registration::LandmarkRefinement& refined) {
  const Eigen::Vector3d off_map = refined.T_map_camera.translation() - a.T_map_camera_true.translation();
  const Eigen::Vector3d before_map = a.T_map_camera_disturbed.translation() - a.T_map_camera_true.translation();
  const Eigen::Vector3d along(std::cos(72.36 * kDegree), std::sin(72.36 * kDegree), 0.0);
  const Eigen::Vector3d across(-along.y(), along.x(), 0.0);
  std::printf(
      "%d %s: before %.1f along %.1f across %.1f deg, after %.1f along %.1f across %.2f deg, overlap %.2f, sigma %.1f along, rounds %d;",
      a.frame, std::string(base::toString(refined.status)).c_str(), 100.0 * before_map.dot(along), 100.0 * before_map.dot(across),
      degreesBetween(a.T_map_camera_disturbed, a.T_map_camera_true), 100.0 * off_map.dot(along), 100.0 * off_map.dot(across),
      degreesBetween(refined.T_map_camera, a.T_map_camera_true), refined.overlap,
      100.0 * std::sqrt(along.dot(refined.T_map_camera.linear() * refined.covariance.topLeftCorner<3, 3>() *
                                  refined.T_map_camera.linear().transpose() * along)),
      refined.rounds);
  for (const std::string& name : refined.unobserved) {
    std::printf(" unobserved %s", name.c_str());
  }
  for (const registration::LandmarkContribution& piece : refined.landmarks) {
    std::printf(" %s %s %d/%d %.2f", piece.id.c_str(), std::string(base::toString(piece.verdict)).c_str(), piece.agreeing, piece.pixels,
                piece.contradiction);
    for (const std::string& part : piece.dropped_parts) {
      std::printf(" -%s", part.c_str());
    }
  }
  std::printf("\n");
}

Row refineAll(registration::LandmarkScene& landmarks, const std::vector<Asked>& asked, const registration::LandmarkConfig& config,
              const camera::PinholeCamera& camera, const Options& options) {
  Row row;
  for (const Asked& a : asked) {
    const registration::CameraPrior prior{a.T_map_camera_disturbed, Eigen::Vector3d::Zero(), 0.12, 6.0 * kDegree};
    const registration::LandmarkRefinement refined = registration::refineByLandmarks(landmarks, a.scan, prior, config);
    ++row.statuses[std::string(base::toString(refined.status))];
    if (options.is_verbose) {
      printFrame(a, refined);
    }
    row.before_m.push_back((a.T_map_camera_disturbed.translation() - a.T_map_camera_true.translation()).norm());
    row.before_deg.push_back(degreesBetween(a.T_map_camera_disturbed, a.T_map_camera_true));
    if (refined.status == registration::RefinementStatus::kRefined) {
      ++row.refined;
      row.after_m.push_back((refined.T_map_camera.translation() - a.T_map_camera_true.translation()).norm());
      row.after_deg.push_back(degreesBetween(refined.T_map_camera, a.T_map_camera_true));
      row.to_map_m.push_back((refined.T_map_camera.translation() - a.T_map_camera_mapped.translation()).norm());
      row.to_map_deg.push_back(degreesBetween(refined.T_map_camera, a.T_map_camera_mapped));
    }
    if (!options.pictures.empty()) {
      fs::create_directories(options.pictures);
      cv::imwrite((options.pictures / (std::to_string(a.frame) + ".png")).string(),
                  drawOverlay(landmarks, camera, a, refined.T_map_camera, options.is_on_white));
    }
  }
  return row;
}

void print(const std::string& name, const Row& row) {
  const auto p95 = [](const std::vector<double>& values) { return values.empty() ? 0.0 : quantile(values, 0.95); };
  std::printf("| %s | %d of %zu | %.1f, %.1f | %.2f, %.2f | %.2f, %.2f | %.2f, %.2f |", name.c_str(), row.refined, row.before_m.size(),
              100.0 * mean(row.before_m), mean(row.before_deg), 100.0 * mean(row.after_m), mean(row.after_deg), 100.0 * p95(row.after_m),
              p95(row.after_deg), 100.0 * mean(row.to_map_m), mean(row.to_map_deg));
  for (const auto& [status, count] : row.statuses) {
    std::printf(" %s %d", status.c_str(), count);
  }
  std::printf(" |\n");
}

registration::LandmarkScene landmarksWithout(const semantic::Home& home, const fs::path& folder, tracking::LandmarkChoice choice,
                                             const std::string& left_out) {
  choice.without.push_back(left_out);
  return tracking::makeLandmarks(home, folder, choice);
}

/// The frames with the camera as it was measured for homes/kitchen-real.
void linkWithCamera(const fs::path& data, int end, const fs::path& folder) {
  linkFrames(data, 0, end, folder);
  fs::remove(folder / "camera.toml");
  fs::copy_file(fs::path(OIKOS_KITCHEN_HOME) / "camera.toml", folder / "camera.toml");
}

void run(const Options& options, const fs::path& data) {
  const test::TemporaryFolder scratch;
  const MapCommand command{OIKOS_BUILT_BINARY, 0, {}};
  const fs::path maps = options.maps.empty() ? scratch.path() : options.maps;
  if (!fs::exists(maps / "all/map/trajectory.txt")) {
    linkWithCamera(data, kMapped, maps / "mapped");
    linkWithCamera(data, kAll, maps / "frames");
    (void)mapRecording(command, maps / "mapped", maps / "home");
    (void)mapRecording(command, maps / "frames", maps / "all");
  }
  const recording::Trajectory mapped = recording::readTrajectory(maps / "home/map/trajectory.txt");
  const recording::Trajectory truth = truthInMap(mapped, recording::readTrajectory(data / "groundtruth_sfm.txt"));
  const recording::Trajectory path = truthInMap(mapped, recording::readTrajectory(maps / "all/map/trajectory.txt"));
  const auto recording = recording::openRecording(maps / "frames");
  const std::vector<Asked> asked = readAsked(*recording, truth, path);

  tracking::LocaliseConfig config;
  config.furniture = {.has_shiftable = true, .has_walls = true};  // their places were measured in the map of an hour before,
  config.landmarks.align.surface_sigma_m = 0.015;                 // which has them to a centimetre or two
  config.landmarks.check.surface_sigma_m = 0.02;
  for (const std::string& setting : options.settings) {
    base::assignFields(base::listFields(config), {{}, {base::parseSetting(setting)}});
  }
  const fs::path folder = OIKOS_KITCHEN_HOME;
  const semantic::Home home = semantic::readHome(folder / "home.xml").home;
  std::printf(
      "| left out | refined | before: mean cm, deg | after: mean cm, deg | 95 %% cm, deg | to the map's own path: mean cm, deg | "
      "|\n|---|---|---|---|---|---|---|\n");
  registration::LandmarkScene all = tracking::makeLandmarks(home, folder, config.furniture);
  print("nothing", refineAll(all, asked, config.landmarks, recording->camera(), options));
  Options without_pictures = options;
  without_pictures.pictures.clear();
  for (const std::string& id : options.leaves_out ? all.ids() : std::vector<std::string>()) {
    registration::LandmarkScene fewer = landmarksWithout(home, folder, config.furniture, id);
    print("`" + id + "`", refineAll(fewer, asked, config.landmarks, recording->camera(), without_pictures));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"A real camera refined by the furniture of homes/kitchen-real"};
  Options options;
  app.add_option("--pictures", options.pictures, "folder for the furniture's outlines over each frame, before and after");
  app.add_flag("--on-white", options.is_on_white, "outlines alone, nothing of the recording");
  app.add_option("--maps", options.maps, "keep the maps there, and take them from there");
  app.add_flag("--verbose", options.is_verbose, "a line a frame");
  app.add_option("--set", options.settings, "KEY=VALUE of the landmarks' configuration; may be repeated")->allow_extra_args(false);
  app.add_flag("!--all-furniture-only", options.leaves_out, "no rows with a piece left out");
  CLI11_PARSE(app, argc, argv);
  const char* data = std::getenv("OIKOS_DATA");
  if (data == nullptr) {
    std::fprintf(stderr, "real_kitchen_bench: OIKOS_DATA is not set: skipped\n");
    return 0;
  }
  run(options, fs::path(data) / "kitchen");
  return 0;
}
