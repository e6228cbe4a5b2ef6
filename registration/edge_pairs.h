// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/render/view.h"
#include "registration/pairs.h"
#include "registration/scan.h"

namespace oikos::registration {

/// Where the scan's depth jumps: what a table top that slides in its plane is held by.
class ScanEdges {
 public:
  explicit ScanEdges(const Scan& scan);

  enum Side { kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8 };
  /// On which sides of a reading what lies beyond is clearly farther away, or nothing is.
  [[nodiscard]] unsigned at(int u_px, int v_px) const {
    return sides_[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u_px)];
  }

 private:
  int width_;
  std::vector<unsigned char> sides_;
};

/// Pairs between the outline of the rendered model and the nearest jump of the scan along the image's row or column, as trackers of edges
/// search (Harris & Stennett, "RAPID", BMVC 1990; Drummond & Cipolla, PAMI 2002), at the model's depth. A pair's normal is across the
/// outline and the line of sight, so that its residual is a distance beside the outline. The jump must go the same way and its near
/// side be as far away as the model, within the gate. Returns how many places of the outline were looked at.
int appendEdgePairs(const render::View& view, const Scan& scan, const ScanEdges& edges, const Eigen::Isometry3d& T_map_camera,
                    double gate_m, std::vector<Pair>& pairs);

}  // namespace oikos::registration
