// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "core/base/posix_file.h"
#include "tools/daemon/http_server.h"

namespace oikos::daemon {

/// `TIME PEER "METHOD TARGET" STATUS BYTES MILLISECONDS`, without the end of the line; control characters, quotes, backslashes and what is
/// not ASCII stand as \xHH, and a long target is cut. Status 0: the connection broke before the answer.
[[nodiscard]] std::string accessLine(const Exchange& exchange, std::int64_t now_ns);

/// Writes lines from a thread of its own, so that a log that takes nothing holds nobody up; what does not fit into a megabyte meanwhile is
/// dropped and counted. Thread-safe.
class AccessLog {
 public:
  /// Appends to a file. Throws Error{kIo}.
  explicit AccessLog(base::FileDescriptor file);
  ~AccessLog();  ///< writes what is left
  AccessLog(const AccessLog&) = delete;
  AccessLog& operator=(const AccessLog&) = delete;

  void add(std::string_view line);
  [[nodiscard]] std::int64_t dropped() const;

 private:
  void write();

  base::FileDescriptor file_;
  mutable std::mutex mutex_;
  std::condition_variable stops_;
  std::string lines_;
  std::int64_t dropped_ = 0;
  bool stopping_ = false;
  std::thread writer_;
};

}  // namespace oikos::daemon
