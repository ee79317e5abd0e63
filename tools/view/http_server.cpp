// SPDX-License-Identifier: Apache-2.0
#include "tools/view/http_server.hpp"

#include <microhttpd.h>

#include <algorithm>
#include <string_view>

#include "host/runtime/now.hpp"
#include "host/support/input_error.hpp"

namespace pharos::tools {
namespace {

// Of libmicrohttpd for a connection: its request's headers and the piece of an answer that is being sent.
constexpr std::size_t kConnectionMemory_bytes = 64 * 1024;
constexpr std::size_t kPiece_bytes = 32 * 1024;

int socket_of(MHD_Connection* connection) {
  return MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
}

std::string_view header(MHD_Connection* connection, const char* name) {
  const char* value = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

std::string_view value_of(MHD_Connection* connection, MHD_ValueKind kind, const char* name) {
  const char* value = MHD_lookup_connection_value(connection, kind, name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

// The page may load nothing but itself, no page may show it in a frame, and its address (with a token) goes nowhere.
void add_headers(MHD_Response* response, std::string_view type) {
  MHD_add_response_header(response, "Content-Type", std::string(type).c_str());
  MHD_add_response_header(response, "Content-Security-Policy",
                          "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
                          "img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
  MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
  MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
  MHD_add_response_header(response, "Cross-Origin-Resource-Policy", "same-origin");
  MHD_add_response_header(response, "Cache-Control", "no-store");
}

int send_text(MHD_Connection* connection, int status, std::string_view type, std::string_view text) {
  MHD_Response* response = MHD_create_response_from_buffer(
      text.size(), const_cast<char*>(text.data()),  // NOLINT(cppcoreguidelines-pro-type-const-cast): it is copied
      MHD_RESPMEM_MUST_COPY);
  add_headers(response, type);
  if (status >= 400) MHD_add_response_header(response, "Connection", "close");
  const MHD_Result queued = MHD_queue_response(connection, static_cast<unsigned>(status), response);
  MHD_destroy_response(response);
  return queued;
}

}  // namespace

/// A request for /states that is being answered.
struct HttpServer::Viewer {
  HttpServer* server = nullptr;
  MHD_Connection* connection = nullptr;
  std::shared_ptr<const std::string> state;  // being sent
  std::size_t sent = 0;                      // bytes of it
  std::int64_t version = 0;                  // of it
  bool suspended = false;
};

struct HttpServer::Callbacks {
  static MHD_Result handle(void* server, MHD_Connection* connection, const char* path, const char* method,
                           const char* /*version*/, const char* /*upload*/, std::size_t* upload_size, void** seen) {
    static char headers_seen;
    if (*seen == nullptr) {  // first call: the headers alone
      *seen = &headers_seen;
      return MHD_YES;
    }
    if (*upload_size > 0) {  // no request has a body that matters
      *upload_size = 0;
      return MHD_YES;
    }
    return static_cast<MHD_Result>(static_cast<HttpServer*>(server)->answer(connection, path, method));
  }
  static void completed(void* server, MHD_Connection* connection, void** /*seen*/, MHD_RequestTerminationCode) {
    auto& self = *static_cast<HttpServer*>(server);
    self.viewers_.erase(connection);
    self.connections_.set_phase(socket_of(connection), ConnectionPhase::kRequesting, host::monotonic_now_ns());
  }
  static void connected(void* server, MHD_Connection* connection, void** /*context*/,
                        MHD_ConnectionNotificationCode code) {
    auto& connections = static_cast<HttpServer*>(server)->connections_;
    const int fd = socket_of(connection);
    if (code == MHD_CONNECTION_NOTIFY_CLOSED) return connections.closed(fd);
    connections.opened(fd, host::monotonic_now_ns());
  }
  static ssize_t read(void* viewer, std::uint64_t /*position*/, char* buffer, std::size_t size) {
    auto& self = *static_cast<Viewer*>(viewer);
    return self.server->read_states(self, buffer, size);
  }
};

HttpServer::HttpServer(const Settings& settings, OnControl on_control, OnPreview on_preview)
    : connections_(settings.address, settings.port),
      targets_(settings.targets),
      on_control_(std::move(on_control)),
      on_preview_(std::move(on_preview)) {
  access_ = {connections_.port(), connections_.is_loopback(), settings.token, settings.has_controls};
  daemon_ = MHD_start_daemon(MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_NO_LISTEN_SOCKET, 0, nullptr, nullptr,
                             &Callbacks::handle, this, MHD_OPTION_CONNECTION_LIMIT,
                             static_cast<unsigned>(Connections::kMaxServed), MHD_OPTION_CONNECTION_MEMORY_LIMIT,
                             kConnectionMemory_bytes, MHD_OPTION_NOTIFY_COMPLETED, &Callbacks::completed, this,
                             MHD_OPTION_NOTIFY_CONNECTION, &Callbacks::connected, this, MHD_OPTION_END);
  if (daemon_ == nullptr) throw host::InputError("libmicrohttpd cannot start: too few file descriptors or no memory");
}

HttpServer::~HttpServer() {
  stopping_ = true;
  for (auto& [connection, viewer] : viewers_) {
    if (viewer->suspended) MHD_resume_connection(connection);
  }
  MHD_run(daemon_);
  MHD_stop_daemon(daemon_);
}

int HttpServer::work_fd() const { return MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_EPOLL_FD)->epoll_fd; }

void HttpServer::accept() {
  while (auto socket = connections_.accept()) {
    sockaddr address{};
    address.sa_family = AF_INET;
    MHD_add_connection(daemon_, socket->release(), &address, sizeof address);
  }
  work();
}

void HttpServer::work() {
  MHD_run(daemon_);
  // Steps that wait for no descriptor; a bound, as other events wait meanwhile.
  unsigned long long timeout_ms = 1;
  for (int i = 0; i < 64 && MHD_get_timeout(daemon_, &timeout_ms) == MHD_YES && timeout_ms == 0; ++i) MHD_run(daemon_);
}

std::string HttpServer::cookie_name() const { return "pharos_view_" + std::to_string(access_.port); }

int HttpServer::answer(MHD_Connection* connection, const char* path, const char* method) {
  connections_.set_phase(socket_of(connection), ConnectionPhase::kAnswering, host::monotonic_now_ns());
  Request request;
  request.method = method;
  request.path = path;
  request.host = header(connection, "Host");
  request.origin = header(connection, "Origin");
  request.fetch_site = header(connection, "Sec-Fetch-Site");
  request.cookie_token = value_of(connection, MHD_COOKIE_KIND, cookie_name().c_str());
  request.query_token = value_of(connection, MHD_GET_ARGUMENT_KIND, "token");
  const Route route = route_of(request, access_);
  switch (route.answer) {
    case Answer::kFile:
      return answer_file(connection, *find_page_file(path), route.give_cookie);
    case Answer::kStates:
      return answer_states(connection);
    case Answer::kTargets:
      return send_text(connection, 200, "application/json", targets_);
    case Answer::kControl:
      return answer_control(connection);
    case Answer::kPreview:
      return answer_preview(connection, route.preview);
    case Answer::kRefused:
      break;
  }
  return answer_refusal(connection, route);
}

int HttpServer::answer_refusal(MHD_Connection* connection, const Route& route) {
  ++refused_requests_;
  return send_text(connection, route.status, "text/plain; charset=utf-8", std::string(route.reason) + '\n');
}

int HttpServer::answer_file(MHD_Connection* connection, const PageFile& file, bool give_cookie) {
  MHD_Response* response = MHD_create_response_from_buffer(
      file.bytes.size(),
      const_cast<char*>(file.bytes.data()),  // NOLINT(cppcoreguidelines-pro-type-const-cast): it is only read
      MHD_RESPMEM_PERSISTENT);
  add_headers(response, file.type);
  if (give_cookie) {
    MHD_add_response_header(response, "Set-Cookie",
                            (cookie_name() + '=' + access_.token + "; HttpOnly; SameSite=Strict; Path=/").c_str());
  }
  const MHD_Result queued = MHD_queue_response(connection, MHD_HTTP_OK, response);
  MHD_destroy_response(response);
  return queued;
}

int HttpServer::answer_states(MHD_Connection* connection) {
  auto viewer = std::make_unique<Viewer>();
  viewer->server = this;
  viewer->connection = connection;
  MHD_Response* response =
      MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kPiece_bytes, &Callbacks::read, viewer.get(), nullptr);
  add_headers(response, "text/event-stream");
  viewers_[connection] = std::move(viewer);
  connections_.set_phase(socket_of(connection), ConnectionPhase::kStreaming, host::monotonic_now_ns());
  const MHD_Result queued = MHD_queue_response(connection, MHD_HTTP_OK, response);
  MHD_destroy_response(response);
  return queued;
}

int HttpServer::answer_control(MHD_Connection* connection) {
  const auto query = [&](const char* name) {
    return MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, name);
  };
  const std::optional<ControlRequest> control = control_of(query("seek"), query("speed"), query("playing"));
  if (!control) return answer_refusal(connection, {Answer::kRefused, 400, "seek, speed or playing is out of range"});
  on_control_(*control);
  return send_text(connection, 204, "text/plain", "");
}

int HttpServer::answer_preview(MHD_Connection* connection, std::size_t number) {
  const Picture picture = on_preview_(number);
  if (picture == nullptr) return answer_refusal(connection, {Answer::kRefused, 404, "no such picture"});
  return send_text(connection, 200, "image/jpeg", {reinterpret_cast<const char*>(picture->data()), picture->size()});
}

std::int64_t HttpServer::read_states(Viewer& viewer, char* buffer, std::size_t size) {
  if (stopping_) return MHD_CONTENT_READER_END_OF_STREAM;
  connections_.moved(socket_of(viewer.connection), host::monotonic_now_ns());
  if (viewer.state == nullptr && viewer.version < version_) {
    viewer.state = state_;
    viewer.version = version_;
    viewer.sent = 0;
  }
  if (viewer.state == nullptr) {
    viewer.suspended = true;
    MHD_suspend_connection(viewer.connection);
    return 0;
  }
  const std::size_t count = std::min(size, viewer.state->size() - viewer.sent);
  viewer.state->copy(buffer, count, viewer.sent);
  viewer.sent += count;
  if (viewer.sent == viewer.state->size()) viewer.state.reset();
  return static_cast<std::int64_t>(count);
}

void HttpServer::publish(std::string state) {
  state_ = std::make_shared<const std::string>("data: " + std::move(state) + "\n\n");
  ++version_;
  for (auto& [connection, viewer] : viewers_) {
    if (!viewer->suspended) continue;
    viewer->suspended = false;
    MHD_resume_connection(connection);
  }
  work();
}

void HttpServer::tick() {
  const std::int64_t now_ns = host::monotonic_now_ns();
  for (auto& [connection, viewer] : viewers_) {
    if (viewer->suspended) connections_.moved(socket_of(connection), now_ns);  // it waits for us
  }
  connections_.shut_late(now_ns);
  work();
}

}  // namespace pharos::tools
