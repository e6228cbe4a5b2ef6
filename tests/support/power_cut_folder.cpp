// SPDX-License-Identifier: Apache-2.0
#include "tests/support/power_cut_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <fstream>
#include <utility>

#include "core/base/read_file.h"

namespace oikos::test {

namespace {

ino_t numberOf(const std::filesystem::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_ino : 0;
}

}  // namespace

PowerCutFolder::PowerCutFolder(std::filesystem::path folder, std::string part, std::function<bool()> operate)
    : folder_(std::move(folder)), part_(std::move(part)), operate_(std::move(operate)), durable_(namesNow()) {
  for (const auto& [name, number] : durable_) {
    keepContent(name);
  }
}

PowerCutFolder::Names PowerCutFolder::namesNow() const {
  Names names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().filename().string().find(part_) != std::string::npos) {
      names[entry.path()] = numberOf(entry.path());
    }
  }
  return names;
}

void PowerCutFolder::keepContent(const std::filesystem::path& file) {
  synced_.insert_or_assign(numberOf(file), Content{base::openFile(file, O_RDONLY), base::readFile(file)});
}

std::optional<int> PowerCutFolder::rename(const std::filesystem::path& to) {
  const bool is_mine = to.parent_path() == folder_ && to.filename().string().find(part_) != std::string::npos;
  return is_mine && !operate_() ? std::optional(EIO) : std::nullopt;
}

std::optional<int> PowerCutFolder::sync(const std::filesystem::path& file_or_folder) {
  const bool is_folder = file_or_folder == folder_;
  if (!is_folder && file_or_folder.parent_path() != folder_) {
    return std::nullopt;
  }
  if (!operate_()) {
    return EIO;
  }
  if (is_folder) {
    durable_ = namesNow();
  } else {
    keepContent(file_or_folder);
  }
  return 0;
}

void PowerCutFolder::restore(bool later_names) {
  const Names now = namesNow();
  const Names surviving = later_names ? now : durable_;
  for (const auto& [name, number] : now) {
    std::filesystem::remove(name);
  }
  for (const auto& [name, number] : surviving) {
    const auto content = synced_.find(number);
    std::ofstream(name, std::ios::binary) << (content == synced_.end() ? std::string() : content->second.text);
  }
  durable_ = namesNow();
}

}  // namespace oikos::test
