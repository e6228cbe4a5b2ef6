// SPDX-License-Identifier: Apache-2.0
#include "core/model/mesh_weld.h"

#include <functional>
#include <limits>

namespace oikos::model {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

template <typename Value>
bool sameAt(const std::vector<Value>& values, std::uint32_t a, std::uint32_t b) {
  return values.empty() || values[a] == values[b];
}

bool sameVertex(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return sameAt(mesh.vertices, a, b) && sameAt(mesh.normals, a, b) && sameAt(mesh.texture_coordinates, a, b) &&
         sameAt(mesh.vertex_colors, a, b);
}

/// 0 and -0 are equal and must hash alike.
std::size_t hashOf(const TriangleMesh& mesh, std::uint32_t vertex) {
  std::uint64_t hash = 1469598103934665603U;
  const auto mix = [&](float number) {
    hash = (hash ^ std::hash<float>{}(number + 0.0F)) * 1099511628211U;
    hash ^= hash >> 29U;
  };
  for (const float coordinate : mesh.vertices[vertex]) {
    mix(coordinate);
  }
  for (int i = 0; i < 2 && !mesh.texture_coordinates.empty(); ++i) {
    mix(mesh.texture_coordinates[vertex][i]);
  }
  for (int i = 0; i < 3 && !mesh.normals.empty(); ++i) {
    mix(mesh.normals[vertex][i]);
  }
  for (int i = 0; i < 3 && !mesh.vertex_colors.empty(); ++i) {
    mix(mesh.vertex_colors[vertex][static_cast<std::size_t>(i)]);
  }
  return hash;
}

/// The first vertex that is the same, for each that a triangle uses.
class FirstOfKind {
 public:
  explicit FirstOfKind(const TriangleMesh& mesh) : mesh_(mesh) {
    std::size_t slots = 16;
    while (slots < 2 * mesh.vertices.size()) {
      slots *= 2;
    }
    slots_.assign(slots, kNone);
  }

  std::uint32_t find(std::uint32_t vertex) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hashOf(mesh_, vertex) & mask;; slot = (slot + 1) & mask) {
      if (slots_[slot] == kNone) {
        slots_[slot] = vertex;
      }
      if (sameVertex(mesh_, slots_[slot], vertex)) {
        return slots_[slot];
      }
    }
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> slots_;
};

template <typename Value>
void pushIfAny(std::vector<Value>& to, const std::vector<Value>& from, std::uint32_t index) {
  if (!from.empty()) {
    to.push_back(from[index]);
  }
}

}  // namespace

TriangleMesh weldVertices(const TriangleMesh& mesh) {
  TriangleMesh welded;
  welded.materials = mesh.materials;
  welded.triangle_materials = mesh.triangle_materials;
  FirstOfKind first_of_kind(mesh);
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kNone);
  for (TriangleMesh::Triangle triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      const std::uint32_t first = first_of_kind.find(corner);
      if (new_index[first] == kNone) {
        new_index[first] = static_cast<std::uint32_t>(welded.vertices.size());
        welded.vertices.push_back(mesh.vertices[first]);
        pushIfAny(welded.normals, mesh.normals, first);
        pushIfAny(welded.texture_coordinates, mesh.texture_coordinates, first);
        pushIfAny(welded.vertex_colors, mesh.vertex_colors, first);
      }
      corner = new_index[first];
    }
    welded.triangles.push_back(triangle);
  }
  return welded;
}

}  // namespace oikos::model
