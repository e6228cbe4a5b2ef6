// SPDX-License-Identifier: Apache-2.0
#include "core/model/assimp_files.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <cstring>
#include <string_view>

#include "core/base/error.h"

namespace oikos::model {

namespace {

class BytesStream final : public Assimp::IOStream {
 public:
  explicit BytesStream(std::shared_ptr<const std::string> bytes) : bytes_(std::move(bytes)) {}

  size_t Read(void* buffer, size_t size, size_t count) override {
    if (size == 0) {
      return 0;
    }
    const std::size_t items = std::min(count, (bytes_->size() - position_) / size);
    std::memcpy(buffer, bytes_->data() + position_, items * size);
    position_ += items * size;
    return items;
  }
  size_t Write(const void* /*buffer*/, size_t /*size*/, size_t /*count*/) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? position_ : bytes_->size();
    // Assimp's offsets are unsigned: one that goes back from the end wraps round, which the sum undoes.
    const std::size_t target = from + offset;
    if (target > bytes_->size()) {
      return aiReturn_FAILURE;
    }
    position_ = target;
    return aiReturn_SUCCESS;
  }
  [[nodiscard]] size_t Tell() const override { return position_; }
  [[nodiscard]] size_t FileSize() const override { return bytes_->size(); }
  void Flush() override {}

 private:
  std::shared_ptr<const std::string> bytes_;
  std::size_t position_ = 0;
};

class FolderFiles final : public Assimp::IOSystem {
 public:
  FolderFiles(ModelFolder& folder, AssimpFileLog& log, std::string model_name)
      : folder_(folder), log_(log), model_name_(std::move(model_name)) {}

  bool Exists(const char* name) const override { return name == model_name_ || find(name).has_value(); }
  [[nodiscard]] char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) {
      return nullptr;
    }
    if (name == model_name_) {
      return new BytesStream(folder_.modelBytes());
    }
    const auto file = find(name);
    return file ? read(*file) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }
  bool CreateDirectory(const std::string& /*path*/) override { return false; }
  bool ChangeDirectory(const std::string& /*path*/) override { return false; }
  bool DeleteFile(const std::string& /*file*/) override { return false; }

 private:
  // An exception would be lost in Assimp, which makes a text of it: it is kept for the caller.
  void keepRefusal() const {
    if (!log_.refusal) {
      log_.refusal = std::current_exception();
    }
  }
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& name) const {
    try {
      auto file = folder_.findFile(name);
      if (!file) {
        log_.missing.insert(name);
      }
      return file;
    } catch (const base::Error&) {
      keepRefusal();
      return std::nullopt;
    }
  }
  Assimp::IOStream* read(const std::filesystem::path& file) {
    try {
      return new BytesStream(std::make_shared<const std::string>(folder_.read(file)));
    } catch (const base::Error&) {
      keepRefusal();
      return nullptr;
    }
  }

  ModelFolder& folder_;
  AssimpFileLog& log_;
  std::string model_name_;
};

}  // namespace

std::unique_ptr<Assimp::IOSystem> makeAssimpFiles(ModelFolder& folder, AssimpFileLog& log, const std::string& model_name) {
  return std::make_unique<FolderFiles>(folder, log, model_name);
}

}  // namespace oikos::model
