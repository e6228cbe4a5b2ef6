// SPDX-License-Identifier: Apache-2.0
// A home as something to look at: its furniture and small objects as articulated models.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/model/articulated_model.h"
#include "core/model/shapes/shape_text.h"
#include "semantic/model/home.h"

namespace oikos::semantic {

/// Makes the models of a home's pieces: from their model files, else their shapes, else their boxes. Each file is read once. Throws Error
/// with the piece's id for a file that cannot be read and a shape that is not valid. Not thread-safe.
class ModelMaker {
 public:
  /// `home_folder`: what the model files' names start from.
  explicit ModelMaker(std::filesystem::path home_folder) : folder_(std::move(home_folder)) {}

  /// Parts and joints are the object's, in its order: part i of the object is part i of the model, joint i is joint i. Each knob adds a
  /// part behind them, with a joint behind them, so that it can be seen turning, and is a knob of the model. An object without articulation
  /// is one part.
  [[nodiscard]] model::ArticulatedModel make(const LargeObject& object);
  /// One part.
  [[nodiscard]] model::ArticulatedModel make(const SmallObject& object);

 private:
  using Mesh = std::shared_ptr<const model::TriangleMesh>;

  [[nodiscard]] Mesh meshOf(const std::string& file);
  void addPart(const LargeObject& object, const Part& part, const model::ArticulatedModel* shape, model::ArticulatedModel& made);

  std::filesystem::path folder_;
  std::map<std::string, Mesh> meshes_;
};

/// The values for the joints of the model that ModelMaker makes of it (rad or m), knobs in their current states.
[[nodiscard]] std::vector<double> jointValues(const LargeObject& object);

/// The model that a shape describes. Throws Error{kInput} that names `where`, the dimension and what would be right.
[[nodiscard]] model::ArticulatedModel makeShape(const Shape& shape, const std::string& where);

/// Its dimensions as core/model takes them.
[[nodiscard]] model::Dimensions dimensionsOf(const Shape& shape);

/// The name of the shape's part that stands for a part of the object: `fridge-door` of the object `fridge` is its "door".
[[nodiscard]] std::string shapePartName(const ObjectId& object, const PartId& part);

/// An articulated object's parts, joints, handles and knobs as its shape has them, all closed; ids start with the object's.
[[nodiscard]] Articulation articulationOf(const model::ArticulatedModel& shape, const ObjectId& object);

}  // namespace oikos::semantic
