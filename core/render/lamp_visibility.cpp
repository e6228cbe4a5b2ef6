// SPDX-License-Identifier: Apache-2.0
#include "core/render/lamp_visibility.h"

#include <algorithm>
#include <bit>

namespace oikos::render {

namespace {

/// A shadow ray starts this far off the surface (m), or it would hit what it starts from.
constexpr float kShadowOffset_m = 2e-3F;
constexpr float kLampSize = 0.02F;  // share of the way: the lamp's own shade does not count
constexpr std::uint8_t kAllLanes = 0xff;

/// The lane that stands for its packet: another one from packet to packet, so that the rays do not lie in rows.
std::size_t laneThatStandsFor(int column, int row) {
  return (column + row) % 2 == 0 ? 2 : 5;
}

void copyLane(const SurfacePacket& from, std::size_t lane, SurfacePacket& to, std::size_t i) {
  to.hit.part[i] = from.hit.part[lane];
  to.x[i] = from.x[lane];
  to.y[i] = from.y[lane];
  to.z[i] = from.z[lane];
  to.normal_x[i] = from.normal_x[lane];
  to.normal_y[i] = from.normal_y[lane];
  to.normal_z[i] = from.normal_z[lane];
}

/// Whether all lanes have hit one smooth surface.
bool isPlain(const SurfacePacket& surfaces) {
  constexpr float kCosineOfCrease = 0.97F;
  constexpr float kDepthStep = 0.03F;
  bool is_plain = surfaces.hit.part[0] >= 0;
  for (std::size_t i = 1; i < kPacketSize; ++i) {
    const float cosine = surfaces.normal_x[i] * surfaces.normal_x[0] + surfaces.normal_y[i] * surfaces.normal_y[0] +
                         surfaces.normal_z[i] * surfaces.normal_z[0];
    is_plain = is_plain && surfaces.hit.part[i] == surfaces.hit.part[0] && cosine > kCosineOfCrease &&
               std::abs(surfaces.depth_m[i] - surfaces.depth_m[i - 1]) < kDepthStep * surfaces.depth_m[0] + kDepthStep;
  }
  return is_plain;
}

/// Calls visit(neighbour) for the packets above, below, left and right of one.
template <class Visit>
void forEachNeighbour(int packet, int columns, int count, const Visit& visit) {
  const int column = packet % columns;
  if (column > 0) {
    visit(static_cast<std::size_t>(packet - 1));
  }
  if (column + 1 < columns) {
    visit(static_cast<std::size_t>(packet + 1));
  }
  if (packet >= columns) {
    visit(static_cast<std::size_t>(packet - columns));
  }
  if (packet + columns < count) {
    visit(static_cast<std::size_t>(packet + columns));
  }
}

}  // namespace

std::uint8_t facingLanes(const PointLight& lamp, const SurfacePacket& surfaces) {
  const Eigen::Vector3f at = lamp.position_map.cast<float>();
  Lanes<std::int32_t> faces;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    const float x = at.x() - surfaces.x[i];
    const float y = at.y() - surfaces.y[i];
    const float z = at.z() - surfaces.z[i];
    const float along = x * surfaces.normal_x[i] + y * surfaces.normal_y[i] + z * surfaces.normal_z[i];
    const bool is_near = x * x + y * y + z * z < lamp.reach_m * lamp.reach_m;
    faces[i] = (surfaces.hit.part[i] >= 0) & (along > kShadowOffset_m) & is_near ? 1 << i : 0;
  }
  std::int32_t bits = 0;
  for (const std::int32_t bit : faces) {
    bits |= bit;
  }
  return static_cast<std::uint8_t>(bits);
}

