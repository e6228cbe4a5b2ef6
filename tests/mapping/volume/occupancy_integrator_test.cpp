// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/occupancy_integrator.h"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "core/base/error.h"
#include "mapping/volume/depth_scan.h"
#include "mapping/volume/octomap_files.h"
#include "mapping/volume/octomap_tree.h"
#include "tests/support/analytic_room.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace oikos::mapping {
namespace {

void configure(const OccupancyConfig& config, octomap::OcTree& tree) {
  tree.setProbHit(config.probability_hit);
  tree.setProbMiss(config.probability_miss);
  tree.setClampingThresMin(config.probability_min);
  tree.setClampingThresMax(config.probability_max);
  tree.setOccupancyThres(config.occupied_threshold);
}

void insertIntoOctomap(const OccupancyScan& scan, double max_range_m, octomap::OcTree& tree) {
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3f& point : scan.points_map) {
    if (point.allFinite()) {
      cloud.push_back(point.x(), point.y(), point.z());
    }
  }
  const octomap::point3d origin(scan.origin_map.x(), scan.origin_map.y(), scan.origin_map.z());
  tree.insertPointCloud(cloud, origin, max_range_m, false, true);
}

std::string bytes(const octomap::OcTree& tree) {
  std::ostringstream stream;
  tree.write(stream);
  return std::move(stream).str();
}

/// Every leaf voxel of OctoMap's tree, pruned cubes taken apart, is in ours with the same bits, and ours has no other.
void expectSameVoxels(const OccupancyIntegrator& ours, octomap::OcTree& theirs) {
  theirs.expand();
  std::size_t theirs_count = 0;
  std::size_t different = 0;
  for (auto leaf = theirs.begin_leafs(); leaf != theirs.end_leafs(); ++leaf) {
    ++theirs_count;
    const auto key = leaf.getKey();
    const auto mine = ours.findLogOdds(packVoxelKey(key[0], key[1], key[2]));
    different += !mine || *mine != leaf->getLogOdds() ? 1 : 0;
  }
  std::size_t ours_count = 0;
  ours.forEachVoxel([&](VoxelKey, float) { ++ours_count; });
  EXPECT_EQ(different, 0U);
  EXPECT_EQ(ours_count, theirs_count);
}

void expectEqual(const std::vector<OccupancyScan>& scans, const OccupancyConfig& config, int threads = 2) {
  OccupancyIntegrator ours(config, threads);
  octomap::OcTree theirs(config.resolution_m);
  configure(config, theirs);
  for (const OccupancyScan& scan : scans) {
    ours.insert(scan);
    insertIntoOctomap(scan, config.max_range_m, theirs);
  }
  const auto tree = makeOctomapTree(ours);
  EXPECT_EQ(tree->size(), tree->calcNumNodes());
  EXPECT_EQ(bytes(*tree), bytes(theirs));
  EXPECT_TRUE(*tree == theirs);
  expectSameVoxels(ours, theirs);
}

std::vector<OccupancyScan> roomScans(const OccupancyConfig& config, int count) {
  const test::AnalyticRoom room = test::AnalyticRoom::furnished();
  const camera::PinholeCamera camera = test::smallCamera();
  std::vector<OccupancyScan> scans;
  for (const Eigen::Isometry3d& T_map_camera : test::lookAround(count, 0.3, 1.3, 0.4)) {
    const camera::RgbdFrame frame = room.render(camera, T_map_camera);
    scans.push_back(makeScan({frame, camera, T_map_camera}, config));
  }
  return scans;
}

/// Points in a shell around wandering origins, far beyond the maximal range too, some on voxel borders, some in the origin's voxel.
std::vector<OccupancyScan> randomScans(unsigned seed, double resolution_m) {
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) { return low + (high - low) * static_cast<float>(random()) / 4294967296.0F; };
  std::vector<OccupancyScan> scans;
  for (int s = 0; s < 6; ++s) {
    OccupancyScan scan;
    scan.origin_map = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3f direction = Eigen::Vector3f(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
      scan.points_map.push_back(scan.origin_map + uniform(0.0F, 4.0F) * direction);
    }
    const auto voxel = static_cast<float>(resolution_m);
    for (int i = -20; i < 20; ++i) {
      scan.points_map.emplace_back(static_cast<float>(i) * voxel, static_cast<float>(2 * i) * voxel, 0.0F);
      scan.points_map.emplace_back(scan.origin_map.x(), scan.origin_map.y(), scan.origin_map.z() + static_cast<float>(i) * voxel);
    }
    scan.points_map.push_back(scan.origin_map);
    scans.push_back(scan);
  }
  return scans;
}

TEST(OccupancyIntegrator, EqualsOctomapOnARoomAtAllResolutions) {
  for (const double resolution_m : {0.02, 0.05, 0.1}) {
    OccupancyConfig config;
    config.resolution_m = resolution_m;
    config.pixel_stride = 1;
    expectEqual(roomScans(config, 8), config);
  }
}

TEST(OccupancyIntegrator, EqualsOctomapAtOneCentimetre) {
  OccupancyConfig config;
  config.resolution_m = 0.01;
  config.max_range_m = 1.0;
  expectEqual(roomScans(config, 3), config);
}

TEST(OccupancyIntegrator, EqualsOctomapWithShortMaximalRange) {
  OccupancyConfig config;
  config.max_range_m = 1.5;
  expectEqual(roomScans(config, 8), config);
}

