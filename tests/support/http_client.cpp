// SPDX-License-Identifier: Apache-2.0
#include "tests/support/http_client.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

namespace oikos::test {

namespace {

[[noreturn]] void throwSystemError(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

HttpAnswer parseHead(std::string_view head) {
  HttpAnswer answer;
  constexpr std::size_t kStatusAt = 9;  // behind "HTTP/1.1 "
  answer.status = head.size() > kStatusAt ? std::atoi(std::string(head.substr(kStatusAt, 3)).c_str()) : 0;
  std::size_t begin = head.find("\r\n") + 2;
  while (begin < head.size()) {
    const std::size_t end = head.find("\r\n", begin);
    const std::string_view line = head.substr(begin, end - begin);
    const std::size_t colon = line.find(": ");
    if (colon != std::string_view::npos) {
      answer.headers[lowerCase(std::string(line.substr(0, colon)))] = line.substr(colon + 2);
    }
    begin = end + 2;
  }
  return answer;
}

}  // namespace

HttpConnection::HttpConnection(int port, int receive_buffer) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int yes = 1;
  ::setsockopt(socket(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  if (receive_buffer > 0) {
    ::setsockopt(socket(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  if (::connect(socket(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throwSystemError("connect");
  }
}

bool HttpConnection::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0) {
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

HttpAnswer HttpConnection::receive() {
  const std::string head = receiveUntil("\r\n\r\n");
  HttpAnswer answer = parseHead(head);
  if (answer.status == 0) {
    return answer;
  }
  if (answer.headers["transfer-encoding"] == "chunked") {
    answer.body = takeChunks();
  } else {
    answer.body = take(std::strtoull(answer.headers["content-length"].c_str(), nullptr, 10));
  }
  return answer;
}

HttpAnswer HttpConnection::ask(std::string_view request) {
  send(request);
  return receive();
}

std::string HttpConnection::receiveUntil(std::string_view text) {
  std::size_t found = buffer_.find(text);
  while (found == std::string::npos && readMore()) {
    found = buffer_.find(text);
  }
  return take(found == std::string::npos ? buffer_.size() : found + text.size());
}

bool HttpConnection::isClosedByServer() {
  while (readMore()) {
    buffer_.clear();
  }
  pollfd handle{socket(), POLLIN, 0};
  return ::poll(&handle, 1, 0) == 1;
}

bool HttpConnection::isClosedWithin(std::chrono::milliseconds time) const {
  pollfd handle{socket(), POLLRDHUP, 0};
  return ::poll(&handle, 1, static_cast<int>(time.count())) == 1;
}

bool HttpConnection::readMore() {
  pollfd handle{socket(), POLLIN, 0};
  if (::poll(&handle, 1, static_cast<int>(std::chrono::milliseconds(kPatience).count())) != 1) {
    return false;
  }
  std::array<char, 65536> bytes;
  const ssize_t size = ::recv(socket(), bytes.data(), bytes.size(), 0);
  buffer_.append(bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return size > 0;
}

std::string HttpConnection::take(std::size_t size) {
  while (buffer_.size() < size && readMore()) {
  }
  std::string taken = buffer_.substr(0, size);
  buffer_.erase(0, size);
  return taken;
}

std::string HttpConnection::takeChunks() {
  constexpr int kHexadecimal = 16;
  std::string body;
  while (true) {
    const std::size_t size = std::strtoull(receiveUntil("\r\n").c_str(), nullptr, kHexadecimal);
    body += take(size);
    receiveUntil("\r\n");
    if (size == 0) {
      return body;
    }
  }
}

std::string getRequest(const std::string& target, const std::string& headers) {
  return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n";
}

std::string postRequest(const std::string& target, const std::string& body, const std::string& headers) {
  return "POST " + target + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + headers + "\r\n" +
         body;
}

HttpAnswer httpGet(int port, const std::string& target, const std::string& headers) {
  return HttpConnection(port).ask(getRequest(target, headers));
}

}  // namespace oikos::test
