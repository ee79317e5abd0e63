// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/command_message.hpp"

namespace pharos::wire {

void write(const Command& message, ByteWriter& out) {
  out.put(static_cast<std::uint8_t>(message.code));
  out.put(message.value);
}

void read(ByteReader& in, Command& message) {
  message.code = static_cast<CommandCode>(in.get<std::uint8_t>());
  message.value = in.get<std::uint32_t>();
}

void write(const Ack& message, ByteWriter& out) {
  out.put(message.for_type);
  out.put(message.for_sequence);
  out.put(message.value);
}

void read(ByteReader& in, Ack& message) {
  message.for_type = in.get<std::uint8_t>();
  message.for_sequence = in.get<std::uint16_t>();
  message.value = in.get<std::uint32_t>();
}

void write(const Nak& message, ByteWriter& out) {
  out.put(message.for_type);
  out.put(message.for_sequence);
  out.put(static_cast<std::uint8_t>(message.reason));
  out.put(message.value);
}

void read(ByteReader& in, Nak& message) {
  message.for_type = in.get<std::uint8_t>();
  message.for_sequence = in.get<std::uint16_t>();
  message.reason = static_cast<NakReason>(in.get<std::uint8_t>());
  message.value = in.get<std::uint32_t>();
}

}  // namespace pharos::wire
