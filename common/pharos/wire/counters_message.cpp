// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/counters_message.hpp"

namespace pharos::wire {

void write(const Counters& message, ByteWriter& out) {
  out.put_ticks(message.time_ticks);
  out.put(static_cast<std::uint8_t>(message.group));
  out.put(static_cast<std::uint8_t>(message.values.size()));
  for (const std::uint32_t value : message.values) out.put(value);
}

void read(ByteReader& in, Counters& message) {
  message.time_ticks = in.get_ticks();
  message.group = static_cast<CounterGroup>(in.get<std::uint8_t>());
  const auto count = in.get<std::uint8_t>();
  in.refuse_if(count > Counters::kMaxValues);
  message.values.clear();
  for (std::size_t i = 0; i < count && i < Counters::kMaxValues; ++i) message.values.push_back(in.get<std::uint32_t>());
}

}  // namespace pharos::wire
