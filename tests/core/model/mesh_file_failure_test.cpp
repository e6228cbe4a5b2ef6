// SPDX-License-Identifier: Apache-2.0
// Every way in which readMesh fails, reached on purpose.
#include <gtest/gtest.h>

#include "core/model/mesh_file.h"
#include "tests/core/model/mesh_samples.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace oikos::model {
namespace {

using base::ErrorCode;

class ReadMeshFailure : public testing::Test {
 protected:
  void expectFailure(const std::string& name, const std::string& content, const std::vector<std::string>& parts,
                     const MeshFileLimits& limits = {}) const {
    std::vector<std::string> all = parts;
    const auto file = folder_.write(name, content);
    all.push_back(file.string() + ":");
    test::expectError(ErrorCode::kInput, all, [&] { static_cast<void>(readMesh(file, limits)); });
  }
  void expectTextureFailure(const std::string& texture, const std::vector<std::string>& parts) const {
    folder_.write("a.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd " + texture + "\n");
    std::vector<std::string> all = parts;
    all.push_back("'" + texture + "'");
    expectFailure("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n", all);
  }
  test::TemporaryFolder folder_;
};

TEST_F(ReadMeshFailure, MissingFileAndFolder) {
  test::expectError(ErrorCode::kIo, {"/no/such/chair.obj"}, [] { static_cast<void>(readMesh("/no/such/chair.obj")); });
  std::filesystem::create_directory(folder_.path() / "folder.obj");
  test::expectError(ErrorCode::kInput, {"folder.obj: is no file"}, [&] { static_cast<void>(readMesh(folder_.path() / "folder.obj")); });
}

TEST_F(ReadMeshFailure, UnknownFormat) {
  expectFailure("a.fbx", "x", {"no known format", ".gltf"});
  expectFailure("a", "x", {"no known format"});
  expectFailure("a.zae", "x", {"no known format"});
}

TEST_F(ReadMeshFailure, AnotherFormatUnderTheName) {
  for (const std::string name : {"a.obj", "a.gltf", "a.glb", "a.stl", "a.dae"}) {
    expectFailure(name, samples::kPly, {});
  }
  expectFailure("a.ply", samples::kObjShape, {"not a PLY file"});
  expectFailure("a.ply", samples::kPly, {"too large", "at most 3 triangles"}, {.max_triangles = 3});
  expectFailure("a.gltf", R"({"asset":{"version":"1.0"},"scenes":{}})", {"cannot be read"});
}

TEST_F(ReadMeshFailure, EmptyAndCutFiles) {
  const std::string png = samples::texturePng();
  const std::string whole =
      samples::glb(samples::gltfJson("", R"("bufferView":4,"mimeType":"image/png")", "", png.size()), samples::gltfBuffer() + png);
  for (const std::string name : {"a.obj", "a.gltf", "a.glb", "a.ply", "a.stl", "a.dae"}) {
    expectFailure(name, "", {});
  }
  expectFailure("a.glb", whole.substr(0, whole.size() / 2), {});
  expectFailure("a.ply", samples::kPly.substr(0, 200), {});
  expectFailure("a.ply", samples::kPly.substr(0, samples::kPly.size() - 20), {"more was announced"});
  expectFailure("a.dae", samples::collada("", "0 0 0 1 0 0 0 0 -2 0 3 0").substr(0, 900), {});
}

TEST_F(ReadMeshFailure, ColladaThatReachesBeyondItsNumbers) {
  const std::string whole = samples::collada("", "0 0 0 1 0 0 0 0 -2 0 3 0");
  const std::vector<std::array<std::string, 3>> edits = {
      {"id=\"ua\" count=\"8\"", "id=\"ua\" count=\"0\"", "'#ua' reaches to its value 8: there are 0"},
      {"count=\"4\" stride=\"3\"", "count=\"4\" stride=\"4\"", "value 16: there are 12"},
      {"count=\"4\" stride=\"3\"", "count=\"4\" stride=\"-3\"", "stride '-3'"},
      {"count=\"4\" stride=\"3\"", "count=\"4294967295\" stride=\"4294967295\"", "records of"},
      {"source=\"#pa\"", "source=\"#pb\"", "'#pb'"}};
  for (const auto& [from, to, part] : edits) {
    std::string text = whole;
    ASSERT_NE(text.find(from), std::string::npos);
    expectFailure("a.dae", text.replace(text.find(from), from.size(), to), {part});
  }
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) {
    all += text;
  }
  return all;
}

TEST_F(ReadMeshFailure, NestedTooDeep) {
  constexpr int kDepth = 200'000;
  expectFailure("a.gltf", repeated("[", kDepth), {"nested too deep"});
  expectFailure("a.dae", "<COLLADA>" + repeated("<node a='/>'>", kDepth), {"nested too deep"});
  std::string nodes;
  for (int i = 1; i < kDepth; ++i) {
    nodes += R"({"children":[)" + std::to_string(i) + "]},";
  }
  const std::string begin = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)";
  expectFailure("a.gltf", begin + nodes + "{}]}", {"nested too deep"});
  expectFailure("a.glb", samples::glb(begin + nodes + "{}]}", ""), {"nested too deep"});
  expectFailure("a.gltf", begin + R"({"children":[1]},{"children":[0]}]})", {"nested too deep"});
}

