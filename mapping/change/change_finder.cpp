// SPDX-License-Identifier: Apache-2.0
// After Schmid et al., "Dynablox: Real-time Detection of Diverse Dynamic Objects in Complex Environments" (RA-L 2023,
// doi:10.1109/LRA.2023.3305239): trust free space that was seen free repeatedly, with its neighbours. Other than there, the neighbourhood
// is as large as the point is uncertain, the views of free space must lie apart, the reference is the map of an earlier drive, and what has
// gone is found as well, in the scan's image.
#include "mapping/change/change_finder.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "mapping/change/change_boxes.h"
#include "mapping/change/evidence.h"

namespace oikos::mapping {

namespace {

ChangeStatus judge(const ScanEvidence& evidence, const ChangeConfig& config) {
  if (evidence.surface == 0) {
    return ChangeStatus::kNoSurface;
  }
  if (evidence.surface_known < config.min_known_share * evidence.surface) {
    return ChangeStatus::kNotInMap;
  }
  const bool is_misplaced = evidence.surface_fresh > config.max_changed_share * evidence.surface_known ||
                            evidence.map_gone > config.max_changed_share * evidence.map_seen;
  return is_misplaced ? ChangeStatus::kMisplaced : ChangeStatus::kCompared;
}

void addEvidence(const EvidenceMap& more, EvidenceMap& sum) {
  for (const auto& [key, one] : more) {
    Evidence& all = sum.try_emplace(key, Evidence{one.point_map}).first->second;
    all.is_seed = all.is_seed || one.is_seed;
    all.clear_sigmas = std::max(all.clear_sigmas, one.clear_sigmas);
    all.for_views += one.for_views;
    all.against_views += one.against_views;
  }
}

/// Scans that see through a new surface speak against it.
void addDoubts(const ScanView& view, EvidenceMap& fresh) {
  for (auto& [key, evidence] : fresh) {
    evidence.against_views += view.look(evidence.point_map, 1.0).sight == Sight::kThrough ? 1 : 0;
  }
}

/// A scan's part of the work, done by itself.
struct Comparison {
  explicit Comparison(ScanView scan_view) : view(std::move(scan_view)) {}
  ScanView view;
  std::vector<SurfaceVoxel> surface;
  ScanEvidence evidence;
};

std::vector<Comparison> compareScans(const std::vector<LocatedScan>& scans, const Reference& reference, const ChangeConfig& config) {
  const VoxelLattice& lattice = reference.space.lattice();
  std::vector<Comparison> comparisons;
  comparisons.reserve(scans.size());
  for (const LocatedScan& scan : scans) {
    comparisons.emplace_back(ScanView(scan, config, lattice.resolutionM()));
  }
  base::parallelFor(static_cast<int>(scans.size()), config.threads, [&](int i) {
    Comparison& mine = comparisons[static_cast<std::size_t>(i)];
    mine.surface = findSurface(mine.view.scan(), config, lattice);
    mine.evidence = compareScan(mine.view, mine.surface, reference);
  });
  return comparisons;
}

}  // namespace

ChangeResult findChanges(const SeenSpace& map, const std::vector<LocatedScan>& scans, const ChangeConfig& config) {
  OIKOS_CHECK(config.validate().empty() && config.surface.validate().empty());
  const std::vector<VoxelKey> occupied = map.occupiedVoxels();
  const std::vector<VoxelStep> ball = voxelBall(config.max_tolerance_m, map.lattice().resolutionM());
  std::vector<Comparison> comparisons = compareScans(scans, {map, occupied, ball}, config);
  ChangeResult result;
  EvidenceMap fresh;
  EvidenceMap gone;
  SupportVoxels seen_now;
  for (const Comparison& comparison : comparisons) {
    result.scans.push_back(judge(comparison.evidence, config));
    result.status = std::max(result.status, result.scans.back());
    if (result.scans.back() == ChangeStatus::kCompared) {
      addEvidence(comparison.evidence.fresh, fresh);
      addEvidence(comparison.evidence.gone, gone);
      for (const SurfaceVoxel& voxel : comparison.surface) {
        seen_now.insert(voxel.key);
      }
    }
  }
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    if (result.scans[i] == ChangeStatus::kCompared) {
      addDoubts(comparisons[i].view, fresh);
    }
  }
  result.changes = boxChanges(ChangeKind::kNew, fresh, SupportVoxels(occupied.begin(), occupied.end()), map.lattice(), config);
  const std::vector<Change> missing = boxChanges(ChangeKind::kGone, gone, seen_now, map.lattice(), config);
  result.changes.insert(result.changes.end(), missing.begin(), missing.end());
  return result;
}

}  // namespace oikos::mapping
