// SPDX-License-Identifier: Apache-2.0
//
// OctoMap (Hornung et al. 2013) keeps the voxels of a scan in hash sets and finds each one in the octree from the root. Here a
// scan's voxels are bits in bricks and the map is an array of bricks; the octree is made once, at the end. All that decides
// about a voxel is arithmetic that this file repeats operation by operation, in the same types: see `octomap/OcTreeBaseImpl.hxx`,
// computeRayKeys, and `OccupancyOcTreeBase.hxx`, computeDiscreteUpdate, computeUpdate, updateNodeLogOdds. It must be compiled
// without contraction of floating-point expressions (set in CMakeLists.txt).
#include "mapping/volume/occupancy_integrator.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace oikos::mapping {

namespace {

float logOdds(double probability) {
  return static_cast<float>(std::log(probability / (1 - probability)));
}

/// Work is dealt out in blocks: neighbouring points share bricks.
constexpr std::size_t kPointBlock = 4096;
constexpr std::size_t kRayBlock = 128;
constexpr std::size_t kBrickBlock = 64;

/// Calls `visit(i)` for worker w's share of 0..count: blocks w, w + workers, w + 2·workers …
template <typename Visit>
void forShare(std::size_t count, std::size_t block, std::size_t worker, std::size_t workers, const Visit& visit) {
  for (std::size_t begin = worker * block; begin < count; begin += workers * block) {
    for (std::size_t i = begin; i < std::min(begin + block, count); ++i) {
      visit(i);
    }
  }
}

}  // namespace

OccupancyIntegrator::OccupancyIntegrator(const OccupancyConfig& config, int threads)
    : config_(config),
      threads_(threads),
      lattice_(config.resolution_m),
      log_odds_hit_(logOdds(config.probability_hit)),
      log_odds_miss_(logOdds(config.probability_miss)),
      log_odds_min_(logOdds(config.probability_min)),
      log_odds_max_(logOdds(config.probability_max)),
      log_odds_threshold_(logOdds(config.occupied_threshold)),
      workers_(static_cast<std::size_t>(std::max(1, threads))) {
  OIKOS_CHECK(config.validate().empty());
  OIKOS_CHECK(threads >= 1);
}

void OccupancyIntegrator::insert(const OccupancyScan& scan) {
  const std::vector<VoxelKey> endpoints = findEndpoints(scan.points_map);
  castRays(scan.origin_map, endpoints);
  update();
}

std::vector<VoxelKey> OccupancyIntegrator::findEndpoints(std::span<const Eigen::Vector3f> points) {
  base::parallelFor(static_cast<int>(workers_.size()), threads_, [&](int w) {
    VoxelSet& mine = workers_[static_cast<std::size_t>(w)].occupied;
    mine.clear();
    forShare(points.size(), kPointBlock, static_cast<std::size_t>(w), workers_.size(), [&](std::size_t i) {
      if (lattice_.hasNumber(points[i])) {
        mine.insert(lattice_.wrappedKey(points[i]));
      }
    });
  });
  for (std::size_t w = 1; w < workers_.size(); ++w) {
    workers_[0].occupied.merge(workers_[w].occupied);
  }
  std::vector<VoxelKey> endpoints;
  workers_[0].occupied.forEach([&](VoxelKey key) { endpoints.push_back(key); });
  return endpoints;
}

void OccupancyIntegrator::castRays(const Eigen::Vector3f& origin, std::span<const VoxelKey> endpoints) {
  base::parallelFor(static_cast<int>(workers_.size()), threads_, [&](int w) {
    Worker& mine = workers_[static_cast<std::size_t>(w)];
    mine.free.clear();
    mine.occupied.clear();
    mine.rays.clear();
    forShare(endpoints.size(), kRayBlock, static_cast<std::size_t>(w), workers_.size(),
             [&](std::size_t i) { addRay(origin, endpoints[i], mine); });
    markRays(lattice_, mine.rays, mine.free);
  });
  for (std::size_t w = 1; w < workers_.size(); ++w) {
    workers_[0].free.merge(workers_[w].free);
    workers_[0].occupied.merge(workers_[w].occupied);
  }
}

