// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/convert/light_hit.hpp"

namespace pharos::convert {

/// One angle of the event lhAngle, when it was logged (not when the light came).
struct LoggedAngle {
  double time_s = 0.0;
  std::uint8_t sensor = 0;
  std::uint8_t station = 0;
  std::uint8_t plane = 0;
  double angle_rad = 0.0;  // 0 straight ahead
};

/// A pulse of light as the decoder board told it: event lhUartFrame.
struct LightFrame {
  double time_s = 0.0;  // when it was logged
  std::uint8_t sensor = 0;
  std::uint32_t stamp_ticks = 0;  // 24 MHz, when the light came, on the board's clock; wraps
};

/// What Pharos uses of a log of a Crazyflie's memory card.
struct CrazyflieLog {
  std::vector<LoggedAngle> angles;
  std::vector<LightFrame> frames;  // none in some logs
  std::vector<ImuSample> imu;
  std::vector<CrossingBeam> crossing_beams;
  std::vector<LogEvent> events;  // markers_on, markers_off
  std::size_t unusable = 0;      // events whose values are not finite or not possible: left out
};

/// Decodes a log: byte 0xBC, u16 version (2), u16 number of event types (u16 id, name, u16 number of variables, each
/// `name(t)` with t of Python's struct), events (u16 id, u64 microseconds, packed variables), CRC-32 of all before; all
/// little-endian. Events of other names are skipped.
///
/// `name` stands for the file in messages. Throws InputError of one line: not such a log, another version, broken (the
/// checksum), cut off, an event type that is not declared or lacks a variable.
CrazyflieLog read_crazyflie_log(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace pharos::convert
