// SPDX-License-Identifier: Apache-2.0
#include "tools/daemon/http_server.h"

#include <microhttpd.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

#include "core/base/error.h"
#include "tools/daemon/worker_pool.h"

namespace oikos::daemon {

namespace {

using Clock = ConnectionWatch::Clock;

constexpr std::size_t kConnectionMemory = 64 << 10;  // a request's line and headers; beyond header_bytes, so that the refusal is ours
constexpr std::size_t kStreamBlock = 16 << 10;

/// One TCP connection.
struct Client {
  ConnectionWatch::Connection* watched = nullptr;
  int socket = -1;
  std::string peer;
};

/// One request from its first line to the end of its answer. Its thread is the connection's; while a worker answers, the connection is
/// suspended and the worker has it alone.
struct Pending {
  Request request;
  Client* client = nullptr;
  Clock::time_point begun;
  bool admitted = false;
  bool too_large = false;
  Admission admission;
  std::optional<Response> response;
  EventStreams::Stream* stream = nullptr;
  int status = 0;
  std::size_t bytes = 0;
};

std::string addressOf(MHD_Connection* connection) {
  const MHD_ConnectionInfo* const info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
  const auto size = static_cast<socklen_t>(info->client_addr->sa_family == AF_INET6 ? sizeof(sockaddr_in6) : sizeof(sockaddr_in));
  std::array<char, NI_MAXHOST> text{};
  const bool known = ::getnameinfo(info->client_addr, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0;
  return known ? text.data() : "-";
}

std::string header(MHD_Connection* connection, std::string_view name) {
  const char* value = nullptr;
  std::size_t size = 0;
  MHD_lookup_connection_value_n(connection, MHD_HEADER_KIND, name.data(), name.size(), &value, &size);
  return value == nullptr ? std::string() : std::string(value, size);
}

/// The greatest number there is if the header holds no number.
std::size_t announcedLength(MHD_Connection* connection) {
  const std::string text = header(connection, "Content-Length");
  return text.empty() ? 0 : std::strtoull(text.c_str(), nullptr, 10);
}

/// Takes the body over.
MHD_Response* toLibrary(std::string body) {
  auto* const kept = new std::string(std::move(body));
  return MHD_create_response_from_buffer_with_free_callback_cls(
      kept->size(), kept->data(), [](void* text) { delete static_cast<std::string*>(text); }, kept);
}

void addHeaders(MHD_Response* to, const Response& from) {
  MHD_add_response_header(to, MHD_HTTP_HEADER_CONTENT_TYPE, from.content_type.c_str());
  MHD_add_response_header(to, MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
  MHD_add_response_header(to, "X-Content-Type-Options", "nosniff");
  for (const auto& [name, value] : from.headers) {
    MHD_add_response_header(to, name.c_str(), value.c_str());
  }
}

}  // namespace

class HttpServer::Impl {
 public:
  Impl(base::FileDescriptor listening, RequestHandler& handler, const HttpServerConfig& config)
      : config_(config),
        handler_(handler),
        watch_(config.connections),
        streams_(config.event_streams, [&handler](std::int64_t after) { return handler.eventsAfter(after); }),
        workers_(config.workers),
        listening_(std::move(listening)) {
    start();
    clock_ = std::thread([this] { keepTime(); });
  }
  ~Impl() { stop(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void stop();
  void wakeStreams() { streams_.wake(); }
  [[nodiscard]] std::size_t connections() const { return watch_.count(); }
  [[nodiscard]] std::size_t streams() const { return streams_.count(); }

 private:
  void start();
  void keepTime();
  void letRequestsEnd();
  void connected(MHD_Connection* connection, void** context);
  void disconnected(void** context);
  Pending* begin(const char* target, MHD_Connection* connection);
  MHD_Result proceed(MHD_Connection* connection, Pending& pending, const char* data, std::size_t* size);
  void admit(MHD_Connection* connection, Pending& pending);
  std::optional<Response> refusalBySize(MHD_Connection* connection, const Pending& pending) const;
  MHD_Result answer(MHD_Connection* connection, Pending& pending);
  MHD_Result answerOnWorker(MHD_Connection* connection, Pending& pending);
  MHD_Result send(MHD_Connection* connection, Pending& pending);
  MHD_Response* openStream(MHD_Connection* connection, Pending& pending, std::int64_t after);
  ssize_t readStream(Pending& pending, char* buffer, std::size_t size);
  void finish(Pending* pending);

  const HttpServerConfig config_;
  RequestHandler& handler_;
  ConnectionWatch watch_;
  EventStreams streams_;
  WorkerPool workers_;
  base::FileDescriptor listening_;
  MHD_Daemon* library_ = nullptr;
  std::mutex mutex_;
  std::condition_variable clock_stops_;
  bool stopping_ = false;
  std::thread clock_;
};

void HttpServer::Impl::start() {
  const auto on_connection = [](void* self, MHD_Connection* connection, void** context, MHD_ConnectionNotificationCode code) {
    if (code == MHD_CONNECTION_NOTIFY_STARTED) {
      static_cast<Impl*>(self)->connected(connection, context);
    } else {
      static_cast<Impl*>(self)->disconnected(context);
    }
  };
  const auto on_target = [](void* self, const char* target, MHD_Connection* connection) -> void* {
    return static_cast<Impl*>(self)->begin(target, connection);
  };
  const auto on_request = [](void* self, MHD_Connection* connection, const char*, const char* method, const char*, const char* data,
                             std::size_t* size, void** context) {
    Pending& pending = *static_cast<Pending*>(*context);
    pending.request.method = method;
    return static_cast<Impl*>(self)->proceed(connection, pending, data, size);
  };
  const auto on_end = [](void* self, MHD_Connection*, void** context, MHD_RequestTerminationCode) {
    static_cast<Impl*>(self)->finish(static_cast<Pending*>(std::exchange(*context, nullptr)));
  };
  const auto keep_encoded = [](void*, MHD_Connection*, char* text) { return std::strlen(text); };
  const int own = ::dup(listening_.number());
  if (own < 0) {
    base::throwErrno("cannot serve", "listening socket");
  }
  // The library splits its limit among the threads, evenly and not as connections come: ours is reached first.
  const auto limit = static_cast<unsigned>((config_.connections.connections + 64) * static_cast<std::size_t>(config_.event_threads));
  library_ = MHD_start_daemon(MHD_USE_EPOLL_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_TURBO, 0, nullptr, nullptr, +on_request,
                              this, MHD_OPTION_LISTEN_SOCKET, own, MHD_OPTION_NOTIFY_CONNECTION, +on_connection, this,
                              MHD_OPTION_URI_LOG_CALLBACK, +on_target, this, MHD_OPTION_NOTIFY_COMPLETED, +on_end, this,
                              MHD_OPTION_UNESCAPE_CALLBACK, +keep_encoded, nullptr, MHD_OPTION_CONNECTION_MEMORY_LIMIT, kConnectionMemory,
                              MHD_OPTION_CONNECTION_LIMIT, limit, MHD_OPTION_CONNECTION_TIMEOUT, 0U, MHD_OPTION_THREAD_POOL_SIZE,
                              static_cast<unsigned>(config_.event_threads), MHD_OPTION_END);
  if (library_ == nullptr) {
    throw base::Error(base::ErrorCode::kIo, "the HTTP library could not start: too few threads or file descriptors");
  }
}

void HttpServer::Impl::keepTime() {
  std::unique_lock lock(mutex_);
  while (!clock_stops_.wait_for(lock, config_.tick, [this] { return stopping_; })) {
    lock.unlock();
    watch_.expire(Clock::now());
    streams_.tick(Clock::now());
    lock.lock();
  }
}

void HttpServer::Impl::stop() {
  if (library_ == nullptr) {
    return;
  }
  // Refuses from now on, but stays open to the end: a thread of the library that is about to take it out of its epoll set aborts the
  // process if it is closed by then.
  const base::FileDescriptor quiesced(MHD_quiesce_daemon(library_));
  ::shutdown(quiesced.number(), SHUT_RDWR);
  { const base::FileDescriptor closed(std::move(listening_)); }
  streams_.stop();
  letRequestsEnd();
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  clock_stops_.notify_all();
  clock_.join();
  workers_.finish();  // the library must not be stopped while a connection is suspended
  MHD_stop_daemon(library_);
  library_ = nullptr;
}

void HttpServer::Impl::letRequestsEnd() {
  constexpr std::chrono::milliseconds kLook{5};
  const Clock::time_point end = Clock::now() + config_.grace;
  while (Clock::now() < end && watch_.count() > watch_.count(ConnectionPhase::kWaiting)) {
    std::this_thread::sleep_for(kLook);
  }
}

void HttpServer::Impl::connected(MHD_Connection* connection, void** context) {
  const int socket = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
  *context = new Client{watch_.add(socket, Clock::now()), socket, addressOf(connection)};
}

void HttpServer::Impl::disconnected(void** context) {
  auto* const client = static_cast<Client*>(std::exchange(*context, nullptr));
  watch_.remove(client->watched);
  delete client;
}

Pending* HttpServer::Impl::begin(const char* target, MHD_Connection* connection) {
  auto* const pending = new Pending;
  pending->client = static_cast<Client*>(MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT)->socket_context);
  pending->begun = Clock::now();
  pending->request.target = target;
  pending->request.peer = pending->client->peer;
  watch_.enter(pending->client->watched, ConnectionPhase::kReceiving, pending->begun);
  return pending;
}

/// Called when the headers are there, with each piece of the body, at its end, and after a worker has answered.
MHD_Result HttpServer::Impl::proceed(MHD_Connection* connection, Pending& pending, const char* data, std::size_t* size) {
  if (!pending.admitted) {
    pending.admitted = true;
    admit(connection, pending);
    const bool has_body = announcedLength(connection) > 0 || !header(connection, "Transfer-Encoding").empty();
    return pending.response && has_body ? send(connection, pending) : MHD_YES;  // an answer before the body closes the connection
  }
  if (*size > 0) {
    pending.too_large = pending.too_large || pending.request.body.size() + *size > config_.body_bytes;
    if (!pending.too_large) {
      pending.request.body.append(data, *size);
    }
    *size = 0;
    return MHD_YES;
  }
  if (pending.too_large && !pending.response) {
    pending.response = failure(413, "too_large", "the body is longer than " + std::to_string(config_.body_bytes) + " bytes");
  }
  return pending.response ? send(connection, pending) : answer(connection, pending);
}

void HttpServer::Impl::admit(MHD_Connection* connection, Pending& pending) {
  Request& request = pending.request;
  request.host = header(connection, "Host");
  request.authorization = header(connection, "Authorization");
  request.last_event_id = header(connection, "Last-Event-ID");
  pending.response = refusalBySize(connection, pending);
  if (!pending.response) {
    pending.admission = handler_.admit(request);
    pending.response = std::move(pending.admission.refusal);
  }
}

std::optional<Response> HttpServer::Impl::refusalBySize(MHD_Connection* connection, const Pending& pending) const {
  if (pending.request.target.size() > config_.target_bytes) {
    return failure(414, "target_too_long", "the address is longer than " + std::to_string(config_.target_bytes) + " bytes");
  }
  if (MHD_get_connection_info(connection, MHD_CONNECTION_INFO_REQUEST_HEADER_SIZE)->header_size > config_.header_bytes) {
    return failure(431, "headers_too_large", "the headers are longer than " + std::to_string(config_.header_bytes) + " bytes");
  }
  if (announcedLength(connection) > config_.body_bytes) {
    return failure(413, "too_large", "the body is longer than " + std::to_string(config_.body_bytes) + " bytes");
  }
  return std::nullopt;
}

MHD_Result HttpServer::Impl::answer(MHD_Connection* connection, Pending& pending) {
  watch_.enter(pending.client->watched, ConnectionPhase::kAnswering, Clock::now());
  if (pending.admission.may_wait) {
    return answerOnWorker(connection, pending);
  }
  pending.response = handler_.respond(pending.request);
  return send(connection, pending);
}

MHD_Result HttpServer::Impl::answerOnWorker(MHD_Connection* connection, Pending& pending) {
  MHD_suspend_connection(connection);
  const bool taken = workers_.add([this, connection, &pending] {
    pending.response = handler_.respond(pending.request);
    MHD_resume_connection(connection);
  });
  if (!taken) {
    pending.response = failure(503, "stopping", "the daemon is being stopped");
    MHD_resume_connection(connection);
  }
  return MHD_YES;
}

MHD_Result HttpServer::Impl::send(MHD_Connection* connection, Pending& pending) {
  watch_.enter(pending.client->watched, ConnectionPhase::kAnswering, Clock::now());
  OIKOS_CHECK(pending.response.has_value());
  Response& response = *pending.response;
  MHD_Response* message = response.events_after ? openStream(connection, pending, *response.events_after) : nullptr;
  if (message == nullptr) {
    pending.bytes = response.body.size();
    message = toLibrary(std::move(response.body));
  }
  addHeaders(message, response);
  pending.status = response.status;
  const MHD_Result queued = MHD_queue_response(connection, static_cast<unsigned>(pending.status), message);
  MHD_destroy_response(message);
  return queued;
}

/// Null: there are too many, and the response says so now.
MHD_Response* HttpServer::Impl::openStream(MHD_Connection* connection, Pending& pending, std::int64_t after) {
  pending.stream = streams_.open(after,
                                 {.socket = pending.client->socket,
                                  .suspend = [connection] { MHD_suspend_connection(connection); },
                                  .resume = [connection] { MHD_resume_connection(connection); }},
                                 Clock::now());
  if (pending.stream == nullptr) {
    pending.response =
        failure(503, "too_many_streams", "no more than " + std::to_string(config_.event_streams) + " clients may follow events");
    return nullptr;
  }
  watch_.enter(pending.client->watched, ConnectionPhase::kStreaming, Clock::now());
  const auto read = [](void* context, std::uint64_t, char* buffer, std::size_t size) -> ssize_t {
    auto& [self, its] = *static_cast<std::pair<Impl*, Pending*>*>(context);
    return self->readStream(*its, buffer, size);
  };
  const auto free = [](void* context) { delete static_cast<std::pair<Impl*, Pending*>*>(context); };
  return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kStreamBlock, read, new std::pair<Impl*, Pending*>(this, &pending), free);
}

ssize_t HttpServer::Impl::readStream(Pending& pending, char* buffer, std::size_t size) {
  const Clock::time_point now = Clock::now();
  watch_.enter(pending.client->watched, ConnectionPhase::kStreaming, now);
  const std::optional<std::size_t> read = streams_.read(pending.stream, {buffer, size}, now);
  pending.bytes += read.value_or(0);
  return read ? static_cast<ssize_t>(*read) : MHD_CONTENT_READER_END_OF_STREAM;
}

void HttpServer::Impl::finish(Pending* pending) {
  if (pending->stream != nullptr) {
    streams_.close(pending->stream);
  }
  const Clock::time_point now = Clock::now();
  watch_.enter(pending->client->watched, ConnectionPhase::kWaiting, now);
  handler_.finished({pending->request, pending->status, pending->bytes, now - pending->begun});
  delete pending;
}

HttpServer::HttpServer(base::FileDescriptor listening, RequestHandler& handler, const HttpServerConfig& config)
    : impl_(std::make_unique<Impl>(std::move(listening), handler, config)) {}

HttpServer::~HttpServer() = default;

void HttpServer::wakeStreams() {
  impl_->wakeStreams();
}

void HttpServer::stop() {
  impl_->stop();
}

std::size_t HttpServer::connections() const {
  return impl_->connections();
}

std::size_t HttpServer::streams() const {
  return impl_->streams();
}

}  // namespace oikos::daemon
