// SPDX-License-Identifier: Apache-2.0
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/model/mesh_file.h"
#include "core/model/urdf_model.h"
#include "semantic/model/home_models.h"
#include "semantic/query/thing.h"
#include "tools/command.h"
#include "tools/model_commands.h"
#include "tools/shaped_piece.h"

namespace oikos::tools {

namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

constexpr const char* kExamples =
    "  oikos model import fridge.glb\n"
    "  oikos model import cupboard.urdf --out models/cupboard.obj\n"
    "  oikos model import --shape \"cabinet width_m=0.8 door_count=2\"\n"
    "  oikos model import --shape \"oven\" --id oven --at \"2 0.3 0 0 0 90\"\n"
    "  oikos model import --shape \"cup\" --id mug --parent table --at \"0.1 0.2 0.74 0 0 0\"\n"
    "With --id it prints the element of home.xml for the piece. The shapes: oikos model shapes.";

struct ImportOptions {
  Path file;
  std::string shape;
  Path out;
  PieceText piece;
};

struct Imported {
  std::string name;
  model::ArticulatedModel model;
  std::vector<std::string> warnings;
};

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Imported importFile(const Path& file) {
  if (lowered(file.extension().string()) == ".urdf") {
    model::UrdfModel urdf = model::readUrdf(file);
    return {file.string(), std::move(urdf.model), std::move(urdf.warnings)};
  }
  model::MeshFile mesh = model::readMesh(file);
  model::ArticulatedModel made;
  made.name = file.stem().string();
  made.parts.push_back({made.name, std::make_shared<const model::TriangleMesh>(std::move(mesh.mesh_model))});
  return {file.string(), std::move(made), std::move(mesh.warnings)};
}

std::size_t trianglesOf(const model::ModelPart& part) {
  return part.mesh_part ? part.mesh_part->triangles.size() : 0;
}

std::size_t trianglesOf(const model::ArticulatedModel& made) {
  std::size_t count = 0;
  for (const model::ModelPart& part : made.parts) {
    count += trianglesOf(part);
  }
  return count;
}

/// Of all parts where they are at zero.
Eigen::AlignedBox3d boundsOf(const model::ArticulatedModel& made) {
  const auto T_model_parts = model::Kinematics(made).solve(std::vector<double>(made.joints.size(), 0.0));
  Eigen::AlignedBox3d bounds;
  for (std::size_t i = 0; i < made.parts.size(); ++i) {
    if (made.parts[i].mesh_part) {
      for (const Eigen::Vector3f& vertex_part : made.parts[i].mesh_part->vertices) {
        bounds.extend(T_model_parts[i] * vertex_part.cast<double>());
      }
    }
  }
  return bounds;
}

double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

const char* nameOf(model::MotionType type) {
  return type == model::MotionType::kFixed ? "fixed" : type == model::MotionType::kRevolute ? "revolute" : "prismatic";
}

/// A joint's limit in the unit of its file; none: nothing.
Json limitJson(const model::ModelJoint& joint, double limit) {
  const double in_unit = joint.type == model::MotionType::kRevolute ? limit / base::kRadPerDeg : limit;
  return std::isfinite(limit) ? Json(rounded(in_unit)) : Json(nullptr);
}

Json jointJson(const model::ArticulatedModel& made, const model::ModelJoint& joint) {
  const std::string unit = joint.type == model::MotionType::kRevolute ? "_deg" : "_m";
  Json json{{"name", joint.name},
            {"type", nameOf(joint.type)},
            {"parent", made.parts[static_cast<std::size_t>(joint.parent)].name},
            {"child", made.parts[static_cast<std::size_t>(joint.child)].name}};
  if (joint.type != model::MotionType::kFixed) {
    json["lower" + unit] = limitJson(joint, joint.lower);
    json["upper" + unit] = limitJson(joint, joint.upper);
  }
  return json;
}

Json toJson(const Imported& imported, const std::vector<Path>& written) {
  const Eigen::AlignedBox3d bounds = boundsOf(imported.model);
  const auto vector = [](const Eigen::Vector3d& v) { return Json::array({rounded(v.x()), rounded(v.y()), rounded(v.z())}); };
  Json json{{"model", imported.name},
            {"triangles", trianglesOf(imported.model)},
            {"size_m", bounds.isEmpty() ? Json(nullptr) : vector(bounds.sizes())},
            {"lower_corner_m", bounds.isEmpty() ? Json(nullptr) : vector(bounds.min())},
            {"parts", Json::array()},
            {"joints", Json::array()},
            {"handles", Json::array()},
            {"knobs", Json::array()},
            {"warnings", imported.warnings},
            {"written", Json::array()}};
  for (const model::ModelPart& part : imported.model.parts) {
    json["parts"].push_back({{"name", part.name}, {"triangles", trianglesOf(part)}});
  }
  for (const model::ModelJoint& joint : imported.model.joints) {
    json["joints"].push_back(jointJson(imported.model, joint));
  }
  for (const model::ModelHandle& handle : imported.model.handles) {
    json["handles"].push_back(handle.name);
  }
  for (const model::ModelKnob& knob : imported.model.knobs) {
    json["knobs"].push_back(knob.name);
  }
  for (const Path& file : written) {
    json["written"].push_back(file.string());
  }
  return json;
}

std::string limitText(const model::ModelJoint& joint) {
  if (joint.type == model::MotionType::kFixed) {
    return "";
  }
  if (!std::isfinite(joint.lower) || !std::isfinite(joint.upper)) {
    return ", no limits";
  }
  const bool turns = joint.type == model::MotionType::kRevolute;
  const auto text = [&](double limit) { return base::toText(rounded(turns ? limit / base::kRadPerDeg : limit)); };
  return ", " + text(joint.lower) + " to " + text(joint.upper) + (turns ? " deg" : " m");
}

void printText(const Imported& imported, const std::vector<Path>& written) {
  const model::ArticulatedModel& made = imported.model;
  const Eigen::AlignedBox3d bounds = boundsOf(made);
  std::cout << imported.name << ": " << trianglesOf(made) << " triangles";
  if (!bounds.isEmpty()) {
    const Eigen::Vector3d size_m = bounds.sizes();
    std::cout << ", " << base::toFixedText(size_m.x(), 3) << " x " << base::toFixedText(size_m.y(), 3) << " x "
              << base::toFixedText(size_m.z(), 3) << " m (x, y, z)";
  }
  std::cout << '\n';
  for (const model::ModelPart& part : made.parts) {
    std::cout << "part " << part.name << ": " << trianglesOf(part) << " triangles\n";
  }
  for (const model::ModelJoint& joint : made.joints) {
    std::cout << "joint " << joint.name << ": " << nameOf(joint.type) << ", " << made.parts[static_cast<std::size_t>(joint.parent)].name
              << " to " << made.parts[static_cast<std::size_t>(joint.child)].name << limitText(joint) << '\n';
  }
  for (const std::string& warning : imported.warnings) {
    std::cout << "warning: " << warning << '\n';
  }
  for (const Path& file : written) {
    std::cout << "written: " << file.string() << '\n';
  }
}

/// The file that a part of several goes to: NAME-part.obj.
Path fileOfPart(const Path& out, std::string part) {
  std::replace_if(
      part.begin(), part.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-' && c != '.'; }, '_');
  return out.parent_path() / (out.stem().string() + "-" + part + ".obj");
}

std::vector<Path> writeParts(const model::ArticulatedModel& made, const Path& out) {
  std::vector<Path> files;
  std::set<Path> taken;
  for (const model::ModelPart& part : made.parts) {
    const Path file = made.parts.size() == 1 ? out : fileOfPart(out, part.name);
    if (!taken.insert(file).second) {
      throw base::Error(base::ErrorCode::kInput, "two parts would go into this file; give them names that differ in letters",
                        file.string());
    }
    files.push_back(file);
  }
  std::vector<Path> written;
  for (std::size_t i = 0; i < made.parts.size(); ++i) {
    if (made.parts[i].mesh_part) {
      model::writeObj(*made.parts[i].mesh_part, files[i]);
      written.push_back(files[i]);
    }
  }
  return written;
}

void checkUsage(const ImportOptions& options) {
  const auto require = [](bool kept, const std::string& what) {
    if (!kept) {
      throw base::Error(base::ErrorCode::kUsage, what);
    }
  };
  require(options.file.empty() != options.shape.empty(), "give either FILE or --shape");
  require(options.piece.id.empty() || !options.shape.empty(), "--id: only for a --shape");
  require(options.out.empty() || options.out.extension() == ".obj", "--out " + options.out.string() + ": must end in .obj");
}

/// What the vocabulary calls it.
std::string usualType(const std::string& kind) {
  const semantic::Vocabulary vocabulary = semantic::builtInVocabulary();
  const semantic::Term* term = vocabulary.find(semantic::TermKind::kObjectType, kind);
  term = term == nullptr ? vocabulary.find(semantic::TermKind::kObjectType, semantic::spaced(kind)) : term;  // "room_door"
  return term == nullptr ? kind : term->name;
}

ExitCode importModel(ImportOptions options, const Session& session) {
  checkUsage(options);
  Imported imported;
  semantic::Shape shape;
  if (options.shape.empty()) {
    imported = importFile(options.file);
  } else {
    shape = parseShape(options.shape);
    imported = {options.shape, semantic::makeShape(shape, "--shape"), {}};
  }
  std::string element;
  if (!options.piece.id.empty()) {
    options.piece.type = options.piece.type.empty() ? usualType(shape.kind) : options.piece.type;
    element = pieceXml(shape, options.piece);
  }
  const std::vector<Path> written = options.out.empty() ? std::vector<Path>{} : writeParts(imported.model, options.out);
  if (session.options.json) {
    Json json = toJson(imported, written);
    if (!element.empty()) {
      json["element"] = element;
    }
    std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  } else if (!element.empty()) {
    std::cout << element << '\n';
  } else {
    printText(imported, written);
  }
  return ExitCode::kDone;
}

}  // namespace

void addModelImportCommand(CLI::App& model) {
  CLI::App& command = addCommand(model, {"import", "Reads a model, or makes one of dimensions, and says what is in it.", kExamples});
  const auto options = std::make_shared<ImportOptions>();
  command.add_option("FILE", options->file, "OBJ, glTF, GLB, PLY, STL, COLLADA or URDF");
  command.add_option("--shape", options->shape, "instead of a file: a kind and what differs from its defaults, in quotes");
  command.add_option("--out", options->out, "FILE.obj to write; of several parts each goes to FILE-PART.obj");
  CLI::Option* const id = command.add_option("--id", options->piece.id, "prints the element for home.xml, with this id");
  command.add_option("--type", options->piece.type, "the piece's type in home.xml; that of the shape's kind if not given")->needs(id);
  command
      .add_option("--at", options->piece.pose,
                  "its pose, \"X Y Z ROLL PITCH YAW\" (m, deg): furniture's in the map, a small object's in --parent")
      ->needs(id)
      ->capture_default_str();
  command.add_option("--parent", options->piece.parent, "of a small object: the id of the piece, part or room that carries it")
      ->needs(id)
      ->capture_default_str();
  setAction(command, [options](const Session& session) { return importModel(*options, session); });
}

}  // namespace oikos::tools
