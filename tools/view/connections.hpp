// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "host/support/unique_fd.hpp"

namespace pharos::tools {

/// What one connection does, for how long it may.
enum class ConnectionPhase : std::uint8_t {
  kRequesting,  // its request is not complete (or the next one has not begun)
  kAnswering,   // a file is on its way
  kStreaming,   // it receives states; limited by progress, not by time
};

/// A socket that accepts connections, and the limits that keep a few clients from taking all: 64 connections, others
/// are answered 503 at once; a request must be complete in 5 s, an answer taken in 30 s, a stream must move every 5 s.
class Connections {
 public:
  static constexpr std::size_t kMaxServed = 64;

  /// Listens on `address` (a numeric IPv4 or IPv6 address) and `port` (0: any free one). Throws host::InputError where
  /// it cannot.
  Connections(const std::string& address, std::uint16_t port);

  int fd() const { return listener_.get(); }
  std::uint16_t port() const { return port_; }
  /// Of this computer alone.
  bool is_loopback() const { return loopback_; }

  /// The next connection that will be served; those beyond the limit are refused here. Empty when none waits.
  std::optional<host::UniqueFd> accept();

  void opened(int fd, std::int64_t now_ns);
  void closed(int fd) { served_.erase(fd); }
  void set_phase(int fd, ConnectionPhase phase, std::int64_t now_ns);
  /// The connection took bytes of its stream, or waits for new ones.
  void moved(int fd, std::int64_t now_ns);
  /// Some times a second: connections beyond their time are shut down; their owner then sees their end.
  void shut_late(std::int64_t now_ns);

  std::size_t served() const { return served_.size(); }
  std::int64_t refused() const { return refused_; }

 private:
  struct Served {
    ConnectionPhase phase = ConnectionPhase::kRequesting;
    std::int64_t since_ns = 0;
  };
  void refuse(host::UniqueFd socket);

  host::UniqueFd listener_;
  std::uint16_t port_ = 0;
  bool loopback_ = true;
  std::map<int, Served> served_;
  // Refused ones stay open until as many more have come, so that their clients read the answer before the end.
  std::array<host::UniqueFd, 64> lingering_;
  std::size_t next_lingering_ = 0;
  std::int64_t refused_ = 0;
};

}  // namespace pharos::tools
