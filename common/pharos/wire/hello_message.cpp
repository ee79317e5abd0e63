// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/hello_message.hpp"

namespace pharos::wire {

void write(const Time& message, ByteWriter& out) { out.put_ticks(message.time_ticks); }

void read(ByteReader& in, Time& message) { message.time_ticks = in.get_ticks(); }

void write(const Hello& message, ByteWriter& out) {
  out.put(static_cast<std::uint8_t>(message.role));
  out.put(static_cast<std::uint8_t>(message.reset_cause));
  out.put(message.modes);
  out.put(message.firmware_major);
  out.put(message.firmware_minor);
  out.put(message.firmware_patch);
  out.put(message.start_count);
  out.put(message.tick_rate_hz);
  out.put(message.sensors);
  out.put_ticks(message.time_ticks);
  out.put(message.unique_id);
  write(message.board, out);
  write(message.target, out);
}

void read(ByteReader& in, Hello& message) {
  const auto role = in.get<std::uint8_t>();
  const auto cause = in.get<std::uint8_t>();
  in.refuse_if(role > static_cast<std::uint8_t>(Role::kSimulator) || cause >= kResetCauses);
  message.role = static_cast<Role>(role);
  message.reset_cause = static_cast<ResetCause>(cause);
  message.modes = in.get<std::uint8_t>();
  message.firmware_major = in.get<std::uint8_t>();
  message.firmware_minor = in.get<std::uint8_t>();
  message.firmware_patch = in.get<std::uint8_t>();
  message.start_count = in.get<std::uint16_t>();
  message.tick_rate_hz = in.get<std::uint32_t>();
  message.sensors = in.get<std::uint32_t>();
  message.time_ticks = in.get_ticks();
  message.unique_id = in.get<std::uint32_t>();
  read(in, message.board);
  read(in, message.target);
}

}  // namespace pharos::wire
