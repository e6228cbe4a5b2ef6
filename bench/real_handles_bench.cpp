// SPDX-License-Identifier: Apache-2.0
// Handles of real base cabinets: frames 0-299 of `kitchen` are mapped, the cabinets of homes/kitchen-real/doors.xml stand in that map, and
// in each sixth of them the handles of its cabinets are found and fused. There is no truth: what is told is how far frames agree.
//   real_handles_bench [--pictures FOLDER] [--maps FOLDER] [--stride N] [--as-believed] [--verbose]
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "bench/locate/mapped_truth.h"
#include "bench/mapping/mapping_run.h"
#include "bench/mapping/recording_variants.h"
#include "core/recording/recording.h"
#include "registration/articulated/articulated_registration.h"
#include "registration/handles/handle_finder.h"
#include "registration/handles/handle_fusion.h"
#include "semantic/model/home_models.h"
#include "semantic/xml/home_reader.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;
using namespace oikos::bench;
namespace fs = std::filesystem;
constexpr int kMapped = 300;

struct Options {
  fs::path pictures;
  fs::path maps;  ///< empty: mapped into a temporary folder
  int stride = 6;
  bool is_verbose = false;
  bool as_believed = false;  ///< doors where the home has them, not where each frame registers them
};

/// One cabinet with what is found of its handle.
struct Cabinet {
  std::string id;
  model::ArticulatedModel model;
  registration::Standing believed;
  registration::ArticulatedRegistration registration;
  registration::HandleFinder finder;
  registration::HandleFusion on_part{{}};
  registration::HandleFusion in_map{{}};
  std::map<std::string, int> statuses;

  Cabinet(const semantic::LargeObject& object, model::ArticulatedModel made)
      : id(object.id.value),
        model(std::move(made)),
        believed{object.T_map_object.toIsometry(), semantic::jointValues(object)},
        registration(model, {}),
        finder(model, {}) {}

  [[nodiscard]] Eigen::Isometry3d T_map_believed(int part) const {
    return believed.T_map_model * model::Kinematics(model).solve(believed.joint_values)[static_cast<std::size_t>(part)];
  }
};

/// In a deque, as a registration must not be moved.
std::deque<Cabinet> makeCabinets(const semantic::Home& home, const fs::path& folder) {
  semantic::ModelMaker maker(folder);
  std::deque<Cabinet> cabinets;
  for (const semantic::Room& room : home.rooms) {
    for (const semantic::LargeObject& object : room.objects) {
      if (object.articulation && !object.articulation->handles.empty()) {
        cabinets.emplace_back(object, maker.make(object));
      }
    }
  }
  return cabinets;
}

void drawLine(const Eigen::Vector3d& from_map, const Eigen::Vector3d& to_map, const registration::DepthView& view, const cv::Scalar& stroke,
              int width, cv::Mat& picture) {
  const auto pixel = [&](const Eigen::Vector3d& at_map) {
    const Eigen::Vector2d at = view.camera.project(view.T_map_camera.inverse() * at_map);
    return cv::Point2d(at.x(), at.y());
  };
  cv::line(picture, pixel(from_map), pixel(to_map), stroke, width, cv::LINE_AA);
}

/// The grip as a line, and 5 cm of its normal.
void drawHandle(const Eigen::Isometry3d& T_map_handle, double length_m, const registration::DepthView& view, const cv::Scalar& stroke,
                int width, cv::Mat& picture) {
  const Eigen::Vector3d half = 0.5 * length_m * T_map_handle.linear().col(2);
  if ((view.T_map_camera.inverse() * T_map_handle.translation()).z() < 0.2) {
    return;
  }
  drawLine(T_map_handle.translation() - half, T_map_handle.translation() + half, view, stroke, width, picture);
  drawLine(T_map_handle.translation(), T_map_handle * Eigen::Vector3d(0.05, 0.0, 0.0), view, stroke, width, picture);
}

