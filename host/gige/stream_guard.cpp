// SPDX-License-Identifier: Apache-2.0
#include "host/gige/stream_guard.hpp"

#include <poll.h>

#include "host/runtime/now.hpp"

namespace pharos::host {

StreamGuard::StreamGuard(std::uint16_t port, const StreamRule& rule) : rule_(rule) {
  for (const UdpSocket& socket : udp_sockets()) {
    if (socket.port == port && attach_filter(socket.fd, stream_filter(rule))) socket_ = socket.fd;
  }
}

void StreamGuard::learn(std::chrono::milliseconds timeout) {
  if (!is_on() || knows_port()) return;
  // Aravis' thread reads from the socket at the same time: of a frame's many packets only some are seen here.
  const std::int64_t until_ns = monotonic_now_ns() + std::chrono::nanoseconds(timeout).count();
  while (agreeing_ < kAgreeing) {
    const std::int64_t rest_ns = until_ns - monotonic_now_ns();
    pollfd waiting{socket_, POLLIN, 0};
    if (rest_ns <= 0 || ::poll(&waiting, 1, static_cast<int>(rest_ns / 1'000'000 + 1)) <= 0) return;
    const auto datagram = next_waiting(socket_, rule_.camera_address);
    if (!datagram || *datagram == last_) continue;
    agreeing_ = datagram->source_port == last_.source_port ? agreeing_ + 1 : 1;
    last_ = *datagram;
  }
  rule_.source_port = last_.source_port;
  attach_filter(socket_, stream_filter(rule_));
}

std::int64_t StreamGuard::discarded() const { return is_on() ? dropped_datagrams(socket_) : 0; }

void guard_control_sockets(std::uint32_t camera_address) {
  for (const UdpSocket& socket : udp_sockets()) attach_filter(socket.fd, control_filter(camera_address));
}

}  // namespace pharos::host
