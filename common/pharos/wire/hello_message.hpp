// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"
#include "pharos/wire/text.hpp"

namespace pharos::wire {

/// The sending program.
enum class Role : std::uint8_t { kDecoder = 0, kLoader = 1, kSimulator = 2 };

/// Reason of the target's last start.
enum class ResetCause : std::uint8_t { kUnknown = 0, kPowerOn = 1, kCommand = 2, kWatchdog = 3, kFault = 4 };
inline constexpr std::uint8_t kResetCauses = 5;

/// The target's active modes; one bit each.
enum HelloMode : std::uint8_t {
  kModeSweeps = 1,    // sends sweeps and OOTX payloads
  kModePoses = 2,     // sends on-board poses
  kModeRawEdges = 4,  // diagnostic: sends every edge
};

/// Identity of the sender: the first frame after every start (with sequence number 0), again once a second, and on
/// request.
struct Hello {
  static constexpr MessageType kType = MessageType::kHello;
  static constexpr std::size_t kMaxBytes = 76;

  Role role = Role::kDecoder;
  ResetCause reset_cause = ResetCause::kUnknown;
  std::uint8_t modes = 0;  // of HelloMode
  std::uint8_t firmware_major = 0;
  std::uint8_t firmware_minor = 0;
  std::uint8_t firmware_patch = 0;
  std::uint16_t start_count = 0;   // changes at every start, where the board can count starts
  std::uint32_t tick_rate_hz = 0;  // 50,000,000
  std::uint32_t sensors = 0;       // bit n: an input for sensor n exists
  std::int64_t time_ticks = 0;     // now
  std::uint32_t unique_id = 0;     // of the board; 0 where it has none
  Text<24> board;
  Text<24> target;  // name given to this target; empty where none was given
};

/// The target's clock, read when the frame was made: the host fits its clock to it. Ten a second (20 bytes each on the
/// line), because sweeps contain the time of the light and not that of sending.
struct Time {
  static constexpr MessageType kType = MessageType::kTime;
  static constexpr std::size_t kMaxBytes = 8;

  std::int64_t time_ticks = 0;
};

void write(const Time& message, ByteWriter& out);
void read(ByteReader& in, Time& message);
void write(const Hello& message, ByteWriter& out);
void read(ByteReader& in, Hello& message);

}  // namespace pharos::wire
