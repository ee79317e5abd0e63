// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/sweep_message.hpp"

namespace pharos::wire {
namespace {

constexpr unsigned kStationBit = 0;
constexpr unsigned kAxisBit = 1;
constexpr unsigned kDataBit = 2;
constexpr unsigned kSkipBit = 3;
constexpr unsigned kBitsUsed = 4;

constexpr bool bit(std::uint8_t bits, unsigned number) { return ((static_cast<unsigned>(bits) >> number) & 1u) != 0; }

template <class T>
constexpr bool within(T value, T minimum, T maximum) {
  return value >= minimum && value <= maximum;
}

bool is_possible(const SweepHit& hit) {
  return hit.sensor < kMaxSensors && within<std::int32_t>(hit.width_ticks, kMinPulse_ticks, kMaxPulse_ticks) &&
         within<std::int32_t>(hit.centre_half_ticks, 0, kMaxCentre_half_ticks);
}

bool is_possible(const SweepHead& head) {
  return head.station < kMaxStations && head.flash_sensors <= kMaxSensors &&
         within(head.flash_length_ticks, kMinFlash_ticks, kMaxPulse_ticks) &&
         within(head.period_sixteenth_ticks, kMinPeriod_sixteenth_ticks, kMaxPeriod_sixteenth_ticks);
}

}  // namespace

void write(const SweepHead& head, std::size_t hits, ByteWriter& out) {
  if (!is_possible(head)) out.fail();
  out.put_ticks(head.flash_start_ticks);
  out.put(head.flash_length_ticks);
  out.put(head.period_sixteenth_ticks);
  out.put(head.flash_sensors);
  out.put(head.flags);
  out.put(static_cast<std::uint8_t>(head.station << kStationBit | index_of(head.axis) << kAxisBit |
                                    head.data << kDataBit | head.skip << kSkipBit));
  out.put(static_cast<std::uint8_t>(hits));
}

void write(const SweepHit& hit, ByteWriter& out) {
  if (!is_possible(hit)) out.fail();
  out.put(hit.sensor);
  out.put(hit.width_ticks);
  out.put(hit.centre_half_ticks);
}

void write(const Sweep& message, ByteWriter& out) {
  write(message, message.hits.size(), out);
  for (const SweepHit& hit : message.hits) write(hit, out);
}

void read(ByteReader& in, Sweep& message) {
  message.flash_start_ticks = in.get_ticks();
  message.flash_length_ticks = in.get<std::int32_t>();
  message.period_sixteenth_ticks = in.get<std::uint32_t>();
  message.flash_sensors = in.get<std::uint8_t>();
  message.flags = in.get<std::uint8_t>();
  const auto bits = in.get<std::uint8_t>();
  in.refuse_if(bits >> kBitsUsed != 0);
  message.station = bit(bits, kStationBit) ? 1 : 0;
  message.axis = bit(bits, kAxisBit) ? Axis::kY : Axis::kX;
  message.data = bit(bits, kDataBit);
  message.skip = bit(bits, kSkipBit);
  const auto count = in.get<std::uint8_t>();
  in.refuse_if(count > kMaxHitsPerSweep);
  message.hits.clear();
  for (std::size_t i = 0; i < count && i < kMaxHitsPerSweep && !in.ran_short(); ++i) {
    SweepHit hit;
    hit.sensor = in.get<std::uint8_t>();
    hit.width_ticks = in.get<std::uint16_t>();
    hit.centre_half_ticks = in.get<std::int32_t>();
    in.refuse_if(!is_possible(hit));
    message.hits.push_back(hit);
  }
  in.refuse_if(!is_possible(message));
}

}  // namespace pharos::wire
