// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>

namespace urdf {
class ModelInterface;
class Pose;
}  // namespace urdf

namespace oikos::model {

/// A URDF as urdfdom has it, with what urdfdom complains of as Error{kInput} that names the file, and Error{kIo} if the file cannot be
/// read. Thread-safe: urdfdom's one logger is guarded here, so nothing else may parse a URDF.
[[nodiscard]] std::shared_ptr<urdf::ModelInterface> parseUrdf(const std::filesystem::path& file);

/// Not checked: may hold numbers that are not finite.
[[nodiscard]] Eigen::Isometry3d toIsometry(const urdf::Pose& pose);

}  // namespace oikos::model
