// SPDX-License-Identifier: Apache-2.0
// How well a camera is found again in a saved map: frames 0-399 of `kitchen` are mapped, frames 400-599 asked, each on its own and tracked.
//   locate_bench [--home HOME] [--set KEY=VALUE]…
// Errors are against groundtruth_sfm.txt, moved into the map by the rigid motion that aligns the mapped frames; nothing of the asked ones
// is aligned. OIKOS_DATA is the folder of the recordings.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/locate/locate_score.h"
#include "bench/locate/mapped_truth.h"
#include "bench/mapping/mapping_run.h"
#include "bench/mapping/recording_variants.h"
#include "core/base/config.h"
#include "core/recording/recording.h"
#include "core/recording/trajectory.h"
#include "mapping/graph/keyframe_reader.h"
#include "mapping/graph/keyframe_store.h"
#include "mapping/relocalise/map_tracker.h"
#include "mapping/relocalise/relocaliser.h"
#include "mapping/relocalise/saved_map.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace oikos;
using namespace oikos::bench;
namespace fs = std::filesystem;

constexpr int kMapped = 400;
constexpr int kAll = 600;

struct Options {
  fs::path home;  ///< empty: mapped here
  std::vector<std::string> settings;
};

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What one would have by knowing the best mapped frame and nothing more: the nearest, a degree as far as a centimetre.
FrameScore scoreNearest(const recording::Trajectory& mapped, const Eigen::Isometry3d& T_map_camera) {
  FrameScore best;
  for (const recording::StampedPose& pose : mapped) {
    const FrameScore score = scoreFrame(pose.T_map_camera, T_map_camera, geometry::Matrix6d::Identity());
    if (!best.found || 100.0 * score.error_m + score.error_deg < 100.0 * best.error_m + best.error_deg) {
      best = score;
    }
  }
  return best;
}

FrameScore scored(const mapping::LocateResult& result, const Eigen::Isometry3d& T_map_camera, double latency_s) {
  FrameScore score = scoreFrame(result.T_map_camera, T_map_camera, result.covariance);
  score.found = result.found();
  score.latency_s = latency_s;
  return score;
}

void askAll(const mapping::Relocaliser& relocaliser, const recording::Recording& asked, const recording::Trajectory& truth,
            const recording::Trajectory& mapped) {
  std::vector<FrameScore> alone;
  std::vector<FrameScore> tracked;
  std::vector<FrameScore> nearest;
  mapping::MapTracker tracker(relocaliser);
  for (int i = 0; i < asked.frameCount(); ++i) {
    const camera::RgbdFrame frame = asked.read(i, recording::Channels::kGray);
    const Eigen::Isometry3d& T_map_camera = poseAt(truth, frame.stamp_ns);
    auto begin = std::chrono::steady_clock::now();
    const mapping::ImagePyramid pyramid(frame.gray, relocaliser.config().pyramid_levels);
    const mapping::LocateResult found = relocaliser.find({frame, pyramid});
    alone.push_back(scored(found, T_map_camera, secondsSince(begin)));
    begin = std::chrono::steady_clock::now();
    const mapping::LocateResult followed = tracker.add(frame);
    tracked.push_back(scored(followed, T_map_camera, secondsSince(begin)));
    nearest.push_back(scoreNearest(mapped, T_map_camera));
  }
  printScoreHead();
  printFrameScores("each on its own", alone);
  printFrameScores("tracked", tracked);
  printFrameScores("nearest mapped frame", nearest);
}

/// A store of so many keyframes, the map's own over and over.
void timeOpening(const fs::path& file, int keyframes, const fs::path& scratch) {
  const mapping::KeyframeStore store = mapping::readKeyframeStore(file);
  mapping::KeyframeStoreWriter writer(scratch / "many.sqlite", store.camera);
  for (int id = 0; id < keyframes; ++id) {
    mapping::StoredKeyframe keyframe = store.keyframes[static_cast<std::size_t>(id) % store.keyframes.size()];
    keyframe.id = id;
    writer.add(keyframe, mapping::encodePictures(keyframe.color, keyframe.depth_m));
  }
  writer.commit();
  const auto begin = std::chrono::steady_clock::now();
  const mapping::SavedMap map(scratch / "many.sqlite");
  std::printf("%d keyframes opened in %.3f s\n", map.keyframeCount(), secondsSince(begin));
}

void run(const Options& options, const fs::path& data) {
  const test::TemporaryFolder scratch;
  const fs::path source = data / "kitchen";
  fs::path home = options.home;
  if (home.empty()) {
    home = scratch.path() / "home";
    linkFrames(source, 0, kMapped, scratch.path() / "mapped");
    (void)mapRecording({OIKOS_BUILT_BINARY, 0, {}}, scratch.path() / "mapped", home);
  }
  linkFrames(source, kMapped, kAll, scratch.path() / "asked");
  base::ConfigLayers layers;
  for (const std::string& text : options.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  const auto config = base::loadConfig<mapping::RelocaliseConfig>(layers);
  const auto begin = std::chrono::steady_clock::now();
  const mapping::SavedMap map(home / "map" / "keyframes.sqlite");
  std::printf("%d keyframes opened in %.3f s\n", map.keyframeCount(), secondsSince(begin));
  const auto mapped = recording::readTrajectory(home / "map" / "trajectory.txt");
  const auto truth = truthInMap(mapped, recording::readTrajectory(source / "groundtruth_sfm.txt"));
  askAll(mapping::Relocaliser(map, config, 0), *recording::openRecording(scratch.path() / "asked"), truth, mapped);
  timeOpening(home / "map" / "keyframes.sqlite", 500, scratch.path());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How well a camera is found again in a saved map", "locate_bench");
  Options options;
  app.add_option("--home", options.home, "a home whose map is of frames 0-399 of kitchen; default: mapped here");
  app.add_option("--set", options.settings, "KEY=VALUE of the relocalisation; may be repeated");
  try {
    app.parse(argc, argv);
    const char* const data = std::getenv("OIKOS_DATA");
    if (data == nullptr || !fs::is_directory(fs::path(data) / "kitchen")) {
      std::printf("SKIPPED: locate_bench needs real recordings: set OIKOS_DATA to a folder with kitchen\n");
      return 0;
    }
    run(options, data);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "locate_bench: %s\n", error.what());
    return 1;
  }
}
