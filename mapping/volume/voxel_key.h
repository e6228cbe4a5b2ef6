// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace oikos::mapping {

/// A voxel's place in a cubic lattice: three 16-bit numbers, x y z, each 32768 at the world's origin (OctoMap's convention), in
/// one word with a gap above each so that a step past 65535 wraps as a 16-bit number does.
using VoxelKey = std::uint64_t;

inline constexpr int kVoxelKeyShift = 21;
inline constexpr VoxelKey kVoxelKeyMask = 0xFFFFULL | (0xFFFFULL << kVoxelKeyShift) | (0xFFFFULL << (2 * kVoxelKeyShift));
inline constexpr int kVoxelKeyOrigin = 32768;

constexpr VoxelKey packVoxelKey(std::uint16_t x, std::uint16_t y, std::uint16_t z) {
  return VoxelKey{x} | (VoxelKey{y} << kVoxelKeyShift) | (VoxelKey{z} << (2 * kVoxelKeyShift));
}
constexpr std::array<std::uint16_t, 3> unpackVoxelKey(VoxelKey key) {
  return {static_cast<std::uint16_t>(key), static_cast<std::uint16_t>(key >> kVoxelKeyShift),
          static_cast<std::uint16_t>(key >> (2 * kVoxelKeyShift))};
}

/// Voxels are stored in bricks of 8×8×8. Inside one they lie in octree (Morton) order, so that every cube of 4 or 2 voxels'
/// side is one run of 64 or 8 places.
inline constexpr int kBrickSide = 8;
inline constexpr int kBrickVoxels = 512;
inline constexpr VoxelKey kBrickMask = packVoxelKey(0xFFF8, 0xFFF8, 0xFFF8);
inline constexpr std::array<std::uint16_t, 8> kMorton = {0, 1, 8, 9, 64, 65, 72, 73};

/// The key of the brick's first voxel.
constexpr VoxelKey brickOf(VoxelKey key) {
  return key & kBrickMask;
}
constexpr unsigned placeInBrick(VoxelKey key) {
  return static_cast<unsigned>(kMorton[key & 7U] | (kMorton[(key >> kVoxelKeyShift) & 7U] << 1U) |
                               (kMorton[(key >> (2 * kVoxelKeyShift)) & 7U] << 2U));
}
/// The offset (0..7 per axis, packed as a key) of a place in its brick.
constexpr VoxelKey offsetOfPlace(unsigned place) {
  const auto axis = [place](unsigned a) {
    return static_cast<std::uint16_t>(((place >> a) & 1U) | ((place >> (a + 2U)) & 2U) | ((place >> (a + 4U)) & 4U));
  };
  return packVoxelKey(axis(0), axis(1), axis(2));
}

}  // namespace oikos::mapping
