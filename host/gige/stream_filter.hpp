// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/filter.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pharos::host {

/// Properties of the camera's datagrams to the stream's port.
struct StreamRule {
  std::uint32_t camera_address = 0;          // IPv4, host order
  std::optional<std::uint16_t> source_port;  // if known
  std::size_t payload_bytes = 0;             // of a frame
  std::size_t packet_size = 0;               // with IP and UDP headers, as GevSCPSPacketSize
  std::optional<bool> extended_ids;          // 64-bit block numbers; empty: unknown
};

/// The rule as a filter for the kernel (SO_ATTACH_FILTER on the UDP socket). Other datagrams are dropped before they
/// use space in the socket's buffer, and before they reach Aravis 0.8.26, which sizes a table by the packet's number
/// and copies by its length without checking either.
///
/// Accepts, from the camera's address and port: leaders of images (packet 0), data packets 1 to n of at most one block,
/// trailers up to n + 1, and refusals of a resend; n = payload / block, rounded up. Block number 0 is not accepted.
std::vector<sock_filter> stream_filter(const StreamRule& rule);

/// For the control channel's socket: accepts responses from the camera's port 3956.
std::vector<sock_filter> control_filter(std::uint32_t camera_address);

/// False if the kernel refuses it.
bool attach_filter(int socket, std::vector<sock_filter> filter);

}  // namespace pharos::host
