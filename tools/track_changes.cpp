// SPDX-License-Identifier: Apache-2.0
#include "tools/track_changes.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "mapping/extend/recalled_space.h"
#include "mapping/extend/revision.h"
#include "tracking/furniture/furniture_places.h"
#include "tracking/state/object_readings.h"

namespace oikos::tools {

namespace {

/// Frames about a step apart, read.
std::vector<tracking::ChangeView> viewsOf(const recording::Recording& recording, const tracking::StateTools& tools,
                                          const mapping::RevisionConfig& config) {
  std::vector<mapping::DriveView> drive;
  for (const tracking::SeenFrame& seen : tools.reader.frames()) {
    drive.push_back({{seen.frame, seen.T_map_camera}, false});
  }
  const std::vector<mapping::DriveView> chosen = mapping::spreadOut(drive, config);
  std::vector<tracking::ChangeView> views(chosen.size());
  base::parallelFor(static_cast<int>(chosen.size()), tools.threads, [&](int i) {
    const tracking::SeenFrame& seen = tools.reader.seen(chosen[static_cast<std::size_t>(i)].view.frame);
    tracking::ChangeView& view = views[static_cast<std::size_t>(i)];
    view = {seen.frame, seen.stamp_ns,
            tracking::halvedScan(recording.read(seen.frame, recording::Channels::kGray).depth_m, recording.camera(), seen.T_map_camera)};
    view.scan.covariance = seen.covariance;
  });
  return views;
}

}  // namespace

std::vector<tracking::ChangeBox> ChangeWatch::find(const recording::Recording& recording, const tracking::RecordingStates& states,
                                                   const tracking::StateTools& tools) {
  std::shared_ptr<const mapping::SeenSpace> space;
  {
    const std::lock_guard lock(mutex_);
    if (!space_) {
      if (!std::filesystem::exists(map_ / "keyframes.sqlite")) {
        throw base::Error(base::ErrorCode::kUsage, "no such map: --changes compares with it", map_.string());
      }
      space_ = std::make_shared<const mapping::SeenSpace>(
          mapping::recallSpace(map_ / "keyframes.sqlite", config_.occupancy, config_.revision.free, tools.threads, tools.progress));
    }
    space = space_;
  }
  mapping::ChangeConfig config = config_.revision.change;
  config.threads = tools.threads;
  return tracking::findChangeBoxes(*space, viewsOf(recording, tools, config_.revision),
                                   {tools.home, tools.home_folder, tracking::carriersOf(states, tools.config.furniture), states.objects},
                                   recording.camera(), config);
}

}  // namespace oikos::tools
