// SPDX-License-Identifier: Apache-2.0
#include "core/model/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/recording/image_codec.h"
#include "tests/core/model/mesh_samples.h"
#include "tests/support/temporary_folder.h"

namespace oikos::model {
namespace {

using samples::expectCorner;

class ReadMesh : public testing::Test {
 protected:
  [[nodiscard]] MeshFile read(const std::string& name, const std::string& content) const { return readMesh(folder_.write(name, content)); }
  test::TemporaryFolder folder_;
};

/// The texture coordinate of the vertex that is nearest to a place.
Eigen::Vector2f textureCoordinateAt(const TriangleMesh& mesh, const Eigen::Vector3f& place) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    nearest = (mesh.vertices[i] - place).norm() < (mesh.vertices[nearest] - place).norm() ? i : nearest;
  }
  return mesh.texture_coordinates.at(nearest);
}

geometry::Rgb colorAt(const TriangleMesh& mesh, const Eigen::Vector3f& place) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    nearest = (mesh.vertices[i] - place).norm() < (mesh.vertices[nearest] - place).norm() ? i : nearest;
  }
  return mesh.vertex_colors.at(nearest);
}

TEST_F(ReadMesh, ObjIsTakenAsItIs) {
  const auto [mesh, warnings] = read("a.obj", samples::kObjShape);
  expectCorner(mesh);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(mesh.vertices.size(), 4U);
  ASSERT_EQ(mesh.materials.size(), 1U);
  EXPECT_EQ(mesh.materials[0].color_rgb, Material{}.color_rgb);
}

TEST_F(ReadMesh, ObjWithMaterialsAndTextures) {
  folder_.write("textures/wood grain.png", samples::texturePng());
  folder_.write("a.mtl", "newmtl red\nKd 1 0.25 0\nnewmtl wood\nKd 0.5 1 1\nmap_Kd textures\\wood grain.png\n");
  const auto [mesh, warnings] = read("a.OBJ",
                                     "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nvt 0.25 0\nvt 1 0\nvt 0 1\nvt 0.5 0.75\n"
                                     "usemtl red\nf 1 3 2\nf 1 2 4\nusemtl wood\nf 1/1 4/4 3/3\nf 2/2 3/3 4/4\n");
  expectCorner(mesh);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(mesh.materialOf(0).name, "red");
  EXPECT_EQ(mesh.materialOf(1).color_rgb, Eigen::Vector3f(1.0F, 0.25F, 0.0F));
  EXPECT_TRUE(mesh.materialOf(1).texture.empty());
  EXPECT_EQ(mesh.materialOf(2).name, "wood");
  EXPECT_EQ(mesh.materialOf(3).color_rgb, Eigen::Vector3f(0.5F, 1.0F, 1.0F));
  samples::expectTexture(mesh.materialOf(3).texture);
  const std::uint32_t top = mesh.triangles[3][2];
  EXPECT_LT((mesh.vertices[top] - Eigen::Vector3f(0.0F, 0.0F, 3.0F)).norm(), 1e-6F);
  EXPECT_LT((mesh.texture_coordinates[top] - Eigen::Vector2f(0.5F, 0.75F)).norm(), 1e-6F);
}

TEST_F(ReadMesh, ObjPolygonsAndVertexColors) {
  const auto [mesh, warnings] =
      read("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nv 0.5 1.5 0 0 0 0\nf 1 2 3 5 4\n");
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(colorAt(mesh, {1.0F, 0.0F, 0.0F}), (geometry::Rgb{0, 255, 0}));
  EXPECT_EQ(mesh.materialOf(0).color_rgb, Eigen::Vector3f::Ones());
  double area_sq = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    EXPECT_GT(mesh.areaNormal(i).z(), 0.0);
    area_sq += 0.5 * mesh.areaNormal(i).z();
  }
  EXPECT_NEAR(area_sq, 1.25, 1e-6);
}

TEST_F(ReadMesh, PlyWithColors) {
  const auto [mesh, warnings] = read("a.ply", samples::kPly);
  expectCorner(mesh);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(colorAt(mesh, {0.0F, 0.0F, 0.0F}), (geometry::Rgb{10, 20, 30}));
  EXPECT_EQ(colorAt(mesh, {0.0F, 0.0F, 3.0F}), (geometry::Rgb{0, 0, 255}));
  EXPECT_EQ(mesh.materialOf(0).color_rgb, Eigen::Vector3f::Ones());
}

TEST_F(ReadMesh, StlSharesItsCorners) {
  const auto [mesh, warnings] = read("a.stl", samples::kStl);
  expectCorner(mesh);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(mesh.materialOf(0).color_rgb, Material{}.color_rgb);
}