void printEstimate(int frame, const std::string& id, const registration::JointEstimate& door, const registration::HandleEstimate& handle,
                   const model::ModelHandle& believed) {
  const Eigen::Vector3d off_m = (believed.T_part_handle.inverse() * handle.T_part_handle).translation();
  std::printf("%3d %s door %s %.1f deg, handle %s off %5.1f %5.1f %5.1f mm (sigma %.1f %.1f %.1f), %.0f mm long, gain %.0f, points %d\n",
              frame, id.c_str(), std::string(base::toString(door.status)).c_str(), door.value * 57.29578,
              std::string(base::toString(handle.status)).c_str(), 1000.0 * off_m.x(), 1000.0 * off_m.y(), 1000.0 * off_m.z(),
              1000.0 * std::sqrt(handle.covariance(0, 0)), 1000.0 * std::sqrt(handle.covariance(1, 1)),
              1000.0 * std::sqrt(handle.covariance(2, 2)), 1000.0 * handle.length_m, handle.gain, handle.points);
}

/// All handles of one frame, and the picture of it: orange as the home has them, green as they were found.
cv::Mat findInFrame(int frame, const registration::DepthView& view, const cv::Mat& color, std::deque<Cabinet>& cabinets,
                    const Options& options) {
  cv::Mat picture = color.clone();
  const registration::Scan scan = registration::makeScan(view.depth_m, view.camera, {});
  for (Cabinet& cabinet : cabinets) {
    const registration::ArticulatedResult registered = cabinet.registration.run(scan, view.T_map_camera, cabinet.believed);
    for (const registration::JointEstimate& door : registered.joints) {
      if (door.status != registration::JointStatus::kFound) {
        ++cabinet.statuses["door " + std::string(base::toString(door.status))];
        continue;
      }
      const int part = cabinet.model.joints[static_cast<std::size_t>(door.joint)].child;
      const Eigen::Isometry3d T_map_part = options.as_believed ? cabinet.T_map_believed(part) : door.T_map_part;
      for (registration::HandleEstimate& handle : cabinet.finder.find(view, part, T_map_part)) {
        const model::ModelHandle& believed = cabinet.model.handles[static_cast<std::size_t>(handle.handle)];
        ++cabinet.statuses[std::string(base::toString(handle.status))];
        if (options.is_verbose) {
          printEstimate(frame, cabinet.id, door, handle, believed);
        }
        drawHandle(T_map_part * believed.T_part_handle, believed.length_m.value_or(0.1), view, {0, 160, 255}, 1, picture);
        if (handle.isSeen()) {
          drawHandle(handle.T_map_handle, handle.length_m, view, {0, 255, 0}, 2, picture);
        }
        cabinet.on_part.add(handle);
        handle.T_part_handle = handle.T_map_handle;
        handle.evidence.T_part_believed = T_map_part * handle.evidence.T_part_believed;
        cabinet.in_map.add(handle);
      }
    }
  }
  return picture;
}

void report(const Cabinet& cabinet) {
  const registration::FusedHandle in_map = cabinet.in_map.result();
  const registration::FusedHandle on_part = cabinet.on_part.result();
  const Eigen::Isometry3d T_map_believed = cabinet.T_map_believed(1) * cabinet.model.handles.front().T_part_handle;
  const Eigen::Vector3d off_m = (T_map_believed.inverse() * in_map.T_part_handle).translation();
  const Eigen::Vector3d sigma_m = in_map.covariance.diagonal().head<3>().cwiseSqrt();
  std::printf("| `%s` | %s | %s, %.0f | %d of %d | %d | %.1f, %.2f | %.1f, %.2f | %.0f, %.0f, %.0f | %.1f, %.1f, %.1f | %.0f |",
              cabinet.id.c_str(), std::string(base::toString(in_map.status)).c_str(), in_map.is_summed ? "all together" : "single images",
              in_map.gain, in_map.seen, in_map.images, in_map.outliers, 1000.0 * in_map.spread_m, in_map.spread_deg,
              1000.0 * on_part.spread_m, on_part.spread_deg, 1000.0 * off_m.x(), 1000.0 * off_m.y(), 1000.0 * off_m.z(),
              1000.0 * sigma_m.x(), 1000.0 * sigma_m.y(), 1000.0 * sigma_m.z(), 1000.0 * in_map.length_m);
  for (const auto& [status, count] : cabinet.statuses) {
    std::printf(" %s %d", status.c_str(), count);
  }
  std::printf(" |\n");
}

