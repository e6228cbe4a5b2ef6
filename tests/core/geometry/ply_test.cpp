// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/ply.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>

#include "core/base/error.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace oikos::geometry {
namespace {

std::filesystem::path writeText(const test::TemporaryFolder& folder, const std::string& text) {
  const std::filesystem::path file = folder.path() / "cloud.ply";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// The message of the Error{kInput} that reading this text ends in, without the folder.
std::string failure(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = writeText(folder, text);
  try {
    (void)readPlyMesh(file);
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kInput);
    const std::string message = error.what();
    return message.substr(folder.path().string().size() + 1);
  }
  return "no failure";
}

constexpr const char* kHeader = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";

TEST(Ply, CloudComesBackBitByBit) {
  const test::TemporaryFolder folder;
  ColoredCloud cloud;
  cloud.points = {{1.5F, -2.25F, 1e-7F}, {0.1F, 0.2F, 0.3F}};
  cloud.colors = {{255, 0, 1}, {7, 8, 9}};
  writePly(cloud, folder.path() / "cloud.ply");
  const ColoredCloud read = readPly(folder.path() / "cloud.ply");
  EXPECT_EQ(read.points, cloud.points);
  EXPECT_EQ(read.colors, cloud.colors);
}

TEST(Ply, CloudWithoutColoursComesBackWithout) {
  const test::TemporaryFolder folder;
  writePly(ColoredCloud{{{1.0F, 2.0F, 3.0F}}, {}}, folder.path() / "cloud.ply");
  const ColoredCloud read = readPly(folder.path() / "cloud.ply");
  EXPECT_EQ(read.points.size(), 1U);
  EXPECT_TRUE(read.colors.empty());
}

TEST(Ply, EmptyCloudComesBackEmpty) {
  const test::TemporaryFolder folder;
  writePly(ColoredCloud{}, folder.path() / "cloud.ply");
  EXPECT_TRUE(readPly(folder.path() / "cloud.ply").points.empty());
}

TEST(Ply, MeshComesBack) {
  const test::TemporaryFolder folder;
  ColoredMesh mesh;
  mesh.vertices.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.vertices.colors = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  writePly(mesh, folder.path() / "mesh.ply");
  const ColoredMesh read = readPlyMesh(folder.path() / "mesh.ply");
  EXPECT_EQ(read.vertices.points, mesh.vertices.points);
  EXPECT_EQ(read.vertices.colors, mesh.vertices.colors);
  EXPECT_EQ(read.triangles, mesh.triangles);
  EXPECT_EQ(readPly(folder.path() / "mesh.ply").points, mesh.vertices.points);
}

TEST(Ply, ReadsAsciiWithOtherElementsAndProperties) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = writeText(folder,
                                               "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement camera 1\r\nproperty list uchar int "
                                               "tags\r\nelement vertex 2\r\nproperty double z\r\nproperty float confidence\r\nproperty "
                                               "double x\r\nproperty double y\r\nproperty float red\r\nproperty float green\r\nproperty "
                                               "float blue\r\nend_header\r\n2 5 6\r\n3 0.5 1 2 1 0 0.5\r\n-3e-1 1 -1 -2 0 1 0\r\n");
  const ColoredCloud cloud = readPly(file);
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(-1, -2, -0.3F));
  EXPECT_EQ(cloud.colors[0], (Rgb{255, 0, 128}));
}

TEST(Ply, ReadsBinaryDoubles) {
  const test::TemporaryFolder folder;
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\nproperty short "
      "quality\nend_header\n";
  const double xyz[3] = {1.0, -2.0, 3.5};
  text.append(reinterpret_cast<const char*>(xyz), sizeof(xyz));
  text.append(2, '\1');
  const ColoredCloud cloud = readPly(writeText(folder, text));
  ASSERT_EQ(cloud.points.size(), 1U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1.0F, -2.0F, 3.5F));
}

TEST(Ply, EachDefectIsNamedWithItsPlace) {
  const std::string header = kHeader;
  EXPECT_EQ(failure("solid\n"), "cloud.ply:1: not a PLY file: the first line must be 'ply'");
  EXPECT_EQ(failure("ply\nformat binary_big_endian 1.0\n"),
            "cloud.ply:2: format 'binary_big_endian' is not supported (ascii, binary_little_endian)");
  EXPECT_EQ(failure("ply\nend_header\n"), "cloud.ply:2: the header names no format");
  EXPECT_EQ(failure("ply\nformat ascii 1.0\nelement vertex many\n"), "cloud.ply:3: 'element NAME COUNT' expected");
  EXPECT_EQ(failure("ply\nformat ascii 1.0\nproperty float x\n"), "cloud.ply:3: a property before the first element");
  EXPECT_EQ(failure("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"),
            "cloud.ply:4: 'half' is no PLY type (char, uchar, short, ushort, int, uint, float, double)");
  EXPECT_EQ(failure("ply\nsurprise\n"), "cloud.ply:2: 'surprise' is no PLY header keyword");
  EXPECT_EQ(failure("ply\nformat ascii 1.0\n"), "cloud.ply:2: the file ends here, more was announced");
  EXPECT_EQ(failure("ply\nformat ascii 1.0\nend_header\n"), "cloud.ply:3: no element 'vertex'");
  EXPECT_EQ(failure("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
            "cloud.ply:5: element 'vertex' lacks x, y or z");
  EXPECT_EQ(failure(header + "end_header\n1 2\n"), "cloud.ply:8: the file ends here, more was announced");
  EXPECT_EQ(failure(header + "end_header\n1 two 3\n"), "cloud.ply:8: two 3 is not a number");
  EXPECT_EQ(failure(header + "end_header\n1 nan 3\n"), "cloud.ply:8: vertex 0 is not finite");
  EXPECT_EQ(failure(header + "element face 1\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n4 0 0 0 0\n"),
            "cloud.ply:11: face 0 has 4 corners, only triangles are read");
  EXPECT_NE(failure(header + "element face 1\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n3 0 0 1\n").find("does not exist"),
            std::string::npos);
}

TEST(Ply, TruncatedBinaryIsNamedWithItsOffset) {
  EXPECT_EQ(failure("ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
                    "z\nend_header\n0123456789ab0123"),
            "cloud.ply:byte 131: the file ends here, more was announced");
}

TEST(Ply, MissingFileIsAnIoError) {
  try {
    (void)readPly("/nowhere/cloud.ply");
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ErrorCode::kIo);
  }
}

TEST(Ply, FullDiskIsAnErrorAndLeavesNothing) {
  ColoredCloud cloud;
  cloud.points.assign(100000, Eigen::Vector3f::Zero());
  EXPECT_THROW(writePly(cloud, "/nowhere/cloud.ply"), base::Error);
  const test::TemporaryFolder folder;
  const test::FileSizeLimit limit(1000);
  EXPECT_THROW(writePly(cloud, folder.path() / "cloud.ply"), base::Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "cloud.ply"));
}

}  // namespace
}  // namespace oikos::geometry
