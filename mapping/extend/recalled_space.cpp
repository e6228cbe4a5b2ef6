// SPDX-License-Identifier: Apache-2.0
#include "mapping/extend/recalled_space.h"

#include <vector>

#include "mapping/graph/keyframe_reader.h"
#include "mapping/volume/view_batches.h"

namespace oikos::mapping {

SeenSpace recallSpace(const std::filesystem::path& file, const OccupancyConfig& occupancy, const FreeSpaceConfig& free, int threads,
                      const base::ProgressSink& progress) {
  struct Seen {
    Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
    camera::RgbdFrame frame;
  };
  const KeyframeReader reader(file);
  std::vector<View> views;
  for (const StoredKeyframe& keyframe : reader.readKeyframes()) {
    views.push_back({keyframe.id, keyframe.T_map_camera});
  }
  SeenSpace space(occupancy, free, threads);
  forEachBatch<Seen>(
      views, {reader.camera(), {}, threads, progress}, "recalling the map",
      [&](const View& view) {
        Seen seen{view.T_a_camera, {}};
        seen.frame.depth_m = reader.readDepth(view.frame);
        return seen;
      },
      [&](std::vector<Seen>& batch) {
        for (const Seen& seen : batch) {
          space.insert({seen.frame, reader.camera(), seen.T_map_camera});
        }
      });
  return space;
}

}  // namespace oikos::mapping
