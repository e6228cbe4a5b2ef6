// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>

#include "core/base/read_file.h"
#include "core/model/mesh_file.h"
#include "core/model/primitives.h"
#include "tests/core/model/mesh_samples.h"
#include "tests/support/expect_error.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace oikos::model {
namespace {

/// Triangle by triangle, corner by corner. The numbers are written exactly; Assimp reads them to about a unit in the last place.
void expectSameSurface(const TriangleMesh& read, const TriangleMesh& written) {
  constexpr float kTolerance = 1e-6F;
  ASSERT_TRUE(validate(read).empty());
  ASSERT_EQ(read.triangles.size(), written.triangles.size());
  ASSERT_EQ(read.normals.empty(), written.normals.empty());
  ASSERT_EQ(read.texture_coordinates.empty(), written.texture_coordinates.empty());
  ASSERT_EQ(read.vertex_colors.empty(), written.vertex_colors.empty());
  for (std::size_t i = 0; i < read.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = read.triangles[i][corner];
      const std::uint32_t b = written.triangles[i][corner];
      ASSERT_LE((read.vertices[a] - written.vertices[b]).norm(), kTolerance) << "triangle " << i;
      if (!read.normals.empty()) {
        ASSERT_LE((read.normals[a] - written.normals[b]).norm(), kTolerance) << "triangle " << i;
      }
      if (!read.texture_coordinates.empty()) {
        ASSERT_LE((read.texture_coordinates[a] - written.texture_coordinates[b]).norm(), kTolerance) << "triangle " << i;
      }
      if (!read.vertex_colors.empty()) {
        ASSERT_EQ(read.vertex_colors[a], written.vertex_colors[b]) << "triangle " << i;
      }
    }
    ASSERT_EQ(read.materialOf(i).name, written.materialOf(i).name);
    ASSERT_LE((read.materialOf(i).color_rgb - written.materialOf(i).color_rgb).norm(), kTolerance);
    ASSERT_EQ(read.materialOf(i).texture.empty(), written.materialOf(i).texture.empty());
  }
}

TriangleMesh paintedFurniture() {
  TriangleMesh mesh = makeBox({0.6F, 0.4F, 1.8F});
  mesh.materials = {{.name = "oak", .color_rgb = {0.9F, 0.8F, 0.7F}, .texture = samples::texture()},
                    {.name = "steel", .color_rgb = {0.123456F, 0.2F, 1.0F / 3.0F}, .texture = {}},
                    {.name = "dark_oak", .color_rgb = {0.3F, 0.3F, 0.3F}, .texture = {}}};
  mesh.materials[2].texture = mesh.materials[0].texture;
  mesh.triangle_materials = {0, 0, 0, 0, 1, 1, 0, 0, 2, 2, 1, 0};
  return mesh;
}

TEST(WriteObj, WhatIsWrittenIsReadBack) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "cupboard.obj";
  const TriangleMesh mesh = paintedFurniture();
  writeObj(mesh, file);
  const auto [read, warnings] = readMesh(file);
  EXPECT_TRUE(warnings.empty());
  expectSameSurface(read, mesh);
  samples::expectTexture(read.materialOf(0).texture);
  samples::expectTexture(read.materialOf(8).texture);
  EXPECT_EQ(read.materialOf(0).texture.data, read.materialOf(8).texture.data);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "cupboard_1.png"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "cupboard_2.png"));
}

TEST(WriteObj, EveryCombinationOfListsIsReadBack) {
  const test::TemporaryFolder folder;
  TriangleMesh full = makeSphere({.radius_m = 0.37F, .rings = 9});
  full.materials = {{.name = "plain", .color_rgb = {1.0F, 1.0F, 1.0F}, .texture = {}}};
  full.texture_coordinates.clear();
  for (std::size_t i = 0; i < full.vertices.size(); ++i) {
    full.texture_coordinates.emplace_back(0.001F * static_cast<float>(i), 1.0F - 0.002F * static_cast<float>(i));
    full.vertex_colors.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(3 * i)});
  }
  for (int left_out = 0; left_out < 8; ++left_out) {
    SCOPED_TRACE(left_out);
    TriangleMesh mesh = full;
    if ((left_out & 1) != 0) {
      mesh.normals.clear();
    }
    if ((left_out & 2) != 0) {
      mesh.texture_coordinates.clear();
    }
    if ((left_out & 4) != 0) {
      mesh.vertex_colors.clear();
    }
    const auto file = folder.path() / "sphere.obj";
    writeObj(mesh, file);
    expectSameSurface(readMesh(file).mesh_model, mesh);
  }
}

TEST(WriteObj, TheSameBytesInEveryLocale) {
  const test::TemporaryFolder folder;
  const std::string before = std::setlocale(LC_ALL, nullptr);
  writeObj(paintedFurniture(), folder.path() / "a.obj");
  const std::string plain = base::readFile(folder.path() / "a.obj") + base::readFile(folder.path() / "a.mtl");
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", ""}) {
    std::setlocale(LC_ALL, name);  // where it is not installed, nothing changes
    writeObj(paintedFurniture(), folder.path() / "a.obj");
    EXPECT_EQ(base::readFile(folder.path() / "a.obj") + base::readFile(folder.path() / "a.mtl"), plain);
    EXPECT_EQ(readMesh(folder.path() / "a.obj").mesh_model.bounds().max().z(), 0.9F);
  }
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_NE(plain.find("Kd 0.123456 0.2 0.33333334\n"), std::string::npos) << plain.substr(0, 300);
}

TEST(WriteObj, NamesThatObjCannotHold) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh = makeBox({1.0F, 1.0F, 1.0F});
  const auto material = [](const std::string& name) { return Material{.name = name, .color_rgb = {0.1F, 0.2F, 0.3F}, .texture = {}}; };
  mesh.materials = {material("light oak\n#1"), material(""), material("oak"), material("oak"), material("oak_2")};
  mesh.triangle_materials = {0, 1, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0};
  writeObj(mesh, folder.path() / "a.obj");
  const auto [read, warnings] = readMesh(folder.path() / "a.obj");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 5; ++i) {
    names.push_back(read.materialOf(i).name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"light_oak__1", "material", "oak", "oak_2", "oak_2_2"}));
}

TEST(WriteObj, AFullDiskLeavesTheOldModel) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "a.obj";
  writeObj(makeBox({1.0F, 1.0F, 1.0F}), file);
  const std::string old = base::readFile(file);
  {
    const test::FileSizeLimit limit(1024);
    test::expectError(base::ErrorCode::kIo, {"a.obj"}, [&] { writeObj(makeSphere({.radius_m = 1.0F, .rings = 30}), file); });
  }
  EXPECT_EQ(base::readFile(file), old);
  test::expectError(base::ErrorCode::kIo, {"/no/such/folder"}, [] { writeObj(makeBox({1.0F, 1.0F, 1.0F}), "/no/such/folder/a.obj"); });
}

TEST(WriteObj, AMeshThatFitsNotTogetherIsABug) {
  TriangleMesh mesh = makeBox({1.0F, 1.0F, 1.0F});
  mesh.normals.pop_back();
  EXPECT_THROW(writeObj(mesh, "/tmp/never.obj"), base::ContractViolation);
  EXPECT_THROW(writeObj(makeBox({1.0F, 1.0F, 1.0F}), "/tmp/never.ply"), base::ContractViolation);
}

}  // namespace
}  // namespace oikos::model
