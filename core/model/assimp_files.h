// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <memory>
#include <set>
#include <string>

#include "core/model/model_folder.h"

namespace Assimp {
class IOSystem;
}

namespace oikos::model {

/// What Assimp asked for and did not get.
struct AssimpFileLog {
  std::set<std::string> missing;
  std::exception_ptr refusal;  ///< the first Error of a file that may not be read
};

/// Assimp's sight of the file system: the model under its name without a folder, all else through the model's folder, nothing to write.
/// Keeps both references.
[[nodiscard]] std::unique_ptr<Assimp::IOSystem> makeAssimpFiles(ModelFolder& folder, AssimpFileLog& log, const std::string& model_name);

}  // namespace oikos::model
