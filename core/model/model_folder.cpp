// SPDX-License-Identifier: Apache-2.0
#include "core/model/model_folder.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "core/base/error.h"
#include "core/base/read_file.h"

namespace oikos::model {

namespace {

using base::Error;
using base::ErrorCode;

std::string percentDecoded(const std::string& name) {
  std::string decoded;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = name.data() + i + 1;
    if (name[i] == '%' && i + 2 < name.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      decoded += static_cast<char>(byte);
      i += 2;
    } else {
      decoded += name[i];
    }
  }
  return decoded;
}

bool isRegularFile(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

}  // namespace

ModelFolder::ModelFolder(const std::filesystem::path& model_file, std::uintmax_t max_bytes)
    : model_file_(model_file), left_bytes_(max_bytes), max_bytes_(max_bytes) {
  std::error_code error;
  if (std::filesystem::exists(model_file, error) && !isRegularFile(model_file)) {
    throw Error(ErrorCode::kInput, "is no file but a folder or a device", model_file.string());
  }
  model_bytes_ = std::make_shared<const std::string>(read(model_file));
  if (model_bytes_->empty()) {
    throw Error(ErrorCode::kInput, "is empty", model_file.string());
  }
  const std::filesystem::path folder = model_file.parent_path();
  folder_ = std::filesystem::canonical(folder.empty() ? "." : folder, error);
  if (error) {
    throw Error(ErrorCode::kIo, "its folder cannot be resolved: " + error.message(), model_file.string());
  }
}

std::filesystem::path ModelFolder::resolve(const std::string& name, const std::string& spelling) const {
  std::string portable = spelling;
  std::replace(portable.begin(), portable.end(), '\\', '/');
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorCode::kInput,
                "names the file '" + name + "', " + reason + ": a model's files must lie in its folder or below, under a relative path",
                model_file_.string());
  };
  if (portable.find("://") != std::string::npos) {
    refuse("a URL");
  }
  if (portable.find('\0') != std::string::npos || std::filesystem::path(portable).is_absolute()) {
    refuse("an absolute path");
  }
  std::error_code error;
  const std::filesystem::path target = std::filesystem::weakly_canonical(folder_ / portable, error);
  const std::filesystem::path inside = target.lexically_relative(folder_);
  if (error || inside.empty() || *inside.begin() == "..") {
    refuse("which leads out of its folder");
  }
  return target;
}

std::optional<std::filesystem::path> ModelFolder::findFile(const std::string& name) const {
  for (const std::string& spelling : {name, percentDecoded(name)}) {
    const std::filesystem::path file = resolve(name, spelling);
    if (isRegularFile(file)) {
      return file;
    }
  }
  return std::nullopt;
}

std::string ModelFolder::read(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (!unknown && size > left_bytes_) {
    throw Error(ErrorCode::kInput,
                (file == model_file_ ? std::string("has ") : "with '" + file.string() + "' of ") + std::to_string(size) +
                    " bytes it is too large: a model and its files may have " + std::to_string(max_bytes_) + " bytes in all",
                model_file_.string());
  }
  std::string bytes = base::readFile(file);
  left_bytes_ -= std::min<std::uintmax_t>(left_bytes_, bytes.size());
  return bytes;
}

std::string ModelFolder::placeOf(const std::string& name) const {
  return (folder_ / name).string();
}

}  // namespace oikos::model