TEST(OccupancyIntegrator, EqualsOctomapOnRandomRays) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    OccupancyConfig config;
    config.resolution_m = seed % 2 == 0 ? 0.05 : 0.07;
    config.max_range_m = seed % 3 == 0 ? 2.0 : 10.0;
    expectEqual(randomScans(seed, config.resolution_m), config, 1 + static_cast<int>(seed % 3));
  }
}

TEST(OccupancyIntegrator, EqualsOctomapWhereLogOddsClampAndReturn) {
  OccupancyConfig config;
  config.max_range_m = 3.0;
  std::vector<OccupancyScan> scans;
  for (int repetition = 0; repetition < 12; ++repetition) {
    for (const OccupancyScan& scan : randomScans(repetition < 8 ? 1U : 2U, config.resolution_m)) {
      scans.push_back(scan);
    }
  }
  expectEqual(scans, config);
}

TEST(OccupancyIntegrator, EqualsOctomapWithAnotherSensorModel) {
  OccupancyConfig config;
  config.probability_hit = 0.9;
  config.probability_miss = 0.45;
  config.probability_min = 0.02;
  config.probability_max = 0.99;
  config.occupied_threshold = 0.6;
  expectEqual(roomScans(config, 8), config);
}

TEST(OccupancyIntegrator, EqualsOctomapBeyondTheLattice) {
  OccupancyConfig config;
  config.resolution_m = 0.01;
  config.max_range_m = 0.5;
  OccupancyScan scan;
  scan.points_map = {{400.0F, 0.0F, 0.0F}, {0.2F, -500.0F, 0.1F}, {0.1F, 0.1F, 0.1F}};
  OccupancyScan far;
  far.origin_map = {400.0F, 0.0F, 0.0F};
  far.points_map = {{400.1F, 0.0F, 0.0F}, {399.9F, 0.1F, 0.1F}};
  expectEqual({scan, far}, config);
}

TEST(OccupancyIntegrator, PassesOverPointsThatAreNotNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  OccupancyScan scan;
  scan.points_map = {{nan, 0.0F, 0.0F}, {0.0F, infinite, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -infinite}};
  expectEqual({scan}, OccupancyConfig{});
}

TEST(OccupancyIntegrator, NothingInNothingOut) {
  OccupancyIntegrator occupancy(OccupancyConfig{}, 1);
  occupancy.insert(OccupancyScan{});
  EXPECT_FALSE(occupancy.findLogOdds(packVoxelKey(32768, 32768, 32768)).has_value());
  EXPECT_EQ(makeOctomapTree(occupancy)->size(), 0U);
}

TEST(OccupancyIntegrator, SameBitsForAnyNumberOfThreads) {
  std::string first;
  for (const int threads : {1, 2, 3, 7}) {
    const OccupancyConfig config;
    OccupancyIntegrator occupancy(config, threads);
    for (const OccupancyScan& scan : roomScans(config, 4)) {
      occupancy.insert(scan);
    }
    const std::string written = bytes(*makeOctomapTree(occupancy));
    first = first.empty() ? written : first;
    EXPECT_EQ(written, first);
  }
}

TEST(OccupancyIntegrator, RefusesAConfigurationThatMakesNoSense) {
  OccupancyConfig config;
  config.resolution_m = 0.5;
  EXPECT_EQ(config.validate(), std::vector<std::string>{"resolution_m = 0.5: must be from 0.01 to 0.1"});
  EXPECT_THROW(OccupancyIntegrator(config, 1), base::ContractViolation);
}

TEST(OctomapFiles, OctomapReadsThemBack) {
  OccupancyConfig config;
  OccupancyIntegrator occupancy(config, 1);
  for (const OccupancyScan& scan : roomScans(config, 6)) {
    occupancy.insert(scan);
  }
  const test::TemporaryFolder folder;
  writeOctomap(occupancy, folder.path());
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read((folder.path() / "octomap.ot").string()));
  auto* full = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(full, nullptr);
  expectSameVoxels(occupancy, *full);
  octomap::OcTree most_likely(config.resolution_m);
  ASSERT_TRUE(most_likely.readBinary((folder.path() / "octomap.bt").string()));
  std::size_t different = 0;
  occupancy.forEachVoxel([&](VoxelKey key, float log_odds) {
    const auto xyz = unpackVoxelKey(key);
    const octomap::OcTreeNode* node = most_likely.search(octomap::OcTreeKey(xyz[0], xyz[1], xyz[2]));
    different += node == nullptr || most_likely.isNodeOccupied(node) != occupancy.isOccupied(log_odds) ? 1 : 0;
  });
  EXPECT_EQ(different, 0U);
}

TEST(OctomapFiles, FullDiskIsAnErrorThatNamesTheFile) {
  OccupancyIntegrator occupancy(OccupancyConfig{}, 1);
  for (const OccupancyScan& scan : roomScans(occupancy.config(), 2)) {
    occupancy.insert(scan);
  }
  const test::TemporaryFolder whole;
  writeOctomap(occupancy, whole.path());
  const std::uintmax_t bt_bytes = std::filesystem::file_size(whole.path() / "octomap.bt");
  ASSERT_LT(bt_bytes, std::filesystem::file_size(whole.path() / "octomap.ot"));
  for (const auto& [name, room_bytes] : {std::pair{"octomap.bt", bt_bytes - 1}, {"octomap.ot", bt_bytes}}) {
    const test::TemporaryFolder folder;
    const test::FileSizeLimit limit(room_bytes);
    try {
      writeOctomap(occupancy, folder.path());
      FAIL() << name;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ErrorCode::kIo);
      EXPECT_EQ(error.where(), (folder.path() / name).string());
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name));
  }
}

}  // namespace
}  // namespace oikos::mapping
