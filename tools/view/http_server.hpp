// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/view/connections.hpp"
#include "tools/view/page_files.hpp"
#include "tools/view/routes.hpp"

struct MHD_Connection;
struct MHD_Daemon;
struct MHD_Response;

namespace pharos::tools {

/// Serves the page and its states (libmicrohttpd, in the thread of its caller).
///
/// A viewer holds one request for /states (Server-Sent Events). It has no queue: when it has taken one state it is
/// given the newest, so a slow one misses states but never sees an old one, and needs no memory.
class HttpServer {
 public:
  struct Settings {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;  // 0: any free one
    std::string token;       // required of everyone where not empty
    bool has_controls = false;
    std::string targets;  // what /targets answers
  };
  using OnControl = std::function<void(const ControlRequest&)>;
  /// A JPEG; null: there is none of this number.
  using Picture = std::shared_ptr<const std::vector<std::uint8_t>>;
  using OnPreview = std::function<Picture(std::size_t number)>;

  /// Throws host::InputError where the address cannot be listened on.
  HttpServer(const Settings& settings, OnControl on_control, OnPreview on_preview);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Two descriptors to watch: new connections, and work on those that are served.
  int listen_fd() const { return connections_.fd(); }
  int work_fd() const;
  void accept();
  void work();

  /// The newest state, for all viewers.
  void publish(std::string state);
  /// Some times a second: ends connections beyond their time.
  void tick();

  std::uint16_t port() const { return connections_.port(); }
  bool is_loopback() const { return connections_.is_loopback(); }
  int viewers() const { return static_cast<int>(viewers_.size()); }
  /// Connections beyond the limit, and requests that were refused.
  std::int64_t refused() const { return connections_.refused() + refused_requests_; }

 private:
  struct Viewer;
  struct Callbacks;  // libmicrohttpd's, in C

  int answer(MHD_Connection* connection, const char* path, const char* method);
  int answer_refusal(MHD_Connection* connection, const Route& route);
  int answer_file(MHD_Connection* connection, const PageFile& file, bool give_cookie);
  int answer_states(MHD_Connection* connection);
  int answer_control(MHD_Connection* connection);
  int answer_preview(MHD_Connection* connection, std::size_t number);
  std::int64_t read_states(Viewer& viewer, char* buffer, std::size_t size);
  std::string cookie_name() const;

  Connections connections_;
  Access access_;
  std::string targets_;
  OnControl on_control_;
  OnPreview on_preview_;
  std::shared_ptr<const std::string> state_;
  std::int64_t version_ = 0;
  std::map<MHD_Connection*, std::unique_ptr<Viewer>> viewers_;
  std::int64_t refused_requests_ = 0;
  bool stopping_ = false;
  MHD_Daemon* daemon_ = nullptr;
};

}  // namespace pharos::tools
