// SPDX-License-Identifier: Apache-2.0
// What the daemon can take over HTTP, with a home of 100,000 objects of which three are blue cups: questions beside an empty handler, and
// durable observations beside a raw fdatasync, all in one run. Clients and server share the machine's cores.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/generated_home.h"
#include "bench/http_load.h"
#include "tests/support/temporary_folder.h"
#include "tools/daemon/access_log.h"
#include "tools/daemon/api.h"
#include "tools/daemon/http_server.h"
#include "tools/daemon/listen_address.h"

namespace {

using namespace oikos;
using Clock = std::chrono::steady_clock;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string get(const std::string& target) {
  return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
}

std::string observation(int number) {
  const std::string object = "o" + std::to_string((number * 7919) % 100'000);
  const std::string table = "t" + std::to_string((number * 104'729) % 5000);
  const std::string body = R"({"subject":")" + object + R"(","kind":"sighted","after":{"parent":")" + table +
                           R"(","relation":"on","pose":[0.1,0,0.75,0,0,0]},"confidence":0.9})";
  return "POST /v1/observations HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer the-token\r\nContent-Length: " +
         std::to_string(body.size()) + "\r\n\r\n" + body;
}

void print(const char* what, const bench::LoadResult& result) {
  std::printf("| %s | %.0f | %.3f | %.3f | %zu |\n", what, result.rate_hz, result.p50_ms, result.p99_ms, result.failures);
  std::fflush(stdout);
}

/// The 99th percentile of writing and syncing 4 KiB, in milliseconds.
double fdatasyncP99_ms(const std::filesystem::path& file) {
  constexpr int kTimes = 2000;
  const base::FileDescriptor opened = base::openFile(file, O_WRONLY | O_CREAT);
  const std::array<char, 4096> page{};
  std::vector<double> times_ms;
  for (int i = 0; i < kTimes; ++i) {
    const auto start = Clock::now();
    if (::write(opened.number(), page.data(), page.size()) < 0 || ::fdatasync(opened.number()) != 0) {
      return 0.0;
    }
    times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::sort(times_ms.begin(), times_ms.end());
  return times_ms[kTimes * 99 / 100];
}

}  // namespace

int main() {
  const test::TemporaryFolder folder;
  (void)folder.write("home.xml", bench::homeXmlOf(100'000));
  daemon::Service service(folder.path(), {now_ns, [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }});
  daemon::AccessLog log(base::openFile(folder.path() / "access.log", O_WRONLY | O_CREAT | O_APPEND));
  daemon::Api api(service, {"127.0.0.1", "the-token", false}, &log);
  daemon::ListenAddress address{"127.0.0.1", 0};
  daemon::HttpServer server(daemon::listenAt(address), api, {});
  bench::Load load;
  load.port = address.port;
  std::printf("| 8 clients | requests/s | p50 ms | p99 ms | failures |\n|---|---|---|---|---|\n");
  load.request = [](int) { return get("/healthz"); };
  print("an empty handler, as fast as it goes", bench::run(load));
  load.request = [](int) { return get("/v1/ask?q=where+is+the+blue+cup"); };
  print("where is the blue cup, as fast as it goes", bench::run(load));
  load.rate_hz = 15'000;
  print("where is the blue cup, 15,000/s", bench::run(load));
  load.rate_hz = 0;
  load.request = observation;
  print("durable observations, as fast as it goes", bench::run(load));
  std::printf("raw fdatasync of 4 KiB: p99 %.3f ms\n", fdatasyncP99_ms(folder.path() / "raw"));
  std::printf("lines of the access log dropped: %ld\n", static_cast<long>(log.dropped()));
}
