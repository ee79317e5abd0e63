// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/boot/boot_board.hpp"
#include "firmware/boot/frame_receiver.hpp"
#include "firmware/boot/frame_sender.hpp"
#include "pharos/base/ring_buffer.hpp"
#include "pharos/wire/frame.hpp"
#include "pharos/wire/loader_messages.hpp"

namespace pharos::boot {

/// The loader's serial line: frames in and out, without interrupts.
///
/// take_bytes() fetches received bytes and is called wherever work takes time, so that a UART with room for one byte
/// suffices for reception while flash is written and while frames are sent.
template <BootBoard Board>
class LoaderLine {
 public:
  void take_bytes() {
    for (;;) {
      const int byte = Board::receive();
      if (byte < 0) return;
      (void)waiting_.push(static_cast<std::uint8_t>(byte));  // full: detected by the frame's CRC
    }
  }

  /// Whether there is a good frame among the received bytes; request() holds it until the next call.
  bool next_frame() {
    for (take_bytes(); !waiting_.empty(); take_bytes()) {
      if (receiver_.push(waiting_.pop())) return true;
    }
    return false;
  }
  const FrameReceiver& request() const { return receiver_; }

  /// Returns when the last byte was passed to the UART.
  void send(wire::MessageType type, std::span<const std::uint8_t> payload) {
    for (const std::uint8_t byte : sender_.encode(type, payload)) {
      do {
        take_bytes();
      } while (!Board::transmit(byte));
    }
  }

 private:
  /// Everything that a host may send before the first reply.
  static constexpr std::size_t kWaitingBytes = 1024;
  static_assert(wire::kLoaderWindow * wire::line_size(wire::LoaderData::kMaxBytes) <= kWaitingBytes);

  RingBuffer<std::uint8_t, kWaitingBytes> waiting_;
  FrameReceiver receiver_;
  FrameSender sender_;
};

}  // namespace pharos::boot
