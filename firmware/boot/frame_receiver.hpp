// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pharos/wire/frame.hpp"
#include "pharos/wire/loader_messages.hpp"

namespace pharos::boot {

/// Finds frames in a stream of bytes: wire::FrameDecoder for 4 KiB. It removes stuffing and computes the CRC byte by
/// byte, so that no byte takes much longer than another; it counts nothing, and accepts any sequence number: each
/// request to the loader may be repeated.
class FrameReceiver {
 public:
  /// Whether `byte` completed a good frame of this protocol version; its content, below, is valid until the next push.
  bool push(std::uint8_t byte);
  wire::MessageType type() const { return static_cast<wire::MessageType>(plain_[1]); }
  const std::uint8_t* sequence() const { return plain_.data() + 2; }  // as it lies in the frame
  const std::uint8_t* payload() const { return plain_.data() + wire::kHeaderBytes; }
  std::size_t payload_bytes() const { return size_ - wire::kHeaderBytes - wire::kCrcBytes; }

 private:
  /// The longest request is a block of data.
  static constexpr std::size_t kCapacity = wire::kHeaderBytes + wire::LoaderData::kMaxBytes + wire::kCrcBytes;

  void store(std::uint8_t byte);
  bool is_good() const;

  alignas(4) std::array<std::uint8_t, kCapacity> plain_{};
  std::size_t size_ = 0;    // more than the capacity: too long
  std::uint32_t crc_ = 0;   // of all stored
  std::uint8_t left_ = 0;   // of the block of stuffing begun
  bool zero_next_ = false;  // the byte after the block follows a zero
  bool begun_ = false;      // since the last border
};

}  // namespace pharos::boot
