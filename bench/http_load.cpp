// SPDX-License-Identifier: Apache-2.0
#include "bench/http_load.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <vector>

#include "core/base/posix_file.h"

namespace oikos::bench {

namespace {

using Clock = std::chrono::steady_clock;

struct Client {
  base::FileDescriptor socket{-1};
  Clock::time_point due;
  bool waiting = false;  ///< for its answer
  std::string received;
};

base::FileDescriptor connectTo(int port) {
  base::FileDescriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int yes = 1;
  ::setsockopt(socket.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  if (::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::system_error(errno, std::generic_category(), "connect");
  }
  return socket;
}

/// Whether one answer is there as a whole.
bool isComplete(const std::string& received) {
  const std::size_t head = received.find("\r\n\r\n");
  const std::size_t length = received.find("Content-Length: ");
  return head != std::string::npos && length < head &&
         received.size() >= head + 4 + std::strtoull(received.c_str() + length + std::strlen("Content-Length: "), nullptr, 10);
}

class Generator {
 public:
  explicit Generator(const Load& load) : load_(load), epoll_(::epoll_create1(0)), clients_(static_cast<std::size_t>(load.clients)) {
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      clients_[i].socket = connectTo(load.port);
      epoll_event event{EPOLLIN, {.u64 = i}};
      ::epoll_ctl(epoll_.number(), EPOLL_CTL_ADD, clients_[i].socket.number(), &event);
    }
  }

  LoadResult run() {
    const Clock::time_point start = Clock::now();
    const Clock::time_point end = start + load_.time;
    const auto step = interval();
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      clients_[i].due = start + step * static_cast<int>(i) / load_.clients;
    }
    for (Clock::time_point now = start; now < end; now = Clock::now()) {
      sendWhatIsDue(now);
      receive(nextDue() - Clock::now());
    }
    return summary(std::chrono::duration<double>(Clock::now() - start).count());
  }

 private:
  [[nodiscard]] std::chrono::nanoseconds interval() const {
    return load_.rate_hz > 0.0 ? std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * load_.clients / load_.rate_hz))
                               : std::chrono::nanoseconds(0);
  }

  void sendWhatIsDue(Clock::time_point now) {
    for (Client& client : clients_) {
      if (!client.waiting && client.due <= now) {
        client.due = load_.rate_hz > 0.0 ? client.due : now;
        const std::string request = load_.request(number_++);
        client.waiting =
            ::send(client.socket.number(), request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size());
      }
    }
  }

  [[nodiscard]] Clock::time_point nextDue() const {
    Clock::time_point next = Clock::now() + std::chrono::milliseconds(10);
    for (const Client& client : clients_) {
      next = client.waiting ? next : std::min(next, client.due);
    }
    return next;
  }

  void receive(std::chrono::nanoseconds wait) {
    std::array<epoll_event, 64> events{};
    const timespec limit{0, std::max<std::int64_t>(0, wait.count())};
    const int count = ::epoll_pwait2(epoll_.number(), events.data(), static_cast<int>(events.size()), &limit, nullptr);
    for (int i = 0; i < count; ++i) {
      receive(clients_[events[static_cast<std::size_t>(i)].data.u64]);
    }
  }

  void receive(Client& client) {
    std::array<char, 65536> bytes;
    const ssize_t size = ::recv(client.socket.number(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    client.received.append(bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
    if (client.waiting && isComplete(client.received)) {
      latencies_ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - client.due).count());
      failures_ += client.received.starts_with("HTTP/1.1 200") ? 0 : 1;
      client.received.clear();
      client.waiting = false;
      client.due = load_.rate_hz > 0.0 ? client.due + interval() : Clock::now();
    }
  }

  LoadResult summary(double seconds) {
    std::sort(latencies_ms_.begin(), latencies_ms_.end());
    const auto quantile = [&](double share) {
      return latencies_ms_.empty() ? 0.0 : latencies_ms_[static_cast<std::size_t>(share * static_cast<double>(latencies_ms_.size() - 1))];
    };
    return {static_cast<double>(latencies_ms_.size()) / seconds, quantile(0.5), quantile(0.99), failures_};
  }

  const Load& load_;
  base::FileDescriptor epoll_;
  std::vector<Client> clients_;
  int number_ = 0;
  std::vector<double> latencies_ms_;
  std::size_t failures_ = 0;
};

}  // namespace

LoadResult run(const Load& load) {
  return Generator(load).run();
}

}  // namespace oikos::bench
