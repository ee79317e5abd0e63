// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "host/gige/stream_filter.hpp"
#include "host/gige/udp_sockets.hpp"

namespace pharos::host {

/// Filters datagrams that are not the camera's from the stream's socket, and learns the port that the camera sends
/// from.
class StreamGuard {
 public:
  StreamGuard() = default;
  /// For the socket of this process that is bound to `port`. The source port in `rule` (from GevSCSP) is used if set;
  /// otherwise it is learnt. is_on() is false if there is no such socket or the kernel refuses the filter.
  StreamGuard(std::uint16_t port, const StreamRule& rule);

  bool is_on() const { return socket_ >= 0; }
  /// Waits at most `timeout` for datagrams and reads their source ports; kAgreeing in a row from one port determine it.
  /// Returns at once if the port is known.
  void learn(std::chrono::milliseconds timeout);
  bool knows_port() const { return rule_.source_port.has_value(); }
  /// Datagrams that the kernel dropped so far.
  std::int64_t discarded() const;

  /// The filter accepts only well-formed packets from the camera's address: another sender's would have to be this many
  /// of the first ones in a row.
  static constexpr int kAgreeing = 4;

 private:
  int socket_ = -1;
  StreamRule rule_;
  WaitingDatagram last_;
  int agreeing_ = 0;
};

/// Lets only the camera's answers reach this process' control sockets.
void guard_control_sockets(std::uint32_t camera_address);

}  // namespace pharos::host
