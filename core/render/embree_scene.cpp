// SPDX-License-Identifier: Apache-2.0
// Wald et al., "Embree: A Kernel Framework for Efficient CPU Ray Tracing", SIGGRAPH 2014.
//
// One instruction set and packets of one size, so that every machine and every thread computes the same hits; trees are built by the
// calling thread alone.
#include "core/render/embree_scene.h"

#include <algorithm>
#include <string>

#include "core/base/error.h"

namespace oikos::render {

namespace {

template <typename Ray>
void fill(const RayPacket& rays, Ray& ray) {
  const auto copy = [](const Lanes<float>& from, float* to) { std::copy(from.begin(), from.end(), to); };
  copy(rays.origin_x, ray.org_x);
  copy(rays.origin_y, ray.org_y);
  copy(rays.origin_z, ray.org_z);
  copy(rays.direction_x, ray.dir_x);
  copy(rays.direction_y, ray.dir_y);
  copy(rays.direction_z, ray.dir_z);
  copy(rays.near, ray.tnear);
  copy(rays.far, ray.tfar);
  std::fill_n(ray.time, kPacketSize, 0.0F);
  std::fill_n(ray.mask, kPacketSize, ~0U);
  std::fill_n(ray.id, kPacketSize, 0U);
  std::fill_n(ray.flags, kPacketSize, 0U);
}

RTCIntersectContext coherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

template <typename Item>
Item* newBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<Item*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), count));
}

}  // namespace

EmbreeScene::EmbreeScene() : device_(rtcNewDevice("threads=1,isa=avx2")) {
  if (device_ == nullptr) {
    throw base::Error(base::ErrorCode::kIo, "the ray tracer does not start: a processor with AVX2 is needed", "Embree");
  }
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);  // over instances it is built sooner than a low one
}

EmbreeScene::~EmbreeScene() {
  for (const RTCGeometry instance : instances_) {
    rtcReleaseGeometry(instance);
  }
  rtcReleaseScene(scene_);
  for (const auto& [mesh, tree] : trees_) {
    rtcReleaseScene(tree);
  }
  rtcReleaseDevice(device_);
}

void EmbreeScene::check() const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error != RTC_ERROR_NONE) {
    throw base::Error(base::ErrorCode::kIo, "the ray tracer fails with its error " + std::to_string(error), "Embree");
  }
}

RTCScene EmbreeScene::treeOf(const model::TriangleMesh& mesh_part) {
  if (const auto found = trees_.find(&mesh_part); found != trees_.end()) {
    return found->second;
  }
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  using Corner = std::array<float, 3>;
  auto* const corners = newBuffer<Corner>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh_part.vertices.size());
  auto* const triangles =
      newBuffer<model::TriangleMesh::Triangle>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh_part.triangles.size());
  check();
  std::transform(mesh_part.vertices.begin(), mesh_part.vertices.end(), corners, [](const Eigen::Vector3f& vertex) {
    return Corner{vertex.x(), vertex.y(), vertex.z()};
  });
  std::copy(mesh_part.triangles.begin(), mesh_part.triangles.end(), triangles);
  rtcCommitGeometry(geometry);
  const RTCScene tree = rtcNewScene(device_);
  trees_.emplace(&mesh_part, tree);
  rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(tree, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree);
  check();
  return tree;
}

void EmbreeScene::addPart(const model::TriangleMesh& mesh_part) {
  const RTCScene tree = treeOf(mesh_part);
  const RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, tree);
  rtcSetGeometryTimeStepCount(instance, 1);
  rtcAttachGeometryByID(scene_, instance, static_cast<unsigned>(instances_.size()));
  instances_.push_back(instance);
  movePart(static_cast<int>(instances_.size()) - 1, Eigen::Isometry3d::Identity());
}

void EmbreeScene::movePart(int part, const Eigen::Isometry3d& T_map_part) {
  const RTCGeometry instance = instances_[static_cast<std::size_t>(part)];
  const Eigen::Matrix<float, 3, 4> columns = T_map_part.matrix().topRows<3>().cast<float>();
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  rtcCommitGeometry(instance);
}

void EmbreeScene::showPart(int part, bool is_shown) {
  const RTCGeometry instance = instances_[static_cast<std::size_t>(part)];
  is_shown ? rtcEnableGeometry(instance) : rtcDisableGeometry(instance);
  rtcCommitGeometry(instance);
}

void EmbreeScene::commit() {
  rtcCommitScene(scene_);
  check();
}

void EmbreeScene::intersect(const RayPacket& rays, HitPacket& hits) const {
  RTCRayHit8 query;
  fill(rays, query.ray);
  std::fill_n(query.hit.geomID, kPacketSize, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(query.hit.instID[0], kPacketSize, RTC_INVALID_GEOMETRY_ID);
  RTCIntersectContext context = coherentContext();
  rtcIntersect8(rays.valid.data(), scene_, &context, &query);
  for (int i = 0; i < kPacketSize; ++i) {
    const bool is_hit = rays.valid[i] != 0 && query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    hits.part[i] = is_hit ? static_cast<std::int32_t>(query.hit.instID[0][i]) : -1;
    hits.triangle[i] = is_hit ? query.hit.primID[i] : 0;
    hits.distance[i] = query.ray.tfar[i];
    hits.u[i] = query.hit.u[i];
    hits.v[i] = query.hit.v[i];
  }
}

std::uint8_t EmbreeScene::occluded(const RayPacket& rays) const {
  RTCRay8 query;
  fill(rays, query);
  RTCIntersectContext context = coherentContext();
  rtcOccluded8(rays.valid.data(), scene_, &context, &query);
  unsigned bits = 0;
  for (unsigned i = 0; i < kPacketSize; ++i) {
    bits |= (rays.valid[i] != 0 && query.tfar[i] < 0.0F ? 1U : 0U) << i;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace oikos::render
