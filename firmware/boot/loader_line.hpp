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

/// The serial line as the loader uses it: frames in and out, without interrupts.
///
/// take_bytes() fetches what has come and is called wherever something takes time, so that a UART with room for one
/// byte does for receiving while flash is written and while frames are sent.
template <BootBoard Board>
class LoaderLine {
 public:
  void take_bytes() {
    for (;;) {
      const int byte = Board::receive();
      if (byte < 0) return;
      (void)waiting_.push(static_cast<std::uint8_t>(byte));  // full: the frame's CRC tells
    }
  }

  /// Whether there is a good frame among the bytes that have come; request() holds it until the next call.
  bool next_frame() {
    for (take_bytes(); !waiting_.empty(); take_bytes()) {
      if (receiver_.push(waiting_.pop())) return true;
    }
    return false;
  }
  const FrameReceiver& request() const { return receiver_; }

  /// Returns when the last byte was given to the UART.
  void send(wire::MessageType type, std::span<const std::uint8_t> payload) {
    for (const std::uint8_t byte : sender_.encode(type, payload)) {
      do {
        take_bytes();
      } while (!Board::transmit(byte));
    }
  }

 private:
  /// All that a host may send before it hears of the first of them.
  static constexpr std::size_t kWaitingBytes = 1024;
  static_assert(wire::kLoaderWindow * wire::line_size(wire::LoaderData::kMaxBytes) <= kWaitingBytes);

  RingBuffer<std::uint8_t, kWaitingBytes> waiting_;
  FrameReceiver receiver_;
  FrameSender sender_;
};

}  // namespace pharos::boot
