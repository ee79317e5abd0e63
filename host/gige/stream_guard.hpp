// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

#include "host/gige/stream_filter.hpp"
#include "host/gige/udp_sockets.hpp"

namespace pharos::host {

/// Keeps from a stream's socket what is not the camera's, and learns the port that the camera sends from.
class StreamGuard {
 public:
  StreamGuard() = default;
  /// For the socket of this process that is bound to `port`. A source port in `rule` is that of GevSCSP and holds; else
  /// it is learnt. is_on() is false where there is no such socket or the kernel takes no filter.
  StreamGuard(std::uint16_t port, const StreamRule& rule);

  bool is_on() const { return socket_ >= 0; }
  /// Waits at most `timeout` for datagrams and looks where they come from; kAgreeing in a row from one port fix it.
  /// Returns at once where the port is known.
  void learn(std::chrono::milliseconds timeout);
  bool knows_port() const { return rule_.source_port.has_value(); }
  /// Datagrams that the kernel dropped so far.
  std::int64_t discarded() const;

  /// Only packets of whole structure from the camera's address are waiting by then: another sender's would have to come
  /// first this often.
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
