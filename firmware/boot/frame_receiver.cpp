// SPDX-License-Identifier: Apache-2.0
#include "firmware/boot/frame_receiver.hpp"

#include "pharos/wire/crc32.hpp"

namespace pharos::boot {
namespace {

/// CRC-32 of any bytes followed by their CRC-32.
constexpr std::uint32_t kResidue = 0x2144DF1C;
constexpr std::uint8_t kFullBlock = 0xFF;  // of the stuffing: 254 plain bytes and no zero after them

}  // namespace

void FrameReceiver::store(std::uint8_t byte) {
  if (size_ < plain_.size()) plain_[size_] = byte;
  ++size_;
  crc_ = wire::crc32({&byte, 1}, crc_);
}

bool FrameReceiver::is_good() const {
  constexpr std::size_t kMin = wire::kHeaderBytes + wire::kCrcBytes;
  const bool possible = size_ - kMin <= plain_.size() - kMin;
  return begun_ && left_ == 0 && possible && crc_ == kResidue && plain_[0] == wire::kProtocolVersion;
}

bool FrameReceiver::push(std::uint8_t byte) {
  if (byte == wire::kFrameDelimiter) {
    const bool good = is_good();
    begun_ = false;
    return good;
  }
  if (!begun_) {
    begun_ = true;
    size_ = 0;
    crc_ = 0;
    left_ = 0;
    zero_next_ = false;
  }
  if (left_ != 0) {
    --left_;
    store(byte);
    return false;
  }
  if (zero_next_) store(0);
  zero_next_ = byte != kFullBlock;
  left_ = static_cast<std::uint8_t>(byte - 1);
  return false;
}

}  // namespace pharos::boot
