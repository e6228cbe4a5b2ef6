// SPDX-License-Identifier: Apache-2.0
#include "tools/home_stage.h"

#include <cmath>
#include <string>
#include <system_error>

#include "core/base/atomic_file.h"
#include "core/base/degrees.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/base/posix_file.h"
#include "tools/interrupts.h"

namespace oikos::tools {

namespace fs = std::filesystem;

namespace {

/// The dock is at the origin unless it is said where.
std::string singleRoomHome(const Eigen::Isometry2d& T_map_dock) {
  std::string dock;
  if (!T_map_dock.isApprox(Eigen::Isometry2d::Identity(), 1e-12)) {
    const double yaw_rad = std::atan2(T_map_dock.linear()(1, 0), T_map_dock.linear()(0, 0));
    dock = "  <dock pose=\"" + base::toFixedText(T_map_dock.translation().x(), 3) + " " +
           base::toFixedText(T_map_dock.translation().y(), 3) + " 0 0 0 " + base::toFixedText(yaw_rad / base::kRadPerDeg, 2) + "\"/>\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<apartment id=\"home\" name=\"Home\" version=\"1\">\n" +
         dock +
         "  <room id=\"room\" name=\"Room\"/>\n"
         "</apartment>\n";
}

/// Without a slash at the end, so that it has a name.
fs::path withoutTrailingSlash(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

void checkHome(const fs::path& home) {
  const fs::path map = home / "map";
  if (fs::exists(home) && !fs::is_directory(home)) {
    throw base::Error(base::ErrorCode::kUsage, "is a file; a home is a folder", home.string());
  }
  if (fs::exists(map) && !(fs::is_directory(map) && (fs::is_empty(map) || fs::exists(map / "config.toml")))) {
    throw base::Error(base::ErrorCode::kUsage,
                      "is no map that oikos made (it has no config.toml); it would be replaced: choose another home", map.string());
  }
}

void makeParents(const fs::path& home) {
  std::error_code failure;
  fs::create_directories(base::folderOf(home), failure);
  if (failure) {
    throw base::Error(base::ErrorCode::kIo, "cannot be made: " + failure.message(), base::folderOf(home).string());
  }
}

/// Beside a home that does not exist yet, inside one that does: always on the file system that it will be moved on.
fs::path stagingPath(const fs::path& home, bool is_new) {
  return is_new ? base::folderOf(home) / ("." + home.filename().string() + ".staging") : home / ".staging";
}

}  // namespace

HomeStage::HomeStage(const fs::path& home, Interrupts& interrupts)
    : home_(withoutTrailingSlash(home)), interrupts_(&interrupts), is_new_(!fs::exists(home_)) {
  checkHome(home_);
  makeParents(home_);
  staging_ = std::make_unique<base::StagingFolder>(stagingPath(home_, is_new_));
  interrupts.onInterrupt("interrupted; " + home_.string() + (is_new_ ? " was not made" : " is unchanged"), [this] { staging_->discard(); });
  fs::create_directory(mapFolder());
}

HomeStage::~HomeStage() {
  interrupts_->onInterrupt("interrupted", nullptr);
}

fs::path HomeStage::mapFolder() const {
  return staging_->path() / "map";
}

void HomeStage::commit(const Eigen::Isometry2d& T_map_dock) {
  if (is_new_ || !fs::exists(home_ / "home.xml")) {
    base::writeFileAtomically(staging_->path() / "home.xml", singleRoomHome(T_map_dock));
  }
  base::syncTree(staging_->path());
  interrupts_->runUninterrupted([this] { publish(); }, "interrupted after the map in " + home_.string() + " was finished");
  staging_->discard();
}

void HomeStage::publish() {
  if (is_new_) {
    base::publishNewFolder(staging_->path(), home_);
    return;
  }
  // A home.xml without a map is a valid home, a map without a home.xml is not: hence this order.
  if (fs::exists(staging_->path() / "home.xml")) {
    base::publishFile(staging_->path() / "home.xml", home_ / "home.xml");
  }
  base::publishFolder(mapFolder(), home_ / "map");
}

}  // namespace oikos::tools
