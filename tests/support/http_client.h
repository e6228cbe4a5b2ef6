// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

#include "core/base/posix_file.h"

namespace oikos::test {

struct HttpAnswer {
  int status = 0;                              ///< 0: the connection ended before there was one
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

/// A connection to a server on 127.0.0.1 that sends what it is told, byte for byte, and waits for answers at most `kPatience`.
class HttpConnection {
 public:
  static constexpr std::chrono::seconds kPatience{20};

  /// Throws std::system_error if nobody listens there. A small `receive_buffer` (bytes) makes a reader that a server has to wait for.
  explicit HttpConnection(int port, int receive_buffer = 0);

  /// Whether the server took it.
  bool send(std::string_view bytes);
  /// Reads one answer with its whole body.
  [[nodiscard]] HttpAnswer receive();
  /// send() and receive().
  [[nodiscard]] HttpAnswer ask(std::string_view request);
  /// Reads on until the text has come; everything up to its end. Without it: what came until the end.
  std::string receiveUntil(std::string_view text);
  /// Waits until the server closes its side, reading on meanwhile.
  [[nodiscard]] bool isClosedByServer();
  /// Reads nothing.
  [[nodiscard]] bool isClosedWithin(std::chrono::milliseconds time) const;

  [[nodiscard]] int socket() const { return socket_.number(); }

 private:
  bool readMore();
  std::string take(std::size_t size);
  std::string takeChunks();

  base::FileDescriptor socket_;
  std::string buffer_;
};

/// "GET TARGET HTTP/1.1" with a Host of this machine and further header lines, each with its line end.
[[nodiscard]] std::string getRequest(const std::string& target, const std::string& headers = {});
[[nodiscard]] std::string postRequest(const std::string& target, const std::string& body, const std::string& headers = {});
/// A request on a connection of its own.
[[nodiscard]] HttpAnswer httpGet(int port, const std::string& target, const std::string& headers = {});

}  // namespace oikos::test
