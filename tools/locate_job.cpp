// SPDX-License-Identifier: Apache-2.0
#include "tools/locate_job.h"

#include <chrono>
#include <memory>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/recording/frame_stream.h"
#include "core/recording/trajectory.h"
#include "mapping/mapper.h"
#include "mapping/odometry/wheel_odometry.h"
#include "mapping/relocalise/relocaliser.h"
#include "mapping/relocalise/saved_map.h"
#include "semantic/history/home_state.h"
#include "tools/terminal_progress.h"
#include "tracking/localisation/home_landmarks.h"
#include "tracking/localisation/pose_prior.h"

namespace oikos::tools {

namespace {

namespace fs = std::filesystem;

/// Features and landmarks are looked for as when the map was made, where nothing else is said.
tracking::LocaliseConfig configOf(const LocateJob& job, const GlobalOptions& global) {
  tracking::LocaliseConfig config;
  if (const fs::path map_config = job.home / "map" / "config.toml"; fs::exists(map_config)) {
    const auto map = base::loadConfig<mapping::MapConfig>({map_config, {}});
    config.map.features = map.front_end.features;
    config.map.follower = map.front_end.follower;
    config.map.pyramid_levels = map.front_end.pyramid_levels;
  }
  config.landmarks.align.threads = global.threads;
  base::ConfigLayers layers{global.config, {}};
  for (const std::string& text : job.settings) {
    layers.settings.push_back(base::parseSetting(text));
  }
  const base::ConfigOrigins origins = base::assignFields(base::listFields(config), layers);
  base::throwIfInvalid(base::validateConfig(config), origins);
  return config;
}

/// All that a localiser works with, opened.
class Workshop {
 public:
  Workshop(const LocateJob& job, const GlobalOptions& global) : job_(job), config_(configOf(job, global)) {
    openMap(static_cast<std::uint64_t>(global.seed));
    openFurniture();
    openPrior();
    odometry_ = mapping::WheelOdometry(job.T_base_camera ? job.recording.findOdometry() : std::nullopt, job.T_base_camera);
  }

  [[nodiscard]] tracking::Localiser makeLocaliser() {
    tracking::LocaliserTools tools{job_.recording.camera()};
    tools.relocaliser = relocaliser_.get();
    tools.furniture = furniture_.get();
    tools.only = only_;
    tools.T_base_camera = job_.T_base_camera.value_or(Eigen::Isometry3d::Identity());
    tools.prior = prior_ ? &*prior_ : nullptr;
    tools.odometry = &odometry_;
    return {tools, config_};
  }

 private:
  void openMap(std::uint64_t seed) {
    const fs::path file = job_.home / "map" / "keyframes.sqlite";
    if (fs::exists(file)) {
      map_ = std::make_unique<mapping::SavedMap>(file, mapping::SavedMapConfig{config_.map.pyramid_levels});
      mapping::requireSameCamera(map_->camera(), job_.recording.camera(), file);
      relocaliser_ = std::make_unique<mapping::Relocaliser>(*map_, config_.map, seed);
    } else if (job_.prior.empty() && !job_.from) {
      throw base::Error(base::ErrorCode::kUsage, "no such map: make it with oikos map, or say where the robot was with --prior or --from",
                        file.string());
    }
  }

  void openFurniture() {
    const fs::path file = job_.home / "home.xml";
    if (job_.has_landmarks && (fs::exists(file) || !job_.object.empty())) {
      const semantic::Home home = semantic::loadHome(job_.home);
      auto furniture = std::make_unique<registration::LandmarkScene>(tracking::makeLandmarks(home, job_.home, config_.furniture));
      if (!job_.object.empty()) {
        only_ = tracking::getLandmark(*furniture, home, job_.object);
      }
      if (!furniture->ids().empty()) {
        furniture_ = std::move(furniture);
      }
    }
    if (!furniture_ && !map_) {
      throw base::Error(base::ErrorCode::kUsage, "there is neither a map nor fixed furniture to find the camera by", job_.home.string());
    }
  }

  void openPrior() {
    if (job_.prior.empty() && !job_.from) {
      return;
    }
    if (!job_.T_base_camera) {
      throw base::Error(base::ErrorCode::kInput,
                        "--prior and --from say where the robot is, but not where its camera is: T_base_camera is missing in camera.toml, "
                        "or give --robot");
    }
    if (job_.from) {
      prior_.emplace(job_.from->T_map_base(), job_.recording.stampNs(0), *job_.T_base_camera);
    } else {
      prior_.emplace(recording::readTrajectory(job_.prior), *job_.T_base_camera);
    }
  }

  const LocateJob& job_;
  tracking::LocaliseConfig config_;
  std::unique_ptr<mapping::SavedMap> map_;
  std::unique_ptr<mapping::Relocaliser> relocaliser_;
  std::unique_ptr<registration::LandmarkScene> furniture_;
  std::optional<int> only_;
  std::optional<tracking::PosePrior> prior_;
  mapping::WheelOdometry odometry_;
};

}  // namespace

Located locateRecording(const LocateJob& job, const Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  Workshop workshop(job, session.options);
  tracking::Localiser localiser = workshop.makeLocaliser();
  Located located;
  located.opening_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  TerminalProgress progress(session.options);
  const base::ProgressSink sink = progress.sink();
  recording::FrameStream stream(job.recording, {.capacity = 4});
  while (const auto frame = stream.next()) {
    located.poses.push_back(localiser.add(*frame));
    base::reportProgress(sink, {"locating", stream.statistics().read + stream.statistics().unreadable, stream.statistics().listed});
  }
  located.unreadable = stream.statistics().unreadable;
  return located;
}

}  // namespace oikos::tools