TEST_F(ReadMesh, BinaryStl) {
  std::string bytes(80, ' ');
  samples::appendBytes(bytes, std::uint32_t{4});
  const std::array<std::array<float, 3>, 4> corners = {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}};
  for (const auto& triangle : std::array<std::array<std::size_t, 3>, 4>{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}) {
    samples::appendBytes(bytes, std::array<float, 3>{});
    for (const std::size_t corner : triangle) {
      samples::appendBytes(bytes, corners[corner]);
    }
    samples::appendBytes(bytes, std::uint16_t{0});
  }
  expectCorner(read("a.stl", bytes).mesh_model);
}

TEST_F(ReadMesh, ColladaEndsInZUpAndMetresWhateverItsAxes) {
  struct Case {
    const char* asset;
    const char* positions;
    Eigen::Vector3f at;
    float scale;
  };
  // The shape's corners, in z up: (0 0 0), (1 0 0), (0 2 0), (0 0 3). X_UP has x up, y to the left and z towards the viewer.
  const std::vector<Case> cases = {
      {"<up_axis>Z_UP</up_axis>", "0 0 0 1 0 0 0 2 0 0 0 3", {10.0F, 0.0F, 0.0F}, 1.0F},
      {"<up_axis>Y_UP</up_axis>", "0 0 0 1 0 0 0 0 -2 0 3 0", {10.0F, 0.0F, 0.0F}, 1.0F},
      {"", "0 0 0 1 0 0 0 0 -2 0 3 0", {10.0F, 0.0F, 0.0F}, 1.0F},
      {"<up_axis>X_UP</up_axis>", "0 0 0 0 -1 0 0 0 -2 3 0 0", {0.0F, 0.0F, 10.0F}, 1.0F},
      {"<unit name=\"inch\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis>", "0 0 0 1 0 0 0 2 0 0 0 3", {0.254F, 0.0F, 0.0F}, 0.0254F},
      {"<unit meter=\"0.01\"/><up_axis>Y_UP</up_axis>", "0 0 0 1 0 0 0 0 -2 0 3 0", {0.1F, 0.0F, 0.0F}, 0.01F}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.asset);
    const auto [mesh, warnings] = read("a.dae", samples::collada(c.asset, c.positions));
    expectCorner(mesh, c.at, c.scale);
    EXPECT_EQ(mesh.materialOf(0).name, "orange");
    EXPECT_EQ(mesh.materialOf(0).color_rgb, Eigen::Vector3f(1.0F, 0.5F, 0.0F));
    EXPECT_TRUE(warnings.empty());
  }
}

TEST_F(ReadMesh, ColladaTextureStandsInPlaceOfTheColor) {
  folder_.write("wood.png", samples::texturePng());
  const auto [mesh, warnings] =
      read("a.dae", samples::collada("<up_axis>Z_UP</up_axis>", "0 0 0 1 0 0 0 2 0 0 0 3", R"(<texture texture="t" texcoord="UVSET0"/>)"));
  EXPECT_EQ(mesh.materialOf(0).color_rgb, Eigen::Vector3f::Ones());
  samples::expectTexture(mesh.materialOf(0).texture);
  EXPECT_LT((textureCoordinateAt(mesh, {10.0F, 2.0F, 0.0F}) - Eigen::Vector2f(0.0F, 1.0F)).norm(), 1e-6F);
}

void expectOak(const MeshFile& read) {
  const TriangleMesh& mesh = read.mesh_model;
  EXPECT_TRUE(read.warnings.empty());
  const Material& oak = mesh.materialOf(0);
  EXPECT_EQ(oak.name, "oak");
  // Linear 0.5 is 0.7354 in sRGB.
  EXPECT_LT((oak.color_rgb - Eigen::Vector3f(0.735357F, 1.0F, 0.0F)).norm(), 1e-5F) << oak.color_rgb.transpose();
  samples::expectTexture(oak.texture);
  // glTF's texture coordinates begin at the upper left corner.
  EXPECT_LT((textureCoordinateAt(mesh, mesh.bounds().min()) - Eigen::Vector2f(0.25F, 1.0F)).norm(), 1e-6F);
  const Eigen::Vector3f along_x(mesh.bounds().max().x(), mesh.bounds().min().y(), mesh.bounds().min().z());
  EXPECT_EQ(colorAt(mesh, along_x), (geometry::Rgb{0, 188, 0}));
}

TEST_F(ReadMesh, GlbWithAnEmbeddedTextureIsTurnedToZUp) {
  const std::string png = samples::texturePng();
  const std::string json = samples::gltfJson("", R"("bufferView":4,"mimeType":"image/png")", "", png.size());
  const MeshFile mesh = read("a.glb", samples::glb(json, samples::gltfBuffer() + png));
  expectCorner(mesh.mesh_model);
  expectOak(mesh);
}

