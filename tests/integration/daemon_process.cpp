// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/daemon_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stdexcept>

#include "core/base/posix_file.h"
#include "core/base/read_file.h"

namespace oikos::test {

namespace {

/// Up to the end of a line, or of the writer.
std::string readLine(int file) {
  constexpr int kPatience_ms = 20'000;
  std::string line;
  char c = 0;
  pollfd handle{file, POLLIN, 0};
  while (::poll(&handle, 1, kPatience_ms) == 1 && ::read(file, &c, 1) == 1 && c != '\n') {
    line += c;
  }
  return line;
}

}  // namespace

PapersCopy::PapersCopy() {
  std::filesystem::copy(std::filesystem::path(OIKOS_SOURCE_DIR) / "homes/papers/home.xml", folder_.path() / "home.xml");
}

void PapersCopy::edit(const std::string& what, const std::string& by) const {
  std::string text = base::readFile(path() / "home.xml");
  (void)folder_.write("home.xml.new", text.replace(text.find(what), what.size(), by));
  std::filesystem::rename(path() / "home.xml.new", path() / "home.xml");
}

DaemonProcess::DaemonProcess(const std::filesystem::path& home, std::vector<std::string> options) : home_(home) {
  const std::filesystem::path out = folder_.path() / "out";
  if (::mkfifo(out.c_str(), S_IRUSR | S_IWUSR) != 0) {
    throw std::runtime_error("no fifo " + out.string());
  }
  const base::FileDescriptor announced = base::openFile(out, O_RDONLY | O_NONBLOCK);
  std::vector<std::string> command{oikosBinary(), "serve", home.string(), "--listen", "127.0.0.1:0"};
  command.insert(command.end(), options.begin(), options.end());
  process_ = std::make_unique<Process>(command, out);
  const std::string line = readLine(announced.number());
  const std::size_t colon = line.rfind(':');
  if (!line.starts_with("oikos: ") || colon == std::string::npos) {
    throw std::runtime_error("no daemon: " + line + process_->finish().err);
  }
  port_ = std::stoi(line.substr(colon + 1));
}

std::string DaemonProcess::token() const {
  const std::string text = base::readFile(home_ / ".token");
  return text.substr(0, text.find('\n'));
}

}  // namespace oikos::test
