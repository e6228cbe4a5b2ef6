// SPDX-License-Identifier: Apache-2.0
#include "mapping/volume/mesh_extraction.h"

// The tables use a type that they do not include.
// clang-format off
#include <octomap/octomap_types.h>
#include <octomap/MCTables.h>
// clang-format on

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

#include "core/base/parallel.h"

namespace oikos::mapping {

namespace {

struct Offset {
  int x, y, z;
};
/// The corners and edges of a cell as the tables number them (Paul Bourke, "Polygonising a scalar field", 1994).
constexpr Offset kCorners[8] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
struct CellEdge {
  Offset from;
  int axis;
};
constexpr CellEdge kEdges[12] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 1}, {{0, 1, 0}, 0}, {{0, 0, 0}, 1}, {{0, 0, 1}, 0}, {{1, 0, 1}, 1},
                                 {{0, 1, 1}, 0}, {{0, 0, 1}, 1}, {{0, 0, 0}, 2}, {{1, 0, 0}, 2}, {{1, 1, 0}, 2}, {{0, 1, 0}, 2}};

VoxelKey neighbourBrick(VoxelKey brick, int dx, int dy, int dz) {
  const auto numbers = unpackVoxelKey(brick);
  const auto shifted = [](std::uint16_t number, int bricks) { return static_cast<std::uint16_t>(number + kBrickSide * bricks); };
  return packVoxelKey(shifted(numbers[0], dx), shifted(numbers[1], dy), shifted(numbers[2], dz));
}

/// A brick with one more layer of voxels on its upper sides, from the bricks beside it.
class Neighbourhood {
 public:
  Neighbourhood(const TsdfVolume& volume, VoxelKey brick) : min_weight_(volume.config().min_weight) {
    for (unsigned n = 0; n < 8; ++n) {
      bricks_[n] = volume.find(neighbourBrick(brick, n & 1U, (n >> 1U) & 1U, n >> 2U));
    }
  }

  /// The voxel at 0..8 per axis, or null when it was seen too little.
  [[nodiscard]] const TsdfVoxel* find(Offset at) const {
    const int n = at.x / kBrickSide + 2 * (at.y / kBrickSide) + 4 * (at.z / kBrickSide);
    if (bricks_[n] == nullptr) {
      return nullptr;
    }
    const TsdfVoxel& voxel =
        bricks_[n]->voxels[static_cast<std::size_t>(TsdfBrick::place(at.x % kBrickSide, at.y % kBrickSide, at.z % kBrickSide))];
    return voxel.weight >= min_weight_ ? &voxel : nullptr;
  }

 private:
  const TsdfBrick* bricks_[8];
  int min_weight_;
};

bool isInside(const TsdfVoxel& voxel) {
  return voxel.distance < 0;
}

/// The vertices on the edges that start in a brick: which edges (axis by axis, place by place) and where the first one lies in
/// the mesh.
struct BrickVertices {
  static constexpr std::size_t kWordsPerAxis = kBrickVoxels / 64;
  std::array<std::uint64_t, 3 * kWordsPerAxis> edges{};
  std::array<std::uint16_t, 3 * kWordsPerAxis> before{};  ///< vertices in the words before
  std::uint32_t first = 0;
  geometry::ColoredCloud cloud;

  void add(int axis, int place) {
    edges[static_cast<std::size_t>(axis) * kWordsPerAxis + static_cast<std::size_t>(place) / 64] |= std::uint64_t{1} << (place % 64);
  }
  void finish() {
    for (std::size_t word = 1; word < edges.size(); ++word) {
      before[word] = static_cast<std::uint16_t>(before[word - 1] + std::popcount(edges[word - 1]));
    }
  }
  [[nodiscard]] std::uint32_t indexOf(int axis, int place) const {
    const std::size_t word = static_cast<std::size_t>(axis) * kWordsPerAxis + static_cast<std::size_t>(place) / 64;
    const std::uint64_t below = (std::uint64_t{1} << (place % 64)) - 1;
    return first + before[word] + static_cast<std::uint32_t>(std::popcount(edges[word] & below));
  }
};

struct LatticeEdge {
  Eigen::Vector3f from;  ///< centre of the voxel it starts at
  Eigen::Vector3f along;
};