TEST_F(ReadMesh, GltfWithFilesBesideIt) {
  folder_.write("parts/a shape.bin", samples::gltfBuffer());
  folder_.write("parts/w%.png", samples::texturePng());
  const MeshFile mesh = read("a.gltf", samples::gltfJson(R"(,"uri":"parts/a%20shape.bin")", R"("uri":"parts/w%25.png")", ""));
  expectCorner(mesh.mesh_model);
  expectOak(mesh);
}

TEST_F(ReadMesh, NodesPlaceTheirMeshes) {
  folder_.write("a.bin", samples::gltfBuffer());
  folder_.write("w.png", samples::texturePng());
  const auto placed = [&](const std::string& node) {
    return read("a.gltf", samples::gltfJson(R"(,"uri":"a.bin")", R"("uri":"w.png")", "," + node)).mesh_model;
  };
  // glTF's y is our z, its z our -y.
  expectCorner(placed(R"("translation":[5,7,-6])"), {5.0F, 6.0F, 7.0F});
  expectCorner(placed(R"("scale":[0.5,0.5,0.5])"), Eigen::Vector3f::Zero(), 0.5F);
  const TriangleMesh mirrored = placed(R"("scale":[-1,1,1])");
  EXPECT_FLOAT_EQ(mirrored.bounds().min().x(), -1.0F);
  EXPECT_NEAR(samples::volumeM3(mirrored), 1.0, 1e-5);
  const TriangleMesh turned = placed(R"("rotation":[0,0.70710678,0,0.70710678])");  // a quarter turn about the vertical
  EXPECT_LT((turned.bounds().min() - Eigen::Vector3f(-2.0F, 0.0F, 0.0F)).norm(), 1e-5F) << turned.bounds().min().transpose();
  EXPECT_LT((turned.bounds().max() - Eigen::Vector3f(0.0F, 1.0F, 3.0F)).norm(), 1e-5F);
}

TEST_F(ReadMesh, JpegTexture) {
  const cv::Mat gray(16, 16, CV_8UC3, cv::Scalar(90, 90, 90));
  const auto jpeg = recording::encodeJpeg(gray, 95);
  folder_.write("t.jpg", {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
  folder_.write("a.mtl", "newmtl w\nKd 1 1 1\nmap_Kd t.jpg\n");
  const auto [mesh, warnings] = read("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nvt 0 0\nusemtl w\nf 1/1 2/1 3/1\n");
  EXPECT_LE(cv::norm(mesh.materialOf(0).texture, gray, cv::NORM_INF), 2.0);
}

TEST_F(ReadMesh, NormalsAreKeptOrTakenAsFlat) {
  const std::string shape = "v 0 0 0\nv 1 0 0\nv 0 2 0\n";
  const auto smooth = read("a.obj", shape + "vn 0 0 2\nvn 0 1 1\nf 1//1 2//2 3//1\n");
  ASSERT_EQ(smooth.mesh_model.normals.size(), 3U);
  EXPECT_LT((smooth.mesh_model.normals[1] - Eigen::Vector3f(0.0F, 1.0F, 1.0F).normalized()).norm(), 1e-6F);
  const auto none = read("a.obj", shape + "vn 0 0 0\nf 1//1 2//1 3//1\n");
  EXPECT_TRUE(none.mesh_model.normals.empty());
  ASSERT_EQ(none.warnings.size(), 1U);
  EXPECT_NE(none.warnings[0].find("normals without a direction"), std::string::npos);
}

TEST_F(ReadMesh, WarnsOfWhatIsProbablyNotMeant) {
  const auto large = read("a.obj", "v 0 0 0\nv 750 0 0\nv 0 2000 0\nf 1 2 3\n");
  ASSERT_EQ(large.warnings.size(), 1U);
  EXPECT_EQ(large.warnings[0], "is 2000.0 m in size: is it in metres?");
  const auto small = read("a.obj", "v 0 0 0\nv 0.0005 0 0\nv 0 0.0009 0\nf 1 2 3\n");
  ASSERT_EQ(small.warnings.size(), 1U);
  EXPECT_EQ(small.warnings[0], "is 0.000900 m in size: is it in metres?");
  const auto flat = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n");
  EXPECT_EQ(flat.mesh_model.triangles.size(), 1U);
  EXPECT_EQ(flat.mesh_model.vertices.size(), 3U);
  ASSERT_EQ(flat.warnings.size(), 1U);
  EXPECT_EQ(flat.warnings[0], "1 triangles without an area are left out");
  const auto bare = read("a.obj", "mtllib gone.mtl\n" + samples::kObjShape);
  ASSERT_GE(bare.warnings.size(), 1U);
  EXPECT_NE(bare.warnings[0].find("gone.mtl', which is missing; looked for " + folder_.path().string()), std::string::npos)
      << bare.warnings[0];
}

}  // namespace
}  // namespace oikos::model
