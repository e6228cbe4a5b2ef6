// SPDX-License-Identifier: Apache-2.0
// Furniture and small objects from text: a kind and what is different from its usual dimensions.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/model/articulated_model.h"

namespace oikos::model {

/// Name and value of each dimension, as they are written: lengths in metres, angles in degrees, colours as `#D8CBB2`.
using Dimensions = std::vector<std::pair<std::string, std::string>>;

/// What is wrong, one line each, empty if nothing is: an unknown kind or dimension (with the nearest known name), a name given twice, a
/// value that is none of its kind, a rule of the shape that is broken. Makes no model: a few microseconds.
[[nodiscard]] std::vector<std::string> validateShape(const std::string& kind, const Dimensions& dimensions);

/// The model of a kind with its defaults, changed by what is named. Small objects are one part, "body". Throws Error{kInput} at `where`
/// with the first that validateShape finds.
[[nodiscard]] ArticulatedModel makeShape(const std::string& kind, const Dimensions& dimensions, const std::string& where);

/// Whether a kind is a small object, which furniture carries; an unknown one is none.
[[nodiscard]] bool isSmallShape(const std::string& kind);

/// Furniture, then small objects.
[[nodiscard]] std::vector<std::string> shapeKinds();

/// All dimensions of a kind with their defaults, as they would be written. Throws Error{kUsage} for an unknown kind.
[[nodiscard]] Dimensions shapeDimensions(const std::string& kind);

}  // namespace oikos::model