std::uint8_t traceLamp(const EmbreeScene& embree, const PointLight& lamp, const SurfacePacket& surfaces, std::uint8_t lanes) {
  if (lanes == 0) {
    return 0;
  }
  const Eigen::Vector3f at = lamp.position_map.cast<float>();
  RayPacket rays;
  for (std::size_t i = 0; i < kPacketSize; ++i) {
    rays.origin_x[i] = surfaces.x[i] + kShadowOffset_m * surfaces.normal_x[i];
    rays.origin_y[i] = surfaces.y[i] + kShadowOffset_m * surfaces.normal_y[i];
    rays.origin_z[i] = surfaces.z[i] + kShadowOffset_m * surfaces.normal_z[i];
    rays.direction_x[i] = at.x() - rays.origin_x[i];
    rays.direction_y[i] = at.y() - rays.origin_y[i];
    rays.direction_z[i] = at.z() - rays.origin_z[i];
    rays.near[i] = 0.0F;
    rays.far[i] = 1.0F - kLampSize;
    rays.valid[i] = (static_cast<unsigned>(lanes) >> i & 1U) != 0 ? -1 : 0;
  }
  return static_cast<std::uint8_t>(lanes & ~static_cast<unsigned>(embree.occluded(rays)));
}

void LampVisibility::find(Block& block) const {
  std::vector<std::uint8_t> is_plain(block.packets.size());
  std::transform(block.packets.begin(), block.packets.end(), is_plain.begin(), [](const SurfacePacket& p) { return isPlain(p) ? 1 : 0; });
  block.lit.assign(lighting_.lamps.size(), std::vector<std::uint8_t>(block.packets.size()));
  for (std::size_t i = 0; i < lighting_.lamps.size(); ++i) {
    findOf(lighting_.lamps[i], is_plain, block, block.lit[i]);
  }
}

void LampVisibility::findOf(const PointLight& lamp, const std::vector<std::uint8_t>& is_plain, const Block& block,
                            std::vector<std::uint8_t>& lit) const {
  const auto count = static_cast<int>(block.packets.size());
  // 1. one ray for each packet: lit as a whole, or not
  for (int first = 0; first < count; first += kPacketSize) {
    SurfacePacket stands{};
    const int used = std::min(kPacketSize, count - first);
    stands.hit.part.fill(-1);
    for (int i = 0; i < used; ++i) {
      const int packet = first + i;
      copyLane(block.packets[static_cast<std::size_t>(packet)], laneThatStandsFor(packet % block.columns, packet / block.columns), stands,
               static_cast<std::size_t>(i));
    }
    const std::uint8_t facing = facingLanes(lamp, stands);
    const std::uint8_t seen = lighting_.has_shadows ? traceLamp(embree_, lamp, stands, facing) : facing;
    for (int i = 0; i < used; ++i) {
      lit[static_cast<std::size_t>(first + i)] = (static_cast<unsigned>(seen) >> i & 1U) != 0 ? kAllLanes : 0;
    }
  }
  if (!lighting_.has_shadows) {
    std::fill(lit.begin(), lit.end(), kAllLanes);
    return;
  }
  // 2. each pixel for itself where that is not certain
  std::vector<int> doubtful;
  std::vector<std::uint8_t> is_doubtful(lit.size(), 0);
  for (int packet = 0; packet < count; ++packet) {
    const std::uint8_t here = lit[static_cast<std::size_t>(packet)];
    bool agree = true;
    forEachNeighbour(packet, block.columns, count, [&](std::size_t other) { agree = agree && lit[other] == here; });
    const bool is_certain = agree && (here == 0 || is_plain[static_cast<std::size_t>(packet)] != 0);
    if (!is_certain) {
      doubtful.push_back(packet);
      is_doubtful[static_cast<std::size_t>(packet)] = 1;
    }
  }
  // 3. and beside what turns out to be partly in shadow
  while (!doubtful.empty()) {
    const int packet = doubtful.back();
    doubtful.pop_back();
    const SurfacePacket& surfaces = block.packets[static_cast<std::size_t>(packet)];
    const std::uint8_t facing = facingLanes(lamp, surfaces);
    const std::uint8_t seen = traceLamp(embree_, lamp, surfaces, facing);
    lit[static_cast<std::size_t>(packet)] = seen;
    if (seen == 0 || seen == facing) {
      continue;
    }
    forEachNeighbour(packet, block.columns, count, [&](std::size_t other) {
      if (is_doubtful[other] == 0) {
        is_doubtful[other] = 1;
        doubtful.push_back(static_cast<int>(other));
      }
    });
  }
}

}  // namespace oikos::render
