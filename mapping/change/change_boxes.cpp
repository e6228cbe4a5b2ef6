// SPDX-License-Identifier: Apache-2.0
#include "mapping/change/change_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace oikos::mapping {

namespace {

using Cluster = std::vector<VoxelKey>;

double agreement(const Evidence& evidence) {
  return static_cast<double>(evidence.for_views) / std::max(1, evidence.for_views + evidence.against_views);
}

/// Changed voxels as they are joined.
class Clusters {
 public:
  Clusters(const EvidenceMap& evidence, const ChangeConfig& config) {
    for (const auto& [key, voxel] : evidence) {
      if (voxel.for_views > 0 && agreement(voxel) >= config.min_agreement) {
        if (voxel.is_seed) {
          seeds_[key] = -1;
        } else {
          weak_.insert(key);
        }
      }
    }
  }

  /// Seeds near to each other make a cluster.
  std::vector<Cluster> join(const std::vector<VoxelStep>& ball) {
    for (const auto& [key, number] : seeds_) {
      if (number < 0) {
        flood(key, ball);
      }
    }
    return clusters_;
  }

  /// Weak voxels join the seed nearest to them.
  void addWeak(const std::vector<VoxelStep>& ball, std::vector<Cluster>& clusters) const {
    for (const VoxelKey key : weak_) {
      for (const VoxelStep& step : ball) {
        if (const auto seed = seeds_.find(stepFrom(key, step.offset)); seed != seeds_.end()) {
          clusters[static_cast<std::size_t>(seed->second)].push_back(key);
          break;
        }
      }
    }
  }

 private:
  void flood(VoxelKey first, const std::vector<VoxelStep>& ball) {
    const int number = static_cast<int>(clusters_.size());
    Cluster cluster = {first};
    seeds_[first] = number;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      for (const VoxelStep& step : ball) {
        const auto neighbour = seeds_.find(stepFrom(cluster[i], step.offset));
        if (neighbour != seeds_.end() && neighbour->second < 0) {
          neighbour->second = number;
          cluster.push_back(neighbour->first);
        }
      }
    }
    clusters_.push_back(std::move(cluster));
  }

  std::map<VoxelKey, int> seeds_;  ///< to their cluster's number; -1: none yet
  std::set<VoxelKey> weak_;
  std::vector<Cluster> clusters_;
};

struct Box {
  Eigen::Vector3d min_map;
  Eigen::Vector3d max_map;
};

/// Share of the views of a change's voxels that lie beyond each side of its box: scans that are off by more than others.
constexpr double kBeyondSide = 0.02;

/// The value that `share` of the weight lies below.
double weightedQuantile(std::vector<std::pair<double, int>> weighted, double share) {
  std::sort(weighted.begin(), weighted.end());
  double rest = 0.0;
  for (const auto& [value, weight] : weighted) {
    rest += share * weight;
  }
  for (const auto& [value, weight] : weighted) {
    rest -= weight;
    if (rest < 0.0) {
      return value;
    }
  }
  return weighted.back().first;
}

/// Around surface points (new) or whole voxels (gone).
Box boxAround(const Cluster& cluster, const EvidenceMap& evidence, double half_voxel_m) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::pair<double, int>> weighted;
    for (const VoxelKey key : cluster) {
      weighted.emplace_back(evidence.at(key).point_map[axis], evidence.at(key).for_views);
    }
    box.min_map[axis] = weightedQuantile(weighted, kBeyondSide) - half_voxel_m;
    box.max_map[axis] = weightedQuantile(weighted, 1.0 - kBeyondSide) + half_voxel_m;
  }
  return box;
}

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The height of the first surface from a voxel above the point downwards.
std::optional<double> findSurfaceBelow_m(const Eigen::Vector3d& point_map, const SupportVoxels& support, const VoxelLattice& lattice,
                                         double reach_m) {
  const double step_m = lattice.resolutionM();
  const int steps = static_cast<int>(reach_m / step_m) + 1;
  for (int i = -1; i <= steps; ++i) {
    const auto key = lattice.findKey((point_map - i * step_m * Eigen::Vector3d::UnitZ()).cast<float>());
    if (key && support.contains(*key)) {
      return lattice.center(*key).z();
    }
  }
  return std::nullopt;
}

/// The median over the columns of the box's footprint; nothing when under half of them have a surface.
std::optional<double> findSupport_m(const Box& box, const SupportVoxels& support, const VoxelLattice& lattice, double reach_m) {
  const Eigen::Vector3d size_m = box.max_map - box.min_map;
  const int columns_x = std::max(1, static_cast<int>(size_m.x() / lattice.resolutionM()));
  const int columns_y = std::max(1, static_cast<int>(size_m.y() / lattice.resolutionM()));
  std::vector<double> heights_m;
  for (int x = 0; x < columns_x; ++x) {
    for (int y = 0; y < columns_y; ++y) {
      const Eigen::Vector3d share((x + 0.5) / columns_x, (y + 0.5) / columns_y, 0.0);
      if (const auto height_m = findSurfaceBelow_m(box.min_map + share.cwiseProduct(size_m), support, lattice, reach_m)) {
        heights_m.push_back(*height_m);
      }
    }
  }
  const bool is_known = 2 * heights_m.size() >= static_cast<std::size_t>(columns_x) * static_cast<std::size_t>(columns_y);
  return is_known ? std::optional(medianOf(heights_m)) : std::nullopt;
}

double confidenceOf(const Cluster& cluster, const EvidenceMap& evidence) {
  std::vector<double> clear_sigmas;
  double agreement_sum = 0.0;
  for (const VoxelKey key : cluster) {
    clear_sigmas.push_back(evidence.at(key).clear_sigmas);
    agreement_sum += agreement(evidence.at(key));
  }
  return agreement_sum / static_cast<double>(cluster.size()) * std::erf(medianOf(clear_sigmas) / std::sqrt(2.0));
}

/// Whole voxels come a rounding short of a size that is a multiple of theirs.
constexpr double kRounding_m = 1e-6;

double secondLongest(const Eigen::Vector3d& size_m) {
  std::array<double, 3> sides = {size_m.x(), size_m.y(), size_m.z()};
  std::sort(sides.begin(), sides.end());
  return sides[1];
}

}  // namespace

std::vector<Change> boxChanges(ChangeKind kind, const EvidenceMap& evidence, const SupportVoxels& support, const VoxelLattice& lattice,
                               const ChangeConfig& config) {
  Clusters joined(evidence, config);
  std::vector<Cluster> clusters = joined.join(voxelBall(config.join_m, lattice.resolutionM()));
  const std::vector<Cluster> seeds = clusters;
  joined.addWeak(voxelBall(config.max_tolerance_m, lattice.resolutionM()), clusters);
  std::vector<Change> changes;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    Box box = boxAround(clusters[i], evidence, kind == ChangeKind::kGone ? 0.5 * lattice.resolutionM() : 0.0);
    if (static_cast<int>(seeds[i].size()) < config.min_seed_voxels ||
        secondLongest(box.max_map - box.min_map) + kRounding_m < config.min_size_m) {
      continue;
    }
    const auto support_m = findSupport_m(box, support, lattice, config.max_tolerance_m);
    box.min_map.z() = std::min(box.min_map.z(), support_m.value_or(box.min_map.z()));
    const double confidence = confidenceOf(clusters[i], evidence);
    std::sort(clusters[i].begin(), clusters[i].end());
    changes.push_back({kind, 0.5 * (box.min_map + box.max_map), box.max_map - box.min_map, support_m, confidence, std::move(clusters[i])});
  }
  return changes;
}

}  // namespace oikos::mapping
