// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/listen_address.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <charconv>
#include <memory>

#include "core/base/error.h"

namespace oikos::daemon {

namespace {

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Addresses resolve(const ListenAddress& address) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
  if (failed != 0) {
    throw base::Error(base::ErrorCode::kIo, std::string("no such address: ") + ::gai_strerror(failed), address.text());
  }
  return {found, &::freeaddrinfo};
}

int portOf(int socket) {
  sockaddr_storage bound{};
  socklen_t size = sizeof bound;
  std::array<char, NI_MAXSERV> port{};
  auto* const name = reinterpret_cast<sockaddr*>(&bound);
  OIKOS_CHECK(::getsockname(socket, name, &size) == 0);
  OIKOS_CHECK(::getnameinfo(name, size, nullptr, 0, port.data(), port.size(), NI_NUMERICSERV) == 0);
  return std::stoi(port.data());
}

}  // namespace

std::string ListenAddress::text() const {
  const bool bracket = host.find(':') != std::string::npos;
  return (bracket ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

ListenAddress parseListenAddress(const std::string& text) {
  constexpr int kGreatestPort = 65535;
  const std::size_t colon = text.rfind(':');
  ListenAddress address{text.substr(0, colon), -1};
  if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']') {
    address.host = address.host.substr(1, address.host.size() - 2);
  } else if (address.host.find(':') != std::string::npos) {
    address.host.clear();  // an IPv6 address without brackets: where it ends is not known
  }
  if (colon != std::string::npos) {
    const char* const end = text.data() + text.size();
    const auto [read, failed] = std::from_chars(text.data() + colon + 1, end, address.port);
    address.port = failed == std::errc() && read == end ? address.port : -1;
  }
  if (address.host.empty() || address.port < 0 || address.port > kGreatestPort) {
    throw base::Error(base::ErrorCode::kUsage, "'" + text + "' is no ADDRESS:PORT such as 127.0.0.1:7777 or [::1]:7777", "--listen");
  }
  return address;
}

bool isLoopback(const std::string& host) {
  in_addr v4{};
  constexpr std::uint32_t kLoopbackNet = 127;
  return host == "localhost" || host == "::1" || (::inet_pton(AF_INET, host.c_str(), &v4) == 1 && ntohl(v4.s_addr) >> 24 == kLoopbackNet);
}

bool isAddress(const std::string& host) {
  in_addr v4{};
  in6_addr v6{};
  return ::inet_pton(AF_INET, host.c_str(), &v4) == 1 || ::inet_pton(AF_INET6, host.c_str(), &v6) == 1;
}

base::FileDescriptor listenAt(ListenAddress& address) {
  constexpr int kBacklog = 512;
  const Addresses addresses = resolve(address);
  base::FileDescriptor socket(::socket(addresses->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;
  if (socket.number() < 0 || ::setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(socket.number(), addresses->ai_addr, addresses->ai_addrlen) != 0 || ::listen(socket.number(), kBacklog) != 0) {
    base::throwErrno("cannot listen", address.text());
  }
  address.port = portOf(socket.number());
  return socket;
}

}  // namespace oikos::daemon
