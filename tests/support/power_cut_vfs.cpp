// SPDX-License-Identifier: Apache-2.0
#include "tests/support/power_cut_vfs.h"

#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <utility>

namespace oikos::test {

namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  return content.str();
}

}  // namespace

/// What survives, by path: a content, or that the file is not there.
class PowerCutVfs::Disk {
 public:
  explicit Disk(std::int64_t cut_after) : cut_after_(cut_after), inner_(sqlite3_vfs_find(nullptr)), vfs_(*inner_) {
    vfs_.pNext = nullptr;
    vfs_.zName = "power-cut";
    vfs_.pAppData = this;
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + inner_->szOsFile;
    vfs_.xOpen = &open;
    vfs_.xDelete = &remove;
    vfs_.xAccess = [](sqlite3_vfs* v, const char* path, int flags, int* result) {
      return diskOf(v).inner_->xAccess(diskOf(v).inner_, path, flags, result);
    };
    vfs_.xFullPathname = [](sqlite3_vfs* v, const char* path, int size, char* full) {
      return diskOf(v).inner_->xFullPathname(diskOf(v).inner_, path, size, full);
    };
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~Disk() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(inner_, 1);
  }
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;

  [[nodiscard]] bool isCut() const { return operations_ >= cut_after_; }
  [[nodiscard]] std::int64_t operations() const { return operations_; }

  /// Whether the power is still there for one more operation.
  bool operate() {
    if (isCut()) {
      return false;
    }
    ++operations_;
    return true;
  }

  void restore() {
    for (const auto& [path, content] : durable_) {
      std::filesystem::remove(path);
      if (content) {
        std::ofstream(path, std::ios::binary) << *content;
      }
      std::filesystem::remove(path + "-shm");
    }
  }

 private:
  /// What SQLite sees; the inner VFS's own file follows it in memory.
  struct File {
    sqlite3_file base;
    Disk* disk;
    std::string* path;  // null: a temporary file without a name

    [[nodiscard]] sqlite3_file* inner() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };

  static Disk& diskOf(sqlite3_vfs* vfs) { return *static_cast<Disk*>(vfs->pAppData); }
  static File& fileOf(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }
  static sqlite3_file* innerOf(sqlite3_file* file) { return fileOf(file).inner(); }

  void remember(const std::string& path) {
    if (!durable_.contains(path)) {
      durable_[path] = std::filesystem::exists(path) ? std::optional(contentOf(path)) : std::nullopt;
    }
  }

  static int open(sqlite3_vfs* vfs, const char* path, sqlite3_file* file, int flags, int* out_flags) {
    Disk& disk = diskOf(vfs);
    File& opened = *new (file) File{};
    if (!disk.operate()) {
      return SQLITE_IOERR;
    }
    if (path != nullptr) {
      disk.remember(path);
    }
    const int code = disk.inner_->xOpen(disk.inner_, path, opened.inner(), flags, out_flags);
    if (code == SQLITE_OK) {
      opened.base.pMethods = &kMethods;
      opened.disk = &disk;
      opened.path = path == nullptr ? nullptr : new std::string(path);
    }
    return code;
  }

  static int remove(sqlite3_vfs* vfs, const char* path, int sync_folder) {
    Disk& disk = diskOf(vfs);
    if (!disk.operate()) {
      return SQLITE_IOERR_DELETE;
    }
    disk.durable_[path] = std::nullopt;
    return disk.inner_->xDelete(disk.inner_, path, sync_folder);
  }

  static int close(sqlite3_file* file) {
    const int code = innerOf(file)->pMethods->xClose(innerOf(file));
    delete std::exchange(fileOf(file).path, nullptr);
    return code;
  }
  static int write(sqlite3_file* file, const void* bytes, int size, sqlite3_int64 offset) {
    return fileOf(file).disk->operate() ? innerOf(file)->pMethods->xWrite(innerOf(file), bytes, size, offset) : SQLITE_IOERR_WRITE;
  }
  static int truncate(sqlite3_file* file, sqlite3_int64 size) {
    return fileOf(file).disk->operate() ? innerOf(file)->pMethods->xTruncate(innerOf(file), size) : SQLITE_IOERR_TRUNCATE;
  }
  static int sync(sqlite3_file* file, int /*flags*/) {
    File& synced = fileOf(file);
    if (!synced.disk->operate()) {
      return SQLITE_IOERR_FSYNC;
    }
    if (synced.path != nullptr) {
      synced.disk->durable_[*synced.path] = contentOf(*synced.path);  // of the file as all connections see it
    }
    return SQLITE_OK;
  }

  static const sqlite3_io_methods kMethods;

  std::int64_t cut_after_;
  std::int64_t operations_ = 0;
  sqlite3_vfs* inner_;
  sqlite3_vfs vfs_;
  std::map<std::string, std::optional<std::string>> durable_;
};

const sqlite3_io_methods PowerCutVfs::Disk::kMethods = {
    2,
    &close,
    [](sqlite3_file* f, void* bytes, int size, sqlite3_int64 offset) {
      return innerOf(f)->pMethods->xRead(innerOf(f), bytes, size, offset);
    },
    &write,
    &truncate,
    &sync,
    [](sqlite3_file* f, sqlite3_int64* size) { return innerOf(f)->pMethods->xFileSize(innerOf(f), size); },
    [](sqlite3_file* f, int level) { return innerOf(f)->pMethods->xLock(innerOf(f), level); },
    [](sqlite3_file* f, int level) { return innerOf(f)->pMethods->xUnlock(innerOf(f), level); },
    [](sqlite3_file* f, int* result) { return innerOf(f)->pMethods->xCheckReservedLock(innerOf(f), result); },
    [](sqlite3_file* f, int what, void* argument) { return innerOf(f)->pMethods->xFileControl(innerOf(f), what, argument); },
    [](sqlite3_file* f) { return innerOf(f)->pMethods->xSectorSize(innerOf(f)); },
    // none of the promises that a real disk makes beyond a sync
    [](sqlite3_file* /*f*/) { return 0; },
    [](sqlite3_file* f, int page, int size, int extend, void volatile** memory) {
      return innerOf(f)->pMethods->xShmMap(innerOf(f), page, size, extend, memory);
    },
    [](sqlite3_file* f, int offset, int n, int flags) { return innerOf(f)->pMethods->xShmLock(innerOf(f), offset, n, flags); },
    [](sqlite3_file* f) { innerOf(f)->pMethods->xShmBarrier(innerOf(f)); },
    [](sqlite3_file* f, int remove) { return innerOf(f)->pMethods->xShmUnmap(innerOf(f), remove); },
    nullptr,
    nullptr,
};

PowerCutVfs::PowerCutVfs(std::int64_t cut_after) : disk_(std::make_unique<Disk>(cut_after)) {}

PowerCutVfs::~PowerCutVfs() = default;

bool PowerCutVfs::isCut() const {
  return disk_->isCut();
}

std::int64_t PowerCutVfs::operations() const {
  return disk_->operations();
}

bool PowerCutVfs::operate() {
  return disk_->operate();
}

void PowerCutVfs::restore() {
  disk_->restore();
}

}  // namespace oikos::test