/// The frames with the camera as it was measured for homes/kitchen-real.
void linkWithCamera(const fs::path& data, const fs::path& folder) {
  linkFrames(data, 0, kMapped, folder);
  fs::remove(folder / "camera.toml");
  fs::copy_file(fs::path(OIKOS_KITCHEN_HOME) / "camera.toml", folder / "camera.toml");
}

void run(const Options& options, const fs::path& data) {
  const test::TemporaryFolder scratch;
  const fs::path maps = options.maps.empty() ? scratch.path() : options.maps;
  if (!fs::exists(maps / "home/map/trajectory.txt")) {
    linkWithCamera(data, maps / "mapped");
    (void)mapRecording({OIKOS_BUILT_BINARY, 0, {}}, maps / "mapped", maps / "home");
  }
  const recording::Trajectory mapped = recording::readTrajectory(maps / "home/map/trajectory.txt");
  const auto recording = recording::openRecording(maps / "mapped");
  const fs::path folder = OIKOS_KITCHEN_HOME;
  std::deque<Cabinet> cabinets = makeCabinets(semantic::readHome(folder / "doors.xml").home, folder);
  std::vector<std::pair<int, cv::Mat>> pictures;
  std::vector<registration::DepthView> views;
  for (int i = 0; i < kMapped; i += options.stride) {
    const camera::RgbdFrame images = recording->read(i, recording::Channels::kColor);
    views.push_back({images.depth_m, recording->camera(), poseAt(mapped, images.stamp_ns)});
    pictures.emplace_back(i, findInFrame(i, views.back(), images.color, cabinets, options));
  }
  std::printf(
      "| cabinet | handle | by, gain | seen | outliers | spread in map mm, deg | on the registered door mm, deg | from where the home has "
      "it: out, "
      "across, "
      "along mm | sigma mm | length mm | single frames |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Cabinet& cabinet : cabinets) {
    report(cabinet);
  }
  for (std::size_t i = 0; i < pictures.size() && !options.pictures.empty(); ++i) {
    fs::create_directories(options.pictures);
    for (const Cabinet& cabinet : cabinets) {
      const registration::FusedHandle fused = cabinet.in_map.result();
      if (fused.status == registration::HandleStatus::kFound || fused.status == registration::HandleStatus::kPartly) {
        drawHandle(fused.T_part_handle, fused.length_m, views[i], {255, 255, 0}, 1, pictures[i].second);
      }
    }
    cv::imwrite((options.pictures / (std::to_string(pictures[i].first) + ".png")).string(), pictures[i].second);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Handles of the real cabinets of homes/kitchen-real"};
  Options options;
  app.add_option("--pictures", options.pictures,
                 "folder for each frame with its handles: orange as the home has them, green as found in it, cyan as fused");
  app.add_option("--maps", options.maps, "keep the map there, and take it from there");
  app.add_option("--stride", options.stride, "each so many-th frame")->check(CLI::PositiveNumber);
  app.add_flag("--as-believed", options.as_believed, "doors stand where the home has them, not where each frame registers them");
  app.add_flag("--verbose", options.is_verbose, "a line for each handle in each frame");
  CLI11_PARSE(app, argc, argv);
  const char* data = std::getenv("OIKOS_DATA");
  if (data == nullptr) {
    std::fprintf(stderr, "real_handles_bench: OIKOS_DATA is not set: skipped\n");
    return 0;
  }
  run(options, fs::path(data) / "kitchen");
  return 0;
}
