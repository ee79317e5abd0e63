// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/ootx_frames.hpp"

namespace pharos::lighthouse {
namespace {

constexpr std::uint8_t kPreambleZeros = 17;

}  // namespace

std::uint32_t ootx_crc(const std::uint8_t* bytes, std::size_t size) {
  // Bit by bit: there is one payload every three seconds, and a table would cost a kilobyte.
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

std::optional<OotxFrames::Payload> OotxFrames::push(bool bit, bool follows_last, DecoderCounters& counters) {
  if (!follows_last) {
    if (in_frame_) ++counters.ootx_restarts;
    abandon();
    zeros_ = 0;
  }
  const bool preamble_ends = bit && zeros_ >= kPreambleZeros;
  zeros_ = bit ? std::uint8_t{0} : static_cast<std::uint8_t>(zeros_ < kPreambleZeros ? zeros_ + 1 : zeros_);
  if (preamble_ends) {
    in_frame_ = true;
    size_ = 0;
    bits_in_word_ = 0;
    word_ = 0;
    return std::nullopt;
  }
  if (!in_frame_) return std::nullopt;
  if (bits_in_word_ < 16) {
    word_ = (word_ << 1U) | (bit ? 1U : 0U);
    ++bits_in_word_;
    return std::nullopt;
  }
  if (!bit) {
    ++counters.ootx_bad_sync;
    abandon();
    return std::nullopt;
  }
  return finish_word(counters);
}

std::optional<OotxFrames::Payload> OotxFrames::finish_word(DecoderCounters& counters) {
  bytes_[size_++] = static_cast<std::uint8_t>(word_ >> 8U);
  bytes_[size_++] = static_cast<std::uint8_t>(word_ & 0xFFU);
  bits_in_word_ = 0;
  word_ = 0;
  const std::size_t length = payload_length();
  if (length == 0 || length > kMaxOotxPayload) {
    ++counters.ootx_bad_length;
    abandon();
    return std::nullopt;
  }
  const std::size_t crc_at = kLengthBytes + padded(length);
  if (size_ < crc_at + kCrcBytes) return std::nullopt;
  abandon();
  std::uint32_t sent = 0;
  for (std::size_t i = 0; i < kCrcBytes; ++i) sent |= std::uint32_t{bytes_[crc_at + i]} << (8U * i);
  if (ootx_crc(bytes_.data() + kLengthBytes, length) != sent) {
    ++counters.ootx_bad_crc;
    return std::nullopt;
  }
  ++counters.ootx_frames;
  Payload payload;
  for (std::size_t i = 0; i < length; ++i) payload.push_back(bytes_[kLengthBytes + i]);
  return payload;
}

}  // namespace pharos::lighthouse
