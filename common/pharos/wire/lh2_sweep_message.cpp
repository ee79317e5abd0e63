// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/lh2_sweep_message.hpp"

namespace pharos::wire {
namespace {

constexpr unsigned kPlaneBit = 4;
constexpr unsigned kSlowBit = 5;
constexpr unsigned kBitsInUse = 6;

bool is_possible(const Lh2SweepHit& hit) {
  return hit.sensor < kMaxSensors && hit.width_ticks >= 1 && hit.width_ticks <= kMaxLh2Width_ticks &&
         hit.centre_sixths >= 0 && hit.centre_sixths <= kMaxLh2Centre_sixths;
}

}  // namespace

void write(const Lh2Sweep& message, ByteWriter& out) {
  if (message.sync_sixths > 5 || message.channel > kMaxLh2Channel || message.plane > 1) out.fail();
  out.put_ticks(message.sync_ticks);
  out.put(message.sync_sixths);
  out.put(static_cast<std::uint8_t>(message.channel | message.plane << kPlaneBit | message.slow_bit << kSlowBit));
  out.put(static_cast<std::uint8_t>(message.hits.size()));
  for (const Lh2SweepHit& hit : message.hits) {
    if (!is_possible(hit)) out.fail();
    out.put(hit.sensor);
    out.put(hit.width_ticks);
    out.put(hit.centre_sixths);
  }
}

void read(ByteReader& in, Lh2Sweep& message) {
  message.sync_ticks = in.get_ticks();
  message.sync_sixths = in.get<std::uint8_t>();
  const auto bits = static_cast<unsigned>(in.get<std::uint8_t>());
  in.refuse_if(message.sync_sixths > 5 || bits >> kBitsInUse != 0);
  message.channel = static_cast<std::uint8_t>(bits & 0xFU);
  message.plane = static_cast<std::uint8_t>(bits >> kPlaneBit & 1U);
  message.slow_bit = (bits >> kSlowBit & 1U) != 0;
  const auto count = in.get<std::uint8_t>();
  in.refuse_if(count > kMaxHitsPerSweep);
  message.hits.clear();
  for (std::size_t i = 0; i < count && i < kMaxHitsPerSweep && !in.ran_short(); ++i) {
    Lh2SweepHit hit;
    hit.sensor = in.get<std::uint8_t>();
    hit.width_ticks = in.get<std::uint16_t>();
    hit.centre_sixths = in.get<std::int32_t>();
    in.refuse_if(!is_possible(hit));
    message.hits.push_back(hit);
  }
}

void write(const Lh2Ootx& message, ByteWriter& out) {
  if (message.channel > kMaxLh2Channel) out.fail();
  out.put_ticks(message.time_ticks);
  out.put(message.channel);
  out.put(static_cast<std::uint8_t>(message.data.size()));
  out.put_bytes({message.data.data(), message.data.size()});
}

void read(ByteReader& in, Lh2Ootx& message) {
  message.time_ticks = in.get_ticks();
  message.channel = in.get<std::uint8_t>();
  const auto count = in.get<std::uint8_t>();
  in.refuse_if(message.channel > kMaxLh2Channel || count > Lh2Ootx::kMaxData);
  if (count > Lh2Ootx::kMaxData) return;
  message.data.resize(count);
  in.get_bytes({message.data.data(), message.data.size()});
}

}  // namespace pharos::wire
