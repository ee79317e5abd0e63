// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/filter.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pharos::host {

/// What a datagram to the stream's port must be to be the camera's.
struct StreamRule {
  std::uint32_t camera_address = 0;          // IPv4, host order
  std::optional<std::uint16_t> source_port;  // where it is known
  std::size_t payload_bytes = 0;             // of a frame
  std::size_t packet_size = 0;               // with IP and UDP headers, as GevSCPSPacketSize
  std::optional<bool> extended_ids;          // 64-bit block numbers; empty: the camera does not say
};

/// That rule for the kernel (SO_ATTACH_FILTER on the UDP socket): what does not fit is dropped before it takes room in
/// the socket's buffer, and before Aravis 0.8.26 sees it, which sizes a table by the packet's number and copies by its
/// length without looking at either.
///
/// Lets pass, from the camera's address and port: leaders of images (packet 0), data packets 1 to n that hold a block
/// at the most, trailers up to n + 1, and refusals of a resend; n = payload / block. Block number 0 is none.
std::vector<sock_filter> stream_filter(const StreamRule& rule);

/// For the control channel's socket: answers from the camera's port 3956.
std::vector<sock_filter> control_filter(std::uint32_t camera_address);

/// False where the kernel does not take it.
bool attach_filter(int socket, std::vector<sock_filter> filter);

}  // namespace pharos::host
