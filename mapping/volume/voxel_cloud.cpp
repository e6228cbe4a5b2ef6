// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/voxel_cloud.h"

#include <algorithm>
#include <bit>
#include <opencv2/core.hpp>

#include "core/base/config_rules.h"
#include "core/base/error.h"
#include "core/geometry/ply.h"

namespace oikos::mapping {

namespace {

constexpr VoxelKey kSmallBrickMask = packVoxelKey(0xFFFC, 0xFFFC, 0xFFFC);

unsigned placeInSmallBrick(VoxelKey key) {
  const auto numbers = unpackVoxelKey(key);
  return (numbers[0] & 3U) | ((numbers[1] & 3U) << 2U) | ((numbers[2] & 3U) << 4U);
}

VoxelKey keyOfPlace(VoxelKey brick, unsigned place) {
  return brick | packVoxelKey(static_cast<std::uint16_t>(place & 3U), static_cast<std::uint16_t>((place >> 2U) & 3U),
                              static_cast<std::uint16_t>(place >> 4U));
}

}  // namespace

std::vector<std::string> VoxelCloudConfig::validate() const {
  base::ConfigRules rules;
  rules.between("voxel_m", voxel_m, 0.001, 1.0)
      .between("pixel_stride", pixel_stride, 1, 64)
      .between("min_readings", min_readings, 1, 65535);
  return rules.messages();
}

VoxelCloud::VoxelCloud(const VoxelCloudConfig& config) : config_(config), lattice_(config.voxel_m) {
  OIKOS_CHECK(config.validate().empty());
}

void VoxelCloud::add(const PosedFrame& posed) {
  const cv::Mat& depth = posed.frame.depth_m;
  const cv::Mat& color = posed.frame.color;
  OIKOS_CHECK(depth.type() == CV_32FC1 && depth.cols == posed.camera.width && depth.rows == posed.camera.height);
  OIKOS_CHECK(color.type() == CV_8UC3 && color.size() == depth.size());
  const Eigen::Isometry3f T_map_camera = posed.T_map_camera.cast<float>();
  for (int v = 0; v < depth.rows; v += config_.pixel_stride) {
    const float* depth_row = depth.ptr<float>(v);
    const std::uint8_t* color_row = color.ptr<std::uint8_t>(v);
    for (int u = 0; u < depth.cols; u += config_.pixel_stride) {
      if (depth_row[u] > 0.0F) {
        addPoint(T_map_camera * (depth_row[u] * posed.camera.ray(u, v).cast<float>()), color_row + 3 * u);
      }
    }
  }
}

void VoxelCloud::addPoint(const Eigen::Vector3f& point_map, const std::uint8_t* bgr) {
  const auto key = lattice_.findKey(point_map);
  if (!key) {
    return;
  }
  Entry& entry = entryAt(*key);
  if (entry.count == 65535) {
    return;
  }
  ++entry.count;
  const auto numbers = unpackVoxelKey(*key);
  std::array<std::uint32_t, 6> values{0, 0, 0, bgr[2], bgr[1], bgr[0]};
  for (int a = 0; a < 3; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const double within = static_cast<double>(point_map[a]) / config_.voxel_m - (numbers[i] - kVoxelKeyOrigin);
    values[i] = static_cast<std::uint32_t>(std::clamp(256.0 * within, 0.0, 255.0));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t sum = entry.low[i] + (std::uint32_t{entry.high[i]} << 16U) + values[i];
    entry.low[i] = static_cast<std::uint16_t>(sum);
    entry.high[i] = static_cast<std::uint8_t>(sum >> 16U);
  }
}

VoxelCloud::Entry& VoxelCloud::entryAt(VoxelKey key) {
  const VoxelKey brick_key = key & kSmallBrickMask;
  if (brick_key != latest_key_) {
    latest_key_ = brick_key;
    latest_number_ = index_.findOrInsert(brick_key);
    if (latest_number_ == bricks_.size()) {
      bricks_.emplace_back();
    }
  }
  Brick& brick = bricks_[latest_number_];
  const std::uint64_t bit = std::uint64_t{1} << placeInSmallBrick(key);
  const int rank = std::popcount(brick.occupied & (bit - 1));
  if ((brick.occupied & bit) == 0) {
    brick.occupied |= bit;
    if (brick.entries.size() == brick.entries.capacity()) {
      brick.entries.reserve(brick.entries.size() + 8);
    }
    brick.entries.insert(brick.entries.begin() + rank, Entry{});
  }
  return brick.entries[static_cast<std::size_t>(rank)];
}

std::size_t VoxelCloud::pointCount() const {
  std::size_t count = 0;
  for (const Brick& brick : bricks_) {
    count += static_cast<std::size_t>(std::count_if(brick.entries.begin(), brick.entries.end(),
                                                    [this](const Entry& entry) { return entry.count >= config_.min_readings; }));
  }
  return count;
}

void VoxelCloud::forEachPoint(const std::function<void(const Eigen::Vector3f&, const geometry::Rgb&)>& visit) const {
  for (const std::uint32_t number : index_.sorted()) {
    std::size_t rank = 0;
    for (std::uint64_t rest = bricks_[number].occupied; rest != 0; rest &= rest - 1) {
      const Entry& entry = bricks_[number].entries[rank++];
      if (entry.count < config_.min_readings) {
        continue;
      }
      const auto numbers = unpackVoxelKey(keyOfPlace(index_.key(number), static_cast<unsigned>(std::countr_zero(rest))));
      const auto mean = [&](std::size_t i) { return (entry.low[i] + 65536.0 * entry.high[i]) / entry.count; };
      const auto coordinate = [&](std::size_t a) {
        return static_cast<float>((numbers[a] - kVoxelKeyOrigin + (mean(a) + 0.5) / 256.0) * config_.voxel_m);
      };
      const auto channel = [&](std::size_t c) { return static_cast<std::uint8_t>(mean(3 + c) + 0.5); };
      visit({coordinate(0), coordinate(1), coordinate(2)}, {channel(0), channel(1), channel(2)});
    }
  }
}

void VoxelCloud::write(const std::filesystem::path& file) const {
  geometry::PlyCloudWriter writer(file, pointCount());
  forEachPoint([&](const Eigen::Vector3f& point, const geometry::Rgb& color) { writer.add(point, color); });
  writer.commit();
}

std::size_t VoxelCloud::memoryBytes() const {
  std::size_t bytes = index_.memoryBytes() + bricks_.capacity() * sizeof(Brick);
  for (const Brick& brick : bricks_) {
    bytes += brick.entries.capacity() * sizeof(Entry) + 16;
  }
  return bytes;
}

}  // namespace oikos::mapping