TEST_F(ReadMeshFailure, NothingToSee) {
  expectFailure("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nl 1 2 3\n", {"holds no triangles"});
  expectFailure("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n", {"no triangle with an area", "each of its 2"});
}

TEST_F(ReadMeshFailure, NumbersThatAreNotFinite) {
  expectFailure("a.obj", "v 0 0 0\nv nan 0 0\nv 0 2 0\nf 1 2 3\n", {"not finite"});
  expectFailure("a.obj", "v 0 0 0\nv 1 0 0\nv 0 inf 0\nf 1 2 3\n", {"not finite"});
  folder_.write("w.png", samples::texturePng());
  for (const auto& [offset, what] : {std::pair{12, "vertex 1"}, std::pair{48, "texture coordinates"}}) {
    std::string buffer = samples::gltfBuffer();
    std::memcpy(buffer.data() + offset, "\x00\x00\xc0\x7f", 4);
    folder_.write("a.bin", buffer);
    expectFailure("a.gltf", samples::gltfJson(R"(,"uri":"a.bin")", R"("uri":"w.png")", ""), {what, "not finite"});
  }
}

TEST_F(ReadMeshFailure, MissingTexture) {
  expectTextureFailure("gone.png", {"material 'wood'", "missing; looked for", (folder_.path() / "gone.png").string()});
}

TEST_F(ReadMeshFailure, TextureThatIsNoPicture) {
  folder_.write("t.tga", "not a picture");
  expectTextureFailure("t.tga", {"neither a JPEG nor a PNG"});
  folder_.write("t.png", samples::texturePng().substr(0, 60));
  expectTextureFailure("t.png", {"truncated"});
}

TEST_F(ReadMeshFailure, TextureOutsideOfTheFolder) {
  const test::TemporaryFolder elsewhere;
  const auto secret = elsewhere.write("secret.png", samples::texturePng());
  expectTextureFailure("../" + elsewhere.path().filename().string() + "/secret.png", {"leads out of its folder"});
  expectTextureFailure("..\\..\\..\\..\\..\\..\\etc\\passwd", {"leads out of its folder"});
  expectTextureFailure(secret.string(), {"absolute path"});
  expectTextureFailure("http://example.org/t.png", {"a URL"});
  std::filesystem::create_symlink(secret, folder_.path() / "link.png");
  expectTextureFailure("link.png", {"leads out of its folder"});
}

TEST_F(ReadMeshFailure, BufferOutsideOfTheFolder) {
  folder_.write("w.png", samples::texturePng());
  for (const std::string uri : {"../a.bin", "%2e%2e/a.bin", "/etc/passwd", "file:///etc/passwd", "https://example.org/a.bin"}) {
    SCOPED_TRACE(uri);
    expectFailure("a.gltf", samples::gltfJson(R"(,"uri":")" + uri + "\"", R"("uri":"w.png")", ""), {"names the file '" + uri + "'"});
  }
  expectFailure("a.gltf", samples::gltfJson(R"(,"uri":"gone.bin")", R"("uri":"w.png")", ""), {"missing file", "gone.bin"});
  expectFailure("a.obj", "mtllib ../a.mtl\n" + samples::kObjShape, {"'../a.mtl'", "leads out of its folder"});
}

TEST_F(ReadMeshFailure, ALinkInsideOfTheFolderMayBeFollowed) {
  folder_.write("deep/t.png", samples::texturePng());
  std::filesystem::create_symlink("deep/t.png", folder_.path() / "link.png");
  folder_.write("a.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd link.png\n");
  const auto file = folder_.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n");
  samples::expectTexture(readMesh(file).mesh_model.materialOf(0).texture);
}

TEST_F(ReadMeshFailure, MoreThanTheLimits) {
  expectFailure("a.obj", samples::kObjShape, {"too large", "50 bytes"}, {.max_bytes = 50});
  expectFailure("a.obj", samples::kObjShape, {"too large", "at most 3 triangles"}, {.max_triangles = 3});
  folder_.write("a.mtl", "newmtl w\nKd 1 1 1\n" + std::string(1000, '#'));
  expectFailure("a.obj", "mtllib a.mtl\n" + samples::kObjShape, {"too large", "a.mtl"}, {.max_bytes = 500});
  std::string polygon;
  std::string face = "f";
  for (int i = 1; i <= 2001; ++i) {
    polygon += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
    face += " " + std::to_string(i);
  }
  expectFailure("a.obj", polygon + face + "\n", {"2001 corners"});
}

}  // namespace
}  // namespace oikos::model