bool hasColor(const TsdfVoxel& voxel) {
  return (voxel.rgb_256[0] | voxel.rgb_256[1] | voxel.rgb_256[2]) != 0;
}

/// Where the distance is 0; coloured by the one voxel when the other was only ever seen as free space.
void addVertex(const TsdfVoxel& a, const TsdfVoxel& b, const LatticeEdge& edge, geometry::ColoredCloud& cloud) {
  const float t = static_cast<float>(a.distance) / static_cast<float>(a.distance - b.distance);
  cloud.points.push_back(edge.from + t * edge.along);
  const float share_b = !hasColor(a) ? 1.0F : !hasColor(b) ? 0.0F : t;
  geometry::Rgb color;
  for (std::size_t c = 0; c < 3; ++c) {
    const float mixed = (1.0F - share_b) * static_cast<float>(a.rgb_256[c]) + share_b * static_cast<float>(b.rgb_256[c]);
    color[c] = static_cast<std::uint8_t>(std::min(255.0F, mixed / 256.0F + 0.5F));
  }
  cloud.colors.push_back(color);
}

void findVertices(const TsdfVolume& volume, VoxelKey brick, BrickVertices& vertices) {
  const Neighbourhood voxels(volume, brick);
  const Eigen::Vector3f origin = volume.lattice().center(brick);
  const auto voxel_m = static_cast<float>(volume.config().voxel_m);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3f along = voxel_m * Eigen::Vector3f::Unit(axis);
    for (int place = 0; place < kBrickVoxels; ++place) {
      const Offset at{place % kBrickSide, place / kBrickSide % kBrickSide, place / (kBrickSide * kBrickSide)};
      const TsdfVoxel* a = voxels.find(at);
      const TsdfVoxel* b = a == nullptr ? nullptr : voxels.find({at.x + (axis == 0), at.y + (axis == 1), at.z + (axis == 2)});
      if (b != nullptr && isInside(*a) != isInside(*b)) {
        const Eigen::Vector3f offset(static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z));
        vertices.add(axis, place);
        addVertex(*a, *b, {origin + voxel_m * offset, along}, vertices.cloud);
      }
    }
  }
  vertices.finish();
}

/// The cell's case in the tables, or nothing where a corner was seen too little.
std::optional<unsigned> findCase(const Neighbourhood& voxels, Offset at) {
  unsigned number = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const TsdfVoxel* voxel = voxels.find({at.x + kCorners[corner].x, at.y + kCorners[corner].y, at.z + kCorners[corner].z});
    if (voxel == nullptr) {
      return std::nullopt;
    }
    number |= isInside(*voxel) ? 1U << corner : 0U;
  }
  return number;
}

class TriangleFinder {
 public:
  TriangleFinder(const TsdfVolume& volume, const std::vector<BrickVertices>& vertices) : volume_(volume), vertices_(vertices) {}

  void find(VoxelKey brick, std::vector<std::array<std::uint32_t, 3>>& triangles) const {
    const Neighbourhood voxels(volume_, brick);
    const BrickVertices* around[8];
    for (unsigned n = 0; n < 8; ++n) {
      const auto number = volume_.index().find(neighbourBrick(brick, n & 1U, (n >> 1U) & 1U, n >> 2U));
      around[n] = number ? &vertices_[*number] : nullptr;
    }
    for (int place = 0; place < kBrickVoxels; ++place) {
      const Offset at{place % kBrickSide, place / kBrickSide % kBrickSide, place / (kBrickSide * kBrickSide)};
      const auto number = findCase(voxels, at);
      if (!number || *number == 0 || *number == 255) {
        continue;
      }
      for (const int* edge = octomap::triTable[*number]; *edge != -1; edge += 3) {
        // The tables' order is clockwise seen from the corners outside.
        addTriangle({vertexOn(around, at, edge[0]), vertexOn(around, at, edge[2]), vertexOn(around, at, edge[1])}, triangles);
      }
    }
  }

