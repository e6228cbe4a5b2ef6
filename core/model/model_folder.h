// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace oikos::model {

/// What a model file may read: itself and the files that it names in its folder or below. A name that leads elsewhere (an absolute path,
/// "../", a symbolic link out of the folder, a URL) is refused, so that a model from a stranger reads nothing else of the machine; all
/// that is read counts against one limit. Not thread-safe.
class ModelFolder {
 public:
  /// Reads the model file. Throws Error{kIo} if it cannot be read, Error{kInput} if it is no regular file, empty or too large.
  ModelFolder(const std::filesystem::path& model_file, std::uintmax_t max_bytes);

  [[nodiscard]] const std::filesystem::path& modelFile() const { return model_file_; }
  [[nodiscard]] const std::shared_ptr<const std::string>& modelBytes() const { return model_bytes_; }

  /// Where a name leads, as written or with its %20 and the like decoded; nothing if there is no regular file. Backslashes are taken for
  /// slashes. Throws Error{kInput} for a name that leads out of the folder.
  [[nodiscard]] std::optional<std::filesystem::path> findFile(const std::string& name) const;
  /// The bytes of a file that was found. Throws Error{kInput} if they are more than what is left of the limit.
  [[nodiscard]] std::string read(const std::filesystem::path& file);
  /// The folder and the name, for messages.
  [[nodiscard]] std::string placeOf(const std::string& name) const;

 private:
  [[nodiscard]] std::filesystem::path resolve(const std::string& name, const std::string& spelling) const;

  std::filesystem::path model_file_;
  std::filesystem::path folder_;  ///< canonical
  std::uintmax_t left_bytes_;
  std::uintmax_t max_bytes_;
  std::shared_ptr<const std::string> model_bytes_;
};

}  // namespace oikos::model
