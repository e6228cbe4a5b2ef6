// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/integration/process.h"
#include "tests/support/temporary_folder.h"

namespace oikos::test {

/// A copy of the papers' house.
class PapersCopy {
 public:
  PapersCopy();
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
  /// Replaces a piece of home.xml, as an editor does.
  void edit(const std::string& what, const std::string& by) const;

 private:
  TemporaryFolder folder_;
};

/// `oikos serve HOME --listen 127.0.0.1:0` that has announced its port.
class DaemonProcess {
 public:
  /// Throws if it ends before it has announced itself.
  explicit DaemonProcess(const std::filesystem::path& home, std::vector<std::string> options = {});

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] Process& process() { return *process_; }
  [[nodiscard]] std::string token() const;

 private:
  std::filesystem::path home_;
  TemporaryFolder folder_;
  std::unique_ptr<Process> process_;
  int port_ = 0;
};

}  // namespace oikos::test
