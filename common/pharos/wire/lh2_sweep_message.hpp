// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

// Ranges of Lighthouse 2.0; `report` compares them with lighthouse/lh2_channels.hpp. Sixths: 1/6 tick of 20 ns.

inline constexpr std::uint8_t kMaxLh2Channel = 15;
/// No laser plane stays on a sensor for longer (100 us).
inline constexpr std::uint16_t kMaxLh2Width_ticks = 5000;
/// The longest turn: 959,000 ticks of 48 MHz.
inline constexpr std::int32_t kMaxLh2Centre_sixths = 119'875 * 50;

/// One hit; fields as in lighthouse::Lh2Hit. 7 bytes.
struct Lh2SweepHit {
  std::uint8_t sensor = 0;         // 0..31
  std::uint16_t width_ticks = 0;   // 1..kMaxLh2Width_ticks
  std::int32_t centre_sixths = 0;  // 0..kMaxLh2Centre_sixths
  bool operator==(const Lh2SweepHit&) const = default;
};

/// One pass of a laser plane of a Lighthouse 2.0 station over the target; all of lighthouse::Lh2Sweep, bit by bit.
///
/// 11 bytes and 7 a hit: 12 sensors at 100 passes/s are 10.7 kB/s of the line for each station.
struct Lh2Sweep {
  static constexpr MessageType kType = MessageType::kLh2Sweep;
  static constexpr std::size_t kHeadBytes = 11;
  static constexpr std::size_t kHitBytes = 7;
  static constexpr std::size_t kMaxBytes = kHeadBytes + kHitBytes * kMaxHitsPerSweep;

  std::int64_t sync_ticks = 0;   // 64 bits unwrapped
  std::uint8_t sync_sixths = 0;  // 0..5, after sync_ticks
  std::uint8_t channel = 0;      // 0..15
  std::uint8_t plane = 0;        // 0 = a, 1 = b
  bool slow_bit = false;
  StaticVector<Lh2SweepHit, kMaxHitsPerSweep> hits;
};

void write(const Lh2Sweep& message, ByteWriter& out);
void read(ByteReader& in, Lh2Sweep& message);

/// One OOTX payload of a Lighthouse 2.0 station, CRC checked.
struct Lh2Ootx {
  static constexpr MessageType kType = MessageType::kLh2Ootx;
  static constexpr std::size_t kMaxData = 64;
  static constexpr std::size_t kMaxBytes = 10 + kMaxData;

  std::int64_t time_ticks = 0;
  std::uint8_t channel = 0;  // 0..15
  StaticVector<std::uint8_t, kMaxData> data;
};

void write(const Lh2Ootx& message, ByteWriter& out);
void read(ByteReader& in, Lh2Ootx& message);

}  // namespace pharos::wire
