// SPDX-License-Identifier: Apache-2.0
// Embree behind plain values. Included by this folder's sources only.
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "core/model/triangle_mesh.h"

namespace oikos::render {

constexpr int kPacketSize = 8;

template <typename Number>
using Lanes = std::array<Number, kPacketSize>;

/// Eight rays, each number beside its like, as vector instructions want it. A direction has its z of the camera frame 1 m, so a distance is
/// a depth.
struct alignas(32) RayPacket {
  Lanes<float> origin_x, origin_y, origin_z;           ///< map
  Lanes<float> direction_x, direction_y, direction_z;  ///< map
  Lanes<float> near;
  Lanes<float> far;
  Lanes<std::int32_t> valid{};  ///< -1: a ray, 0: none
};

struct alignas(32) HitPacket {
  Lanes<std::int32_t> part;  ///< -1: nothing
  Lanes<std::uint32_t> triangle;
  Lanes<float> distance;  ///< in lengths of the ray's direction
  Lanes<float> u;         ///< barycentric, of the triangle's second corner
  Lanes<float> v;         ///< of its third
};

/// Parts as instances of their meshes: one search tree a mesh, one over the instances.
class EmbreeScene {
 public:
  EmbreeScene();
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Parts are numbered in the order of these calls. The mesh is not read after the call; the same address means the same mesh.
  void addPart(const model::TriangleMesh& mesh_part);
  void movePart(int part, const Eigen::Isometry3d& T_map_part);
  void showPart(int part, bool is_shown);
  void commit();

  /// The nearest hit of each valid ray. Thread-safe between commits.
  void intersect(const RayPacket& rays, HitPacket& hits) const;
  /// Of which valid rays something lies between `near` and `far`: a bit each, the first ray's the lowest. Thread-safe between commits.
  [[nodiscard]] std::uint8_t occluded(const RayPacket& rays) const;

 private:
  RTCScene treeOf(const model::TriangleMesh& mesh_part);
  void check() const;

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::map<const model::TriangleMesh*, RTCScene> trees_;
  std::vector<RTCGeometry> instances_;
};

}  // namespace oikos::render
