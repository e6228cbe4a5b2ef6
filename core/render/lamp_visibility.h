// SPDX-License-Identifier: Apache-2.0
// Which lamps shine on what is seen. Included by this folder's sources only.
#pragma once

#include <cstdint>
#include <vector>

#include "core/render/ray_caster.h"

namespace oikos::render {

/// Which lanes of a packet face a lamp within its reach: a bit each.
[[nodiscard]] std::uint8_t facingLanes(const PointLight& lamp, const SurfacePacket& surfaces);

/// Which of `lanes` a lamp shines on: one ray each.
[[nodiscard]] std::uint8_t traceLamp(const EmbreeScene& embree, const PointLight& lamp, const SurfacePacket& surfaces, std::uint8_t lanes);

/// Lamps over a block of neighbouring packets that lie in rows. One ray a packet goes to each lamp; only where neighbours see a lamp
/// differently, or where a packet holds more than one surface, does each pixel ask for itself, and so does what lies beside such a packet
/// that is partly in shadow: a shadow's border is followed. A shadow that is smaller than a packet and touches no border can be missed.
/// Immutable, so thread-safe.
class LampVisibility {
 public:
  LampVisibility(const EmbreeScene& embree, const Lighting& lighting) : embree_(embree), lighting_(lighting) {}

  struct Block {
    std::vector<SurfacePacket> packets;  ///< row by row
    int columns = 0;
    std::vector<std::vector<std::uint8_t>> lit;  ///< by lamp, then by packet: a bit a lane
  };
  /// Fills `lit`.
  void find(Block& block) const;

 private:
  void findOf(const PointLight& lamp, const std::vector<std::uint8_t>& is_plain, const Block& block, std::vector<std::uint8_t>& lit) const;

  const EmbreeScene& embree_;
  const Lighting& lighting_;
};

}  // namespace oikos::render
