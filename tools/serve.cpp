// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "tools/command.h"
#include "tools/daemon/access_log.h"
#include "tools/daemon/api.h"
#include "tools/daemon/http_server.h"
#include "tools/daemon/listen_address.h"
#include "tools/daemon/service.h"
#include "tools/daemon/token_file.h"
#include "tools/interrupts.h"

namespace oikos::tools {

namespace {

constexpr const char* kExamples =
    "  oikos serve homes/papers\n"
    "  oikos serve ~/homes/flat-3 --listen 127.0.0.1:0 --access-log /var/log/oikos.log\n"
    "  oikos serve ~/homes/flat-3 --listen 0.0.0.0:7777 --token-file ~/.oikos-token\n"
    "  curl 'http://127.0.0.1:7777/v1/ask?q=where+is+the+blue+cup'\n"
    "SIGTERM ends it, SIGHUP reads home.xml again.";

struct ServeOptions {
  std::filesystem::path home;
  std::string listen = "127.0.0.1:7777";
  std::filesystem::path token_file;
  std::filesystem::path access_log;
  double checkpoint_s = 60.0;
};

/// One line, in one piece.
void report(const std::string& line) {
  std::cerr << "oikos: " + line + "\n" << std::flush;
}

std::int64_t systemClock_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// Waits for signals in place of the program's usual end by them. Blocked in this thread, and in all that it starts afterwards.
class Signals {
 public:
  explicit Signals(Interrupts& usual) {
    sigemptyset(&awaited_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      sigaddset(&awaited_, signal);
    }
    pthread_sigmask(SIG_BLOCK, &awaited_, nullptr);
    std::signal(SIGHUP, SIG_DFL);  // started with nohup, too, it is a request and not the end of a terminal
    std::signal(SIGPIPE, SIG_IGN);
    usual.stop();
  }

  [[nodiscard]] int wait() const {
    int signal = 0;
    while (sigwait(&awaited_, &signal) != 0) {
    }
    return signal;
  }

 private:
  sigset_t awaited_{};
};

/// Every connection takes a descriptor, and the usual limit is low.
void allowManyDescriptors() {
  constexpr rlim_t kWanted = 4096;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < kWanted) {
    limit.rlim_cur = std::min(kWanted, limit.rlim_max);
    setrlimit(RLIMIT_NOFILE, &limit);
  }
}

base::FileDescriptor openAccessLog(const std::filesystem::path& file) {
  if (file.empty()) {
    return base::FileDescriptor(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0));
  }
  return base::openFile(file, O_WRONLY | O_CREAT | O_APPEND);
}

std::string serverMetrics(const daemon::HttpServer& server) {
  return daemon::metricText("oikos_http_connections", "gauge", "Open connections.", static_cast<std::int64_t>(server.connections())) +
         daemon::metricText("oikos_event_streams", "gauge", "Clients that follow events.", static_cast<std::int64_t>(server.streams()));
}

void announce(const ServeOptions& options, const daemon::ListenAddress& address, const Session& session) {
  const std::string url = "http://" + address.text();
  if (session.options.json) {
    std::cout << R"({"url": ")" << url << R"(", "port": )" << address.port << "}" << std::endl;
  } else {
    std::cout << "oikos: " << options.home.string() << " at " << url << std::endl;
  }
}

void serveUntilStopped(const Signals& signals, daemon::Service& service) {
  while (signals.wait() == SIGHUP) {
    service.reload();
  }
}

ExitCode serve(const ServeOptions& options, const Session& session) {
  daemon::ListenAddress address = daemon::parseListenAddress(options.listen);
  const bool for_all = !daemon::isLoopback(address.host);
  if (for_all && options.token_file.empty()) {
    throw base::Error(base::ErrorCode::kUsage, "other machines can reach it there: --token-file FILE is needed, for reading too",
                      "--listen " + options.listen);
  }
  const Signals signals(session.interrupts);
  allowManyDescriptors();
  daemon::ServiceConfig config;
  config.checkpoint = std::chrono::milliseconds(static_cast<std::int64_t>(options.checkpoint_s * 1e3));
  daemon::Service service(options.home, {systemClock_ns, report}, config);
  const std::string token = daemon::loadOrCreateToken(options.token_file.empty() ? options.home / ".token" : options.token_file);
  base::FileDescriptor listening = daemon::listenAt(address);
  daemon::AccessLog log(openAccessLog(options.access_log));
  daemon::Api api(service, {address.host, token, for_all}, &log);
  daemon::HttpServer server(std::move(listening), api, {});
  api.addMetrics([&server] { return serverMetrics(server); });
  service.onEvents([&server] { server.wakeStreams(); });
  announce(options, address, session);
  serveUntilStopped(signals, service);
  server.stop();
  service.close();
  return ExitCode::kDone;
}

}  // namespace

void addServeCommand(CLI::App& root) {
  CLI::App& command = addCommand(root, {"serve", "Answers about a home over HTTP, and keeps what is observed in it.", kExamples, false});
  const auto options = std::make_shared<ServeOptions>();
  command.add_option("HOME", options->home, "the home's folder")->required();
  command.add_option("--listen", options->listen, "ADDRESS:PORT; port 0 is any free one")->capture_default_str();
  command.add_option("--token-file", options->token_file, "file with the token for writing, made if it is missing; default: HOME/.token");
  command.add_option("--access-log", options->access_log, "file to append a line a request to; default: stderr");
  command.add_option("--checkpoint", options->checkpoint_s, "seconds between two looks whether home.xml has to be written")
      ->check(CLI::Range(0.01, 86400.0))
      ->capture_default_str();
  setAction(command, [options](const Session& session) { return serve(*options, session); });
}

}  // namespace oikos::tools
