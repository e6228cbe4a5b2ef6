// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/access_log.h"

#include <unistd.h>

#include <cerrno>
#include <utility>

#include "core/base/number_text.h"
#include "core/base/rfc3339.h"

namespace oikos::daemon {

namespace {

constexpr std::size_t kMostWaiting = 1 << 20;
constexpr std::size_t kLongestTarget = 1024;
constexpr std::chrono::milliseconds kGather{50};

void appendHarmless(std::string& line, std::string_view text) {
  constexpr const char* kDigits = "0123456789abcdef";
  for (const char c : text) {
    if (c < ' ' || c > '~' || c == '"' || c == '\\') {
      const auto code = static_cast<unsigned char>(c);
      line += {'\\', 'x', kDigits[code >> 4], kDigits[code & 0xF]};
    } else {
      line += c;
    }
  }
}

/// Nobody can be told that a log cannot be written.
void writeAll(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      return;
    }
    text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
}

}  // namespace

std::string accessLine(const Exchange& exchange, std::int64_t now_ns) {
  constexpr double kMsPerNs = 1e-6;
  const Request& request = exchange.request;
  std::string line = base::toRfc3339(now_ns) + ' ' + request.peer + " \"";
  appendHarmless(line, request.method.empty() ? "-" : request.method);
  line += ' ';
  appendHarmless(line, std::string_view(request.target).substr(0, kLongestTarget));
  line += request.target.size() > kLongestTarget ? "...\" " : "\" ";
  line += std::to_string(exchange.status) + ' ' + std::to_string(exchange.bytes) + ' ';
  return line + base::toFixedText(static_cast<double>(exchange.took.count()) * kMsPerNs, 3);
}

AccessLog::AccessLog(base::FileDescriptor file) : file_(std::move(file)), writer_([this] { write(); }) {}

AccessLog::~AccessLog() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stops_.notify_one();
  writer_.join();
}

void AccessLog::add(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (lines_.size() + line.size() >= kMostWaiting) {
    ++dropped_;
    return;
  }
  lines_.append(line) += '\n';
}

std::int64_t AccessLog::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

void AccessLog::write() {
  std::unique_lock lock(mutex_);
  while (!stopping_ || !lines_.empty()) {
    stops_.wait_for(lock, kGather, [this] { return stopping_; });
    const std::string lines = std::exchange(lines_, {});
    lock.unlock();
    writeAll(file_.number(), lines);
    lock.lock();
  }
}

}  // namespace oikos::daemon
