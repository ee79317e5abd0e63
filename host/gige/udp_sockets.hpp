// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace pharos::host {

// Aravis does not hand out its sockets; they are found among this process' descriptors by what they are bound to.

struct UdpSocket {
  int fd = -1;
  std::uint16_t port = 0;
};

/// Every bound IPv4 UDP socket of this process.
std::vector<UdpSocket> udp_sockets();

/// A datagram that waits, and stays where it is.
struct WaitingDatagram {
  std::uint16_t source_port = 0;
  std::array<std::uint8_t, 28> head{};  // GVSP's numbers, of either kind
  bool operator==(const WaitingDatagram&) const = default;
};

/// The next one; empty where none waits, or it is not from `address`.
std::optional<WaitingDatagram> next_waiting(int socket, std::uint32_t address);

/// Datagrams that the kernel dropped at this socket: filtered, or without room.
std::int64_t dropped_datagrams(int socket);

}  // namespace pharos::host
