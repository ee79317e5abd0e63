// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/ootx_message.hpp"

#include "pharos/base/capacity.hpp"

namespace pharos::wire {

void write(const Ootx& message, ByteWriter& out) {
  if (message.station >= kMaxStations) out.fail();
  out.put_ticks(message.time_ticks);
  out.put(message.station);
  out.put(static_cast<std::uint8_t>(message.data.size()));
  out.put_bytes({message.data.data(), message.data.size()});
}

void read(ByteReader& in, Ootx& message) {
  message.time_ticks = in.get_ticks();
  message.station = in.get<std::uint8_t>();
  const auto count = in.get<std::uint8_t>();
  in.refuse_if(message.station >= kMaxStations || count > Ootx::kMaxData);
  if (count > Ootx::kMaxData) return;
  message.data.resize(count);
  in.get_bytes({message.data.data(), message.data.size()});
}

}  // namespace pharos::wire
