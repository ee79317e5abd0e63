// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/base/static_vector.hpp"
#include "pharos/lighthouse/decoder_counters.hpp"
#include "pharos/lighthouse/ootx_payload.hpp"

namespace pharos::lighthouse {

/// OOTX frames from the data bits of one station's flashes, one bit at a time.
///
/// A frame: 17 zeros and a one; then 16-bit words, each followed by a one: length (little-endian), payload padded to a
/// whole word, CRC-32 (zlib's, little-endian, over the payload without the pad). Bytes come most significant bit first.
/// Inside a frame 17 zeros in a row cannot occur, so the preamble is searched at every bit, in any state.
class OotxFrames {
 public:
  using Payload = StaticVector<std::uint8_t, kMaxOotxPayload>;

  /// The next bit; `follows_last` false: bits between were lost. Returns the payload when its CRC is good.
  std::optional<Payload> push(bool bit, bool follows_last, DecoderCounters& counters);

 private:
  static constexpr std::size_t kLengthBytes = 2;
  static constexpr std::size_t kCrcBytes = 4;

  void abandon() { in_frame_ = false; }
  std::optional<Payload> finish_word(DecoderCounters& counters);
  std::size_t payload_length() const { return static_cast<std::size_t>(bytes_[0] | bytes_[1] << 8); }
  static std::size_t padded(std::size_t length) { return length + length % 2; }

  std::array<std::uint8_t, kLengthBytes + kMaxOotxPayload + kCrcBytes> bytes_{};
  std::size_t size_ = 0;
  std::uint32_t word_ = 0;
  std::uint8_t bits_in_word_ = 0;
  std::uint8_t zeros_ = 0;  // in a row, up to 17
  bool in_frame_ = false;
};

/// CRC-32 as zlib computes it.
std::uint32_t ootx_crc(const std::uint8_t* bytes, std::size_t size);

}  // namespace pharos::lighthouse
