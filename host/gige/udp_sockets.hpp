// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace pharos::host {

// Aravis does not expose its sockets; they are found among this process' descriptors by the port that they are bound
// to.

struct UdpSocket {
  int fd = -1;
  std::uint16_t port = 0;
};

/// Every bound IPv4 UDP socket of this process.
std::vector<UdpSocket> udp_sockets();

/// A pending datagram, which is not removed from the socket.
struct WaitingDatagram {
  std::uint16_t source_port = 0;
  std::array<std::uint8_t, 28> head{};  // the GVSP header, standard or extended
  bool operator==(const WaitingDatagram&) const = default;
};

/// The next pending datagram; empty if there is none or it is not from `address`.
std::optional<WaitingDatagram> next_waiting(int socket, std::uint32_t address);

/// Datagrams that the kernel dropped at this socket: by the filter, or for a full buffer.
std::int64_t dropped_datagrams(int socket);

}  // namespace pharos::host
