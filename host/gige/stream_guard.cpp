// SPDX-License-Identifier: Apache-2.0
#include "host/gige/stream_guard.hpp"

#include <poll.h>

namespace pharos::host {

StreamGuard::StreamGuard(std::uint16_t port, const StreamRule& rule) : rule_(rule) {
  for (const UdpSocket& socket : udp_sockets()) {
    if (socket.port == port && attach_filter(socket.fd, stream_filter(rule))) socket_ = socket.fd;
  }
}

void StreamGuard::learn(std::chrono::milliseconds timeout) {
  if (!is_on() || knows_port()) return;
  pollfd waiting{socket_, POLLIN, 0};
  if (::poll(&waiting, 1, static_cast<int>(timeout.count())) <= 0) return;
  // Aravis' thread takes them away at the same time: some are seen, of a frame's many.
  constexpr int kLooks = 16;
  for (int i = 0; i < kLooks && agreeing_ < kAgreeing; ++i) {
    const auto datagram = next_waiting(socket_, rule_.camera_address);
    if (!datagram || *datagram == last_) continue;
    agreeing_ = datagram->source_port == last_.source_port ? agreeing_ + 1 : 1;
    last_ = *datagram;
  }
  if (agreeing_ < kAgreeing) return;
  rule_.source_port = last_.source_port;
  attach_filter(socket_, stream_filter(rule_));
}

std::int64_t StreamGuard::discarded() const { return is_on() ? dropped_datagrams(socket_) : 0; }

void guard_control_sockets(std::uint32_t camera_address) {
  for (const UdpSocket& socket : udp_sockets()) attach_filter(socket.fd, control_filter(camera_address));
}

}  // namespace pharos::host
