// SPDX-License-Identifier: Apache-2.0
#include "integration/camera/spoofed_frames.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <span>

#include "host/device/pixel_format.hpp"
#include "support/datagram.hpp"

namespace pharos::host {
namespace {

using test::Datagram;
using test::put;

constexpr std::size_t kHeaders_bytes = 20 + 8 + 8;  // IP, UDP, GVSP
constexpr std::size_t kPixel_bytes = 8;

Datagram packet(std::uint16_t number, std::uint8_t type, std::uint32_t id) {
  Datagram bytes;
  put(bytes, 0, 2);
  put(bytes, number, 2);
  put(bytes, type, 1);
  put(bytes, id, 3);
  return bytes;
}

}  // namespace

SpoofedFrames::SpoofedFrames(const sim::FrameSequence& sequence, const sim::WireScale& scale, std::int32_t shift_px,
                             std::size_t packet_size)
    : width_px_(sequence.width_px), height_px_(sequence.height_px), block_bytes_(packet_size - kHeaders_bytes) {
  const auto row_bytes = static_cast<std::size_t>(width_px_) * kPixel_bytes;
  payload_.resize(row_bytes * static_cast<std::size_t>(height_px_));
  sim::write_payload(sequence, sequence.frames[0], kCoord3dAbcy16, scale, payload_);
  const auto shift = static_cast<std::ptrdiff_t>(shift_px) * static_cast<std::ptrdiff_t>(kPixel_bytes);
  for (auto row = payload_.begin(); row != payload_.end(); row += static_cast<std::ptrdiff_t>(row_bytes)) {
    std::rotate(row, row + shift, row + static_cast<std::ptrdiff_t>(row_bytes));
  }
}

void SpoofedFrames::send(int socket, std::uint16_t port, const SpoofedHead& head) const {
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(port);
  there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto send_one = [&](const Datagram& bytes) {
    ::sendto(socket, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&there), sizeof there);
  };
  Datagram leader = packet(head.number, 1, 0);
  put(leader, 0, 2);
  put(leader, 1, 2);  // an image
  put(leader, static_cast<std::uint64_t>(head.camera_ns), 8);
  put(leader, kCoord3dAbcy16, 4);
  put(leader, static_cast<std::uint64_t>(width_px_), 4);
  put(leader, static_cast<std::uint64_t>(height_px_), 4);
  put(leader, 0, 12);
  send_one(leader);
  std::uint32_t id = 1;
  for (std::size_t at = 0; at < payload_.size(); at += block_bytes_, ++id) {
    Datagram block = packet(head.number, 3, id);
    const auto rest = std::span(payload_).subspan(at, std::min(block_bytes_, payload_.size() - at));
    block.insert(block.end(), rest.begin(), rest.end());
    send_one(block);
  }
  Datagram trailer = packet(head.number, 2, id);
  put(trailer, 1, 4);
  put(trailer, static_cast<std::uint64_t>(height_px_), 4);
  send_one(trailer);
}

}  // namespace pharos::host
