// SPDX-License-Identifier: Apache-2.0
#include "pharos/wire/sweep_message.hpp"

#include <algorithm>

namespace pharos::wire {
namespace {

constexpr unsigned kStationBit = 0;
constexpr unsigned kAxisBit = 1;
constexpr unsigned kDataBit = 2;
constexpr unsigned kSkipBit = 3;
constexpr unsigned kBitsUsed = 4;

constexpr bool bit(std::uint8_t bits, unsigned number) { return ((static_cast<unsigned>(bits) >> number) & 1u) != 0; }

template <class T>
constexpr bool within(T value, T least, T most) {
  return value >= least && value <= most;
}

bool is_possible(const SweepHit& hit) {
  return hit.sensor < kMaxSensors && within<std::int32_t>(hit.width_ticks, kMinPulseTicks, kMaxPulseTicks) &&
         within<std::int32_t>(hit.centre_half_ticks, 0, kMaxCentreHalfTicks);
}

bool is_possible(const Sweep& message) {
  return message.station < kMaxStations && message.flash_sensors <= kMaxSensors &&
         within(message.flash_length_ticks, kMinFlashTicks, kMaxPulseTicks) &&
         within(message.period_sixteenth_ticks, kMinPeriodSixteenthTicks, kMaxPeriodSixteenthTicks) &&
         std::all_of(message.hits.begin(), message.hits.end(), [](const SweepHit& hit) { return is_possible(hit); });
}

}  // namespace

void write(const Sweep& message, ByteWriter& out) {
  if (!is_possible(message)) out.fail();
  out.put_ticks(message.flash_start_ticks);
  out.put(message.flash_length_ticks);
  out.put(message.period_sixteenth_ticks);
  out.put(message.flash_sensors);
  out.put(message.flags);
  out.put(static_cast<std::uint8_t>(message.station << kStationBit | index_of(message.axis) << kAxisBit |
                                    message.data << kDataBit | message.skip << kSkipBit));
  out.put(static_cast<std::uint8_t>(message.hits.size()));
  for (const SweepHit& hit : message.hits) {
    out.put(hit.sensor);
    out.put(hit.width_ticks);
    out.put(hit.centre_half_ticks);
  }
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
    message.hits.push_back(hit);
  }
  in.refuse_if(!is_possible(message));
}

}  // namespace pharos::wire
