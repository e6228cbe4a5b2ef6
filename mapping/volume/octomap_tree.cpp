// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/octomap_tree.h"

#include <algorithm>

namespace oikos::mapping {

namespace {

constexpr unsigned kTreeDepth = 16;
constexpr unsigned kBrickDepth = 13;

/// Makes the pruned tree from the top without ever making a node that pruning would take away again.
class FillableTree : public octomap::OcTree {
 public:
  using OcTree::OcTree;

  void insert(VoxelKey key, const OccupancyBrick& brick) { fill(nodeAt(key), brick, 0, kBrickVoxels); }

  /// Prunes and updates the levels above the bricks.
  void finish() {
    if (root != nullptr) {
      finishRecursive(root, 0);
    }
  }

 private:
  octomap::OcTreeNode* nodeAt(VoxelKey key) {
    if (root == nullptr) {
      root = new octomap::OcTreeNode();
      ++tree_size;
      size_changed = true;
    }
    const auto numbers = unpackVoxelKey(key);
    const octomap::OcTreeKey octomap_key(numbers[0], numbers[1], numbers[2]);
    octomap::OcTreeNode* node = root;
    for (unsigned depth = 0; depth < kBrickDepth; ++depth) {
      const unsigned child = octomap::computeChildIdx(octomap_key, static_cast<int>(kTreeDepth - 1 - depth));
      node = nodeChildExists(node, child) ? getNodeChild(node, child) : createNodeChild(node, child);
    }
    return node;
  }

  /// `count` voxels from `first` on, a cube in octree order, become `node` and what is below it.
  void fill(octomap::OcTreeNode* node, const OccupancyBrick& brick, unsigned first, unsigned count) {
    if (isUniform(brick, first, count)) {
      node->setLogOdds(brick.log_odds[first]);
      return;
    }
    for (unsigned child = 0; child < 8; ++child) {
      const unsigned child_first = first + child * count / 8;
      if (isAnyKnown(brick, child_first, count / 8)) {
        fill(createNodeChild(node, child), brick, child_first, count / 8);
      }
    }
    node->updateOccupancyChildren();
  }

  /// `count` is 512, 64, 8 or 1, and `first` a multiple of it.
  static bool isAnyKnown(const OccupancyBrick& brick, unsigned first, unsigned count) {
    if (count >= 64) {
      return std::any_of(&brick.known[first / 64], &brick.known[first / 64] + count / 64, [](std::uint64_t word) { return word != 0; });
    }
    return ((brick.known[first / 64] >> (first % 64)) & ((1ULL << count) - 1)) != 0;
  }

  static bool isAllKnown(const OccupancyBrick& brick, unsigned first, unsigned count) {
    if (count >= 64) {
      return std::all_of(&brick.known[first / 64], &brick.known[first / 64] + count / 64, [](std::uint64_t word) { return ~word == 0; });
    }
    return (~(brick.known[first / 64] >> (first % 64)) & ((1ULL << count) - 1)) == 0;
  }

  static bool isUniform(const OccupancyBrick& brick, unsigned first, unsigned count) {
    const float* begin = brick.log_odds.data() + first;
    return isAllKnown(brick, first, count) && std::all_of(begin, begin + count, [&](float value) { return value == *begin; });
  }

  void finishRecursive(octomap::OcTreeNode* node, unsigned depth) {
    if (depth == kBrickDepth) {
      return;
    }
    for (unsigned child = 0; child < 8; ++child) {
      if (nodeChildExists(node, child)) {
        finishRecursive(getNodeChild(node, child), depth + 1);
      }
    }
    if (!pruneNode(node)) {
      node->updateOccupancyChildren();
    }
  }
};

}  // namespace

std::unique_ptr<octomap::OcTree> makeOctomapTree(const OccupancyIntegrator& occupancy) {
  const OccupancyConfig& config = occupancy.config();
  auto tree = std::make_unique<FillableTree>(config.resolution_m);
  tree->setProbHit(config.probability_hit);
  tree->setProbMiss(config.probability_miss);
  tree->setClampingThresMin(config.probability_min);
  tree->setClampingThresMax(config.probability_max);
  tree->setOccupancyThres(config.occupied_threshold);
  occupancy.forEachBrick([&](VoxelKey key, const OccupancyBrick& brick) { tree->insert(key, brick); });
  tree->finish();
  return tree;
}

}  // namespace oikos::mapping