void OccupancyIntegrator::addRay(const Eigen::Vector3f& origin, VoxelKey endpoint, Worker& worker) const {
  const RaySegment ray{origin, lattice_.center(endpoint)};
  const double length = rayLength(ray);
  if (length > config_.max_range_m) {
    const Eigen::Vector3f direction = (ray.end - origin) / static_cast<float>(length);
    worker.rays.push_back({origin, origin + direction * static_cast<float>(config_.max_range_m)});
    return;
  }
  worker.rays.push_back(ray);
  if (const auto key = lattice_.findKey(ray.end)) {
    worker.occupied.insert(*key);
  }
}

OccupancyBrick& OccupancyIntegrator::brickAt(VoxelKey brick) {
  const std::uint32_t number = index_.findOrInsert(brick);
  if (number == bricks_.size()) {
    bricks_.push_back(std::make_unique<OccupancyBrick>());
  }
  return *bricks_[number];
}

void OccupancyIntegrator::update() {
  const VoxelSet& free = workers_[0].free;
  VoxelSet& occupied = workers_[0].occupied;
  for (std::size_t i = 0; i < free.brickCount(); ++i) {
    occupied.bits(free.brick(i));  // now every brick that the scan touched has its place in `occupied`
  }
  std::vector<OccupancyBrick*> targets(occupied.brickCount());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    targets[i] = &brickAt(occupied.brick(i));
  }
  const VoxelSet::Bits none{};
  base::parallelFor(static_cast<int>(workers_.size()), threads_, [&](int w) {
    forShare(targets.size(), kBrickBlock, static_cast<std::size_t>(w), workers_.size(), [&](std::size_t i) {
      const VoxelSet::Bits* passed = free.find(occupied.brick(i));
      updateBrick(passed != nullptr ? *passed : none, occupied.bitsOf(i), *targets[i]);
    });
  });
}

/// A reading in a voxel outweighs the rays through it.
void OccupancyIntegrator::updateBrick(const VoxelSet::Bits& passed, const VoxelSet::Bits& hit, OccupancyBrick& brick) const {
  for (unsigned word = 0; word < hit.size(); ++word) {
    const std::uint64_t touched = passed[word] | hit[word];
    brick.known[word] |= touched;
    for (std::uint64_t rest = touched; rest != 0; rest &= rest - 1) {
      const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
      float& value = brick.log_odds[word * 64 + bit];
      value += ((hit[word] >> bit) & 1U) != 0 ? log_odds_hit_ : log_odds_miss_;
      value = std::min(std::max(value, log_odds_min_), log_odds_max_);
    }
  }
}

std::optional<float> OccupancyIntegrator::findLogOdds(VoxelKey key) const {
  const auto number = index_.find(brickOf(key));
  const unsigned place = placeInBrick(key);
  if (!number || ((bricks_[*number]->known[place / 64] >> (place % 64)) & 1U) == 0) {
    return std::nullopt;
  }
  return bricks_[*number]->log_odds[place];
}

void OccupancyIntegrator::forEachBrick(const std::function<void(VoxelKey, const OccupancyBrick&)>& visit) const {
  for (const std::uint32_t number : index_.sorted()) {
    visit(index_.key(number), *bricks_[number]);
  }
}

void OccupancyIntegrator::forEachVoxel(const std::function<void(VoxelKey, float)>& visit) const {
  forEachBrick([&](VoxelKey key, const OccupancyBrick& brick) {
    for (unsigned place = 0; place < kBrickVoxels; ++place) {
      if (((brick.known[place / 64] >> (place % 64)) & 1U) != 0) {
        visit(key | offsetOfPlace(place), brick.log_odds[place]);
      }
    }
  });
}

std::size_t OccupancyIntegrator::memoryBytes() const {
  return index_.memoryBytes() + bricks_.size() * sizeof(OccupancyBrick);
}

}  // namespace oikos::mapping
