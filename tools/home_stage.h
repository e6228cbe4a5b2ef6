// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>

#include "core/base/staging_folder.h"

namespace oikos::tools {

class Interrupts;

/// A new map on its way into a home. Until `commit` the home is as it was; a home that does not exist yet appears whole, with
/// a `home.xml` of a single room. An interrupt or the end of its life before `commit` removes what was staged.
class HomeStage {
 public:
  /// Throws Error: kUsage if `home` cannot be a home or its `map` is no map of ours, kIo if another process writes to it.
  HomeStage(const std::filesystem::path& home, Interrupts& interrupts);
  ~HomeStage();
  HomeStage(const HomeStage&) = delete;
  HomeStage& operator=(const HomeStage&) = delete;

  /// Empty, to be filled.
  [[nodiscard]] std::filesystem::path mapFolder() const;

  /// Brings everything to the disk and puts it in place; `home.xml` is written if there is none, with its dock at `T_map_dock`. Throws
  /// Error{kIo}.
  void commit(const Eigen::Isometry2d& T_map_dock = Eigen::Isometry2d::Identity());

 private:
  void publish();

  std::filesystem::path home_;
  Interrupts* interrupts_;
  bool is_new_;
  std::unique_ptr<base::StagingFolder> staging_;
};

}  // namespace oikos::tools
