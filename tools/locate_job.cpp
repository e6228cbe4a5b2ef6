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
#include "tools/terminal_progress.h"
#include "tracking/localisation/home_landmarks.h"
#include "tracking/localisation/pose_prior.h"

namespace oikos::tools {

namespace fs = std::filesystem;

struct LocateWorkshop::Tools {
  std::unique_ptr<mapping::SavedMap> map;
  std::unique_ptr<mapping::Relocaliser> relocaliser;
  std::unique_ptr<registration::LandmarkScene> furniture;
  std::optional<int> only;
  std::optional<tracking::PosePrior> prior;
  mapping::WheelOdometry odometry;
};

tracking::LocaliseConfig localiseConfigOf(const fs::path& home, int threads) {
  tracking::LocaliseConfig config;
  if (const fs::path map_config = home / "map" / "config.toml"; fs::exists(map_config)) {
    const auto map = base::loadConfig<mapping::MapConfig>({map_config, {}});
    config.map.features = map.front_end.features;
    config.map.follower = map.front_end.follower;
    config.map.pyramid_levels = map.front_end.pyramid_levels;
  }
  config.landmarks.align.threads = threads;
  return config;
}

LocateWorkshop::LocateWorkshop(const LocateJob& job) : job_(job), tools_(std::make_unique<Tools>()) {
  openMap();
  openFurniture();
  openPrior();
  tools_->odometry = mapping::WheelOdometry(job.T_base_camera ? job.recording.findOdometry() : std::nullopt, job.T_base_camera);
}

LocateWorkshop::~LocateWorkshop() = default;

tracking::Localiser LocateWorkshop::makeLocaliser() const {
  tracking::LocaliserTools tools{job_.recording.camera()};
  tools.relocaliser = tools_->relocaliser.get();
  tools.furniture = tools_->furniture.get();
  tools.only = tools_->only;
  tools.T_base_camera = job_.T_base_camera.value_or(Eigen::Isometry3d::Identity());
  tools.prior = tools_->prior ? &*tools_->prior : nullptr;
  tools.odometry = &tools_->odometry;
  return {tools, job_.config};
}

void LocateWorkshop::openMap() {
  const fs::path file = job_.home / "map" / "keyframes.sqlite";
  if (fs::exists(file)) {
    tools_->map = std::make_unique<mapping::SavedMap>(file, mapping::SavedMapConfig{job_.config.map.pyramid_levels});
    mapping::requireSameCamera(tools_->map->camera(), job_.recording.camera(), file);
    tools_->relocaliser = std::make_unique<mapping::Relocaliser>(*tools_->map, job_.config.map, static_cast<std::uint64_t>(job_.seed));
  } else if (job_.prior.empty() && !job_.from) {
    throw base::Error(base::ErrorCode::kUsage, "no such map: make it with oikos map, or say where the robot was with --prior or --from",
                      file.string());
  }
}

void LocateWorkshop::openFurniture() {
  if (job_.known != nullptr) {
    auto furniture = std::make_unique<registration::LandmarkScene>(tracking::makeLandmarks(*job_.known, job_.home, job_.config.furniture));
    if (!job_.object.empty()) {
      tools_->only = tracking::getLandmark(*furniture, *job_.known, job_.object);
    }
    if (!furniture->ids().empty()) {
      tools_->furniture = std::move(furniture);
    }
  }
  if (!tools_->furniture && !tools_->map) {
    throw base::Error(base::ErrorCode::kUsage, "there is neither a map nor fixed furniture to find the camera by", job_.home.string());
  }
}

void LocateWorkshop::openPrior() {
  if (job_.prior.empty() && !job_.from) {
    return;
  }
  if (!job_.T_base_camera) {
    throw base::Error(base::ErrorCode::kInput,
                      "--prior and --from say where the robot is, but not where its camera is: T_base_camera is missing in camera.toml, "
                      "or give --robot");
  }
  if (job_.from) {
    tools_->prior.emplace(job_.from->T_map_base(), job_.recording.stampNs(0), *job_.T_base_camera);
  } else {
    tools_->prior.emplace(recording::readTrajectory(job_.prior), *job_.T_base_camera);
  }
}

Located locateRecording(const LocateJob& job, const Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  const LocateWorkshop workshop(job);
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
