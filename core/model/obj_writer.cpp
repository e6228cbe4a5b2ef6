// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/model/mesh_file.h"
#include "core/recording/png_encoder.h"

namespace oikos::model {

namespace {

constexpr int kTextureLevel = 6;

/// The shortest text that reads back as the same float.
void appendNumber(std::string& text, float number) {
  std::array<char, 64> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text += ' ';
  text.append(digits.data(), end);
}

template <typename Vector>
void appendLine(std::string& text, const char* keyword, const Vector& numbers) {
  text += keyword;
  for (const float number : numbers) {
    appendNumber(text, number);
  }
  text += '\n';
}

std::string writableName(const std::string& name) {
  std::string writable = name.empty() ? "material" : name;
  for (char& c : writable) {
    if (std::isspace(static_cast<unsigned char>(c)) != 0 || std::iscntrl(static_cast<unsigned char>(c)) != 0 || c == '#' || c == '\\') {
      c = '_';
    }
  }
  return writable;
}

std::vector<std::string> uniqueNames(const std::vector<Material>& materials) {
  std::vector<std::string> names;
  std::set<std::string> used;
  for (const Material& material : materials) {
    const std::string wanted = writableName(material.name);
    std::string name = wanted;
    for (int number = 2; !used.insert(name).second; ++number) {
      name = wanted + "_" + std::to_string(number);
    }
    names.push_back(name);
  }
  return names;
}

/// Writes the textures and returns the MTL's text. A texture that materials share is written once.
std::string writeTextures(const TriangleMesh& mesh, const std::filesystem::path& file, const std::vector<std::string>& names) {
  std::map<const unsigned char*, std::string> written;
  std::string mtl;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const Material& material = mesh.materials[i];
    mtl += "newmtl " + names[i] + '\n';
    appendLine(mtl, "Kd", material.color_rgb);
    if (material.texture.empty()) {
      continue;
    }
    const auto [entry, is_new] = written.try_emplace(material.texture.data);
    if (is_new) {
      entry->second = file.stem().string() + "_" + std::to_string(written.size()) + ".png";
      const std::vector<unsigned char> png = recording::encodePng(material.texture, kTextureLevel);
      base::writeFileAtomically(file.parent_path() / entry->second, {reinterpret_cast<const char*>(png.data()), png.size()});
    }
    mtl += "map_Kd " + entry->second + '\n';
  }
  return mtl;
}

void appendVertices(std::string& obj, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertex_colors.empty()) {
      appendLine(obj, "v", mesh.vertices[i]);
      continue;
    }
    const geometry::Rgb& rgb = mesh.vertex_colors[i];
    const Eigen::Vector3f color = Eigen::Vector3f(rgb[0], rgb[1], rgb[2]) / 255.0F;
    Eigen::Matrix<float, 6, 1> numbers;
    numbers << mesh.vertices[i], color;
    appendLine(obj, "v", numbers);
  }
  for (const Eigen::Vector2f& coordinate : mesh.texture_coordinates) {
    appendLine(obj, "vt", coordinate);
  }
  for (const Eigen::Vector3f& normal : mesh.normals) {
    appendLine(obj, "vn", normal);
  }
}

/// "7", "7/7", "7//7" or "7/7/7": all lists are one a vertex. Counted from 1.
std::string cornerOf(const TriangleMesh& mesh, std::uint32_t vertex) {
  const std::string index = std::to_string(std::uint64_t{vertex} + 1);
  std::string corner = index;
  if (!mesh.texture_coordinates.empty() || !mesh.normals.empty()) {
    corner += "/" + (mesh.texture_coordinates.empty() ? "" : index);
  }
  return mesh.normals.empty() ? corner : corner + "/" + index;
}

void appendTriangles(std::string& obj, const TriangleMesh& mesh, const std::vector<std::string>& names) {
  std::uint32_t current = static_cast<std::uint32_t>(names.size());  // none yet
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t material = mesh.triangle_materials.empty() ? 0 : mesh.triangle_materials[i];
    if (material != current && !names.empty()) {
      obj += "usemtl " + names[material] + '\n';
      current = material;
    }
    obj += 'f';
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      obj += ' ' + cornerOf(mesh, vertex);
    }
    obj += '\n';
  }
}

}  // namespace

void writeObj(const TriangleMesh& mesh, const std::filesystem::path& file) {
  OIKOS_CHECK(validate(mesh).empty());
  OIKOS_CHECK(file.extension() == ".obj");
  const std::vector<std::string> names = uniqueNames(mesh.materials);
  std::string obj = "# metres, z up\n";
  if (!names.empty()) {
    std::filesystem::path library = file;
    library.replace_extension(".mtl");
    base::writeFileAtomically(library, writeTextures(mesh, file, names));
    obj += "mtllib " + library.filename().string() + '\n';
  }
  appendVertices(obj, mesh);
  appendTriangles(obj, mesh, names);
  base::writeFileAtomically(file, obj);
}

}  // namespace oikos::model
