// SPDX-License-Identifier: Apache-2.0
#include "mapping/floorplan/wall_views.h"

#include <algorithm>

#include "core/base/parallel.h"

namespace oikos::mapping {

WallSketch sketchWalls(const std::vector<View>& views_level, const FusionInput& input, const DepthFilterConfig& filter,
                       const WallScanConfig& config) {
  WallScan scan(config);
  const auto all = static_cast<std::int64_t>(views_level.size());
  const int used = static_cast<int>(std::min<std::int64_t>(all, config.max_views));
  const auto viewAt = [&](int i) -> const View& { return views_level[static_cast<std::size_t>(i * all / used)]; };
  const int batch = 2 * std::max(1, input.threads);
  for (int begin = 0; begin < used; begin += batch) {
    std::vector<cv::Mat> depths_m(static_cast<std::size_t>(std::min(batch, used - begin)));
    base::parallelFor(static_cast<int>(depths_m.size()), input.threads, [&](int i) {
      depths_m[static_cast<std::size_t>(i)] = filterDepth(input.read(viewAt(begin + i).frame, false).depth_m, filter);
    });
    for (std::size_t i = 0; i < depths_m.size(); ++i) {
      scan.add(depths_m[i], input.camera, viewAt(begin + static_cast<int>(i)).T_a_camera);
    }
    base::reportProgress(input.progress, {"looking for the walls", begin + static_cast<int>(depths_m.size()), used});
  }
  return scan.sketch();
}

}  // namespace oikos::mapping
