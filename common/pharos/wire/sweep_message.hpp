// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/axis.hpp"
#include "pharos/base/capacity.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

// Ranges of real pulses: wider than the decoder's output (`report` compares them with lighthouse/optical_timing.hpp),
// and narrow enough that every angle and time computed from them is plausible.

/// Pulses: shorter ones are glitches, longer ones no station sends; the longest pulse of a flash is at least 2600.
inline constexpr std::int32_t kMinPulse_ticks = 16;
inline constexpr std::int32_t kMaxPulse_ticks = 7500;
inline constexpr std::int32_t kMinFlash_ticks = 2600;
/// Rotors are held to 60 Hz, 833,333 ticks a revolution; the decoder rejects a period that is off by 0.1 %, the line
/// one off by 1 %.
inline constexpr std::uint32_t kMinPeriod_sixteenth_ticks = 13'200'000;
inline constexpr std::uint32_t kMaxPeriod_sixteenth_ticks = 13'466'666;
/// A laser hit is after its flash and within the slot, half a revolution; 3.14 rad.
inline constexpr std::int32_t kMaxCentre_half_ticks = 2 * 416'667;

/// One laser hit; fields as in lighthouse::Hit. 7 bytes.
struct SweepHit {
  std::uint8_t sensor = 0;             // 0..31
  std::uint16_t width_ticks = 0;       // kMinPulse_ticks..kMaxPulse_ticks
  std::int32_t centre_half_ticks = 0;  // 0..kMaxCentre_half_ticks
  bool operator==(const SweepHit&) const = default;
};

/// All fields of a sweep except its hits.
struct SweepHead {
  std::int64_t flash_start_ticks = 0;        // 64 bits unwrapped
  std::int32_t flash_length_ticks = 0;       // kMinFlash_ticks..kMaxPulse_ticks
  std::uint32_t period_sixteenth_ticks = 0;  // kMinPeriod_sixteenth_ticks..kMaxPeriod_sixteenth_ticks
  std::uint8_t flash_sensors = 0;            // 0..32
  std::uint8_t flags = 0;                    // of lighthouse::SweepFlag
  std::uint8_t station = 0;                  // 0 or 1
  Axis axis = Axis::kX;
  bool data = false;
  bool skip = false;
};

/// One rotor's sweep with its flash and every candidate hit; all of lighthouse::Sweep, bit by bit.
///
/// 20 bytes and 7 a hit: 12 sensors hit once at 120 sweeps/s are 13.8 kB/s on the line, 30 % of 460,800 baud.
struct Sweep : SweepHead {
  static constexpr MessageType kType = MessageType::kSweep;
  static constexpr std::size_t kHeadBytes = 20;
  static constexpr std::size_t kHitBytes = 7;
  static constexpr std::size_t kMaxBytes = kHeadBytes + kHitBytes * kMaxHitsPerSweep;

  StaticVector<SweepHit, kMaxHitsPerSweep> hits;
};

void write(const Sweep& message, ByteWriter& out);
/// The same in pieces, for callers that have the hits elsewhere: the head, then each hit.
void write(const SweepHead& head, std::size_t hits, ByteWriter& out);
void write(const SweepHit& hit, ByteWriter& out);
void read(ByteReader& in, Sweep& message);

}  // namespace pharos::wire