 private:
  static std::uint32_t vertexOn(const BrickVertices* const around[8], Offset at, int edge) {
    const Offset from{at.x + kEdges[edge].from.x, at.y + kEdges[edge].from.y, at.z + kEdges[edge].from.z};
    const int n = from.x / kBrickSide + 2 * (from.y / kBrickSide) + 4 * (from.z / kBrickSide);
    return around[n]->indexOf(kEdges[edge].axis, TsdfBrick::place(from.x % kBrickSide, from.y % kBrickSide, from.z % kBrickSide));
  }

  static void addTriangle(const std::array<std::uint32_t, 3>& corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
      triangles.push_back(corners);
    }
  }

  const TsdfVolume& volume_;
  const std::vector<BrickVertices>& vertices_;
};

std::uint32_t findRoot(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
  while (parents[vertex] != vertex) {
    parents[vertex] = parents[parents[vertex]];
    vertex = parents[vertex];
  }
  return vertex;
}

/// For each vertex, one vertex that stands for its connected piece.
std::vector<std::uint32_t> findPieces(const geometry::ColoredMesh& mesh) {
  std::vector<std::uint32_t> parents(mesh.vertices.points.size());
  std::iota(parents.begin(), parents.end(), 0U);
  for (const auto& triangle : mesh.triangles) {
    for (const std::size_t corner : {1U, 2U}) {
      const std::uint32_t a = findRoot(parents, triangle[0]);
      const std::uint32_t b = findRoot(parents, triangle[corner]);
      parents[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t vertex = 0; vertex < parents.size(); ++vertex) {
    parents[vertex] = findRoot(parents, vertex);
  }
  return parents;
}

void removeUnusedVertices(geometry::ColoredMesh& mesh) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFF;
  std::vector<std::uint32_t> places(mesh.vertices.points.size(), kUnused);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      places[corner] = 0;
    }
  }
  std::uint32_t next = 0;
  for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
    if (places[vertex] != kUnused) {
      mesh.vertices.points[next] = mesh.vertices.points[vertex];
      mesh.vertices.colors[next] = mesh.vertices.colors[vertex];
      places[vertex] = next++;
    }
  }
  mesh.vertices.points.resize(next);
  mesh.vertices.colors.resize(next);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      corner = places[corner];
    }
  }
}

}  // namespace

geometry::ColoredMesh extractMesh(const TsdfVolume& volume, int threads) {
  const std::vector<std::uint32_t> order = volume.index().sorted();
  const int count = static_cast<int>(order.size());
  std::vector<BrickVertices> vertices(order.size());
  base::parallelFor(count, threads, [&](int i) {
    const std::uint32_t number = order[static_cast<std::size_t>(i)];
    findVertices(volume, volume.index().key(number), vertices[number]);
  });
  geometry::ColoredMesh mesh;
  for (const std::uint32_t number : order) {
    BrickVertices& mine = vertices[number];
    mine.first = static_cast<std::uint32_t>(mesh.vertices.points.size());
    mesh.vertices.points.insert(mesh.vertices.points.end(), mine.cloud.points.begin(), mine.cloud.points.end());
    mesh.vertices.colors.insert(mesh.vertices.colors.end(), mine.cloud.colors.begin(), mine.cloud.colors.end());
    mine.cloud = {};
  }
  const TriangleFinder finder(volume, vertices);
  std::vector<std::vector<std::array<std::uint32_t, 3>>> triangles(order.size());
  base::parallelFor(count, threads, [&](int i) {
    const auto slot = static_cast<std::size_t>(i);
    finder.find(volume.index().key(order[slot]), triangles[slot]);
  });
  for (auto& mine : triangles) {
    mesh.triangles.insert(mesh.triangles.end(), mine.begin(), mine.end());
    mine = {};
  }
  removeUnusedVertices(mesh);
  return mesh;
}

void removeSpecks(int min_triangles, geometry::ColoredMesh& mesh) {
  const std::vector<std::uint32_t> pieces = findPieces(mesh);
  std::vector<int> sizes(pieces.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    ++sizes[pieces[triangle[0]]];
  }
  std::erase_if(mesh.triangles, [&](const auto& triangle) { return sizes[pieces[triangle[0]]] < min_triangles; });
  removeUnusedVertices(mesh);
}

}  // namespace oikos::mapping
