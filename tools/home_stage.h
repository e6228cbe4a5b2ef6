// SPDX-License-Identifier: Apache-2.0
#pragma once

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

  /// Brings everything to the disk and puts it in place; `home.xml` is written if there is none. Throws Error{kIo}.
  void commit();

 private:
  void publish();

  std::filesystem::path home_;
  Interrupts* interrupts_;
  bool is_new_;
  std::unique_ptr<base::StagingFolder> staging_;
};

}  // namespace oikos::tools
