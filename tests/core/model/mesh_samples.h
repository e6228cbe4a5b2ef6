// SPDX-License-Identifier: Apache-2.0
// Small model files, all of one shape that no turn, mirror or scale leaves alike: the corner of a box with edges of 1, 2 and 3 m along x, y
// and z.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/model/triangle_mesh.h"
#include "core/recording/png_encoder.h"

namespace oikos::model::samples {

/// By the divergence theorem; positive only if the triangles are counter-clockwise seen from outside.
inline double volumeM3(const TriangleMesh& mesh) {
  double volume_m3 = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    volume_m3 += mesh.vertices[mesh.triangles[i][0]].cast<double>().dot(mesh.areaNormal(i)) / 6.0;
  }
  return volume_m3;
}

inline void expectCorner(const TriangleMesh& mesh, const Eigen::Vector3f& at = Eigen::Vector3f::Zero(), float scale = 1.0F) {
  ASSERT_TRUE(validate(mesh).empty()) << validate(mesh).front();
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_LT((mesh.bounds().min() - at).norm(), 1e-5F) << mesh.bounds().min().transpose();
  EXPECT_LT((mesh.bounds().max() - at - scale * Eigen::Vector3f(1.0F, 2.0F, 3.0F)).norm(), 1e-5F) << mesh.bounds().max().transpose();
  EXPECT_NEAR(volumeM3(mesh), scale * scale * scale, 1e-5);
}

inline const std::string kObjShape = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

inline const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar "
    "green\nproperty uchar blue\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 10 20 30\n1 0 0 255 0 0\n0 2 0 0 255 0\n0 0 3 0 0 255\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

inline const std::string kStl = [] {
  const std::array<std::string, 4> corners = {"0 0 0", "1 0 0", "0 2 0", "0 0 3"};
  std::string text = "solid corner\n";
  for (const auto& [a, b, c] : std::array<std::array<std::size_t, 3>, 4>{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::size_t corner : {a, b, c}) {
      text += "vertex " + corners[corner] + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid corner\n";
}();

/// `positions` in the file's axes and unit; the node moves it by 10 along the file's x.
inline std::string collada(const std::string& asset, const std::string& positions,
                           const std::string& diffuse = "<color>1 0.5 0 1</color>") {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" + asset +
         R"(</asset><library_images><image id="wood"><init_from>wood.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><newparam sid="s"><surface type="2D"><init_from>wood</init_from></surface></newparam>
<newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
<technique sid="c"><lambert><diffuse>)" +
         diffuse + R"(</diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="orange"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">)" +
         positions + R"(</float_array><technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="8">0 0 1 0 0 1 1 1</float_array><technique_common><accessor source="#ua" count="4" stride="2">
<param name="S" type="float"/><param name="T" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4" material="mm"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#u" offset="0" set="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="n"><translate>10 0 0</translate><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="mm" target="#m"><bind_vertex_input semantic="UVSET0" input_semantic="TEXCOORD" input_set="0"/>
</instance_material></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>)";
}

template <typename Value>
void appendBytes(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// The shape with y up as glTF has it, (x, z, -y); then texture coordinates (v down), colours (linear), indices.
inline std::string gltfBuffer() {
  std::string bytes;
  for (const float number : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, -2.0F, 0.0F, 3.0F, 0.0F}) {
    appendBytes(bytes, number);
  }
  for (const float number : {0.25F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 1.0F}) {
    appendBytes(bytes, number);
  }
  for (const float number : {1.0F, 1.0F, 1.0F, 0.0F, 0.5F, 0.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F}) {
    appendBytes(bytes, number);
  }
  for (const std::uint16_t index : std::array<std::uint16_t, 12>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) {
    appendBytes(bytes, index);
  }
  return bytes;
}

/// `buffer`, `image` and `node` are JSON members that say where the bytes and the picture are and how the mesh is placed.
inline std::string gltfJson(const std::string& buffer, const std::string& image, const std::string& node, std::size_t png_bytes = 0) {
  std::string views = R"({"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},)"
                      R"({"buffer":0,"byteOffset":80,"byteLength":48},{"buffer":0,"byteOffset":128,"byteLength":24})";
  if (png_bytes > 0) {
    views += R"(,{"buffer":0,"byteOffset":152,"byteLength":)" + std::to_string(png_bytes) + "}";
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"mesh":0)" + node +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":2},"indices":3,"material":0}]}],)" +
         R"("materials":[{"name":"oak","pbrMetallicRoughness":{"baseColorFactor":[0.5,1,0,1],"baseColorTexture":{"index":0}}}],)" +
         R"("textures":[{"source":0}],"images":[{)" + image + R"(}],"buffers":[{"byteLength":)" + std::to_string(152 + png_bytes) + buffer +
         R"(}],"bufferViews":[)" + views + R"(],"accessors":[
{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,-2],"max":[1,3,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},{"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":3,"componentType":5123,"count":12,"type":"SCALAR"}]})";
}

inline std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  appendBytes(bytes, std::uint32_t{2});
  appendBytes(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  appendBytes(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  appendBytes(bytes, static_cast<std::uint32_t>(binary.size()));
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

/// Every pixel differs from its neighbours.
inline cv::Mat texture() {
  cv::Mat image(3, 4, CV_8UC3);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      image.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(40 * u), static_cast<std::uint8_t>(80 * v), 200};
    }
  }
  return image;
}

inline std::string texturePng() {
  const auto png = recording::encodePng(texture(), 9);
  return {png.begin(), png.end()};
}

inline void expectTexture(const cv::Mat& image, const cv::Mat& expected = texture()) {
  ASSERT_EQ(image.type(), CV_8UC3);
  ASSERT_EQ(image.size(), expected.size());
  EXPECT_EQ(cv::norm(image, expected, cv::NORM_INF), 0.0);
}

}  // namespace oikos::model::samples
