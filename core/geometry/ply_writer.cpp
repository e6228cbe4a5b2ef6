// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>
#include <ostream>
#include <string>

#include "core/base/error.h"
#include "core/geometry/ply.h"

namespace oikos::geometry {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it lies in memory");

void writeVertexHeader(std::size_t count, bool colored, std::ostream& stream) {
  stream << "ply\nformat binary_little_endian 1.0\nelement vertex " << std::to_string(count)
         << "\nproperty float x\nproperty float y\nproperty float z\n";
  if (colored) {
    stream << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
}

void writeVertex(const Eigen::Vector3f& point, const Rgb* color, std::ostream& stream) {
  char record[3 * sizeof(float) + 3];
  std::memcpy(record, point.data(), 3 * sizeof(float));
  if (color != nullptr) {
    std::memcpy(record + 3 * sizeof(float), color->data(), 3);
  }
  stream.write(record, color != nullptr ? 3 * sizeof(float) + 3 : 3 * sizeof(float));
}

void writeVertices(const ColoredCloud& cloud, std::ostream& stream) {
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    writeVertex(cloud.points[i], cloud.colors.empty() ? nullptr : &cloud.colors[i], stream);
  }
}

void writeVertexHeader(const ColoredCloud& cloud, std::ostream& stream) {
  OIKOS_CHECK(cloud.colors.empty() || cloud.colors.size() == cloud.points.size());
  writeVertexHeader(cloud.points.size(), !cloud.colors.empty(), stream);
}

}  // namespace

PlyCloudWriter::PlyCloudWriter(const std::filesystem::path& file, std::size_t point_count) : target_(file), missing_(point_count) {
  writeVertexHeader(point_count, true, target_.stream());
  target_.stream() << "end_header\n";
}

void PlyCloudWriter::add(const Eigen::Vector3f& point, const Rgb& color) {
  OIKOS_CHECK(missing_ > 0);
  --missing_;
  writeVertex(point, &color, target_.stream());
}

void PlyCloudWriter::commit() {
  OIKOS_CHECK(missing_ == 0);
  target_.commit();
}

void writePly(const ColoredCloud& cloud, const std::filesystem::path& file) {
  base::AtomicFile target(file);
  writeVertexHeader(cloud, target.stream());
  target.stream() << "end_header\n";
  writeVertices(cloud, target.stream());
  target.commit();
}

void writePly(const ColoredMesh& mesh, const std::filesystem::path& file) {
  base::AtomicFile target(file);
  writeVertexHeader(mesh.vertices, target.stream());
  target.stream() << "element face " << std::to_string(mesh.triangles.size()) << "\nproperty list uchar int vertex_indices\nend_header\n";
  writeVertices(mesh.vertices, target.stream());
  for (const auto& triangle : mesh.triangles) {
    char record[1 + 3 * sizeof(std::uint32_t)] = {3};
    std::memcpy(record + 1, triangle.data(), 3 * sizeof(std::uint32_t));
    target.stream().write(record, sizeof(record));
  }
  target.commit();
}

}  // namespace oikos::geometry
