// SPDX-License-Identifier: Apache-2.0
#include "rtl/fifo_fill.hpp"

#include <algorithm>
#include <array>
#include <deque>

namespace pharos::rtl {
namespace {

constexpr std::size_t kSensors = 32;

}  // namespace

std::vector<std::int64_t> record_ticks(std::span<const lighthouse::RawPulse> pulses, std::uint32_t sensors) {
  std::vector<std::int64_t> ticks;
  for (const lighthouse::RawPulse& pulse : pulses) {
    if (pulse.sensor >= kSensors || (sensors >> pulse.sensor & 1) == 0) continue;
    ticks.push_back(pulse.rise_ticks);
    ticks.push_back(pulse.fall_ticks);
  }
  std::ranges::sort(ticks);
  ticks.erase(std::unique(ticks.begin(), ticks.end()), ticks.end());
  return ticks;
}

std::uint32_t busiest_sensors(std::span<const lighthouse::RawPulse> pulses, std::size_t count) {
  std::array<std::size_t, kSensors> seen{};
  for (const lighthouse::RawPulse& pulse : pulses) {
    if (pulse.sensor < kSensors) ++seen[pulse.sensor];
  }
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < std::min(count, kSensors); ++i) {
    const auto busiest = std::ranges::max_element(seen);
    mask |= std::uint32_t{1} << (busiest - seen.begin());
    *busiest = 0;
  }
  return mask;
}

std::size_t worst_fill(std::span<const std::int64_t> records, std::int64_t service_ticks) {
  std::deque<std::int64_t> leaves;  // time at which each waiting record is completely read
  std::size_t worst = 0;
  std::int64_t free_at = INT64_MIN;
  for (const std::int64_t tick : records) {
    while (!leaves.empty() && leaves.front() <= tick) leaves.pop_front();
    free_at = std::max(free_at, tick) + service_ticks;
    leaves.push_back(free_at);
    worst = std::max(worst, leaves.size());
  }
  return worst;
}

std::size_t max_in_window(std::span<const std::int64_t> records, std::int64_t absent_ticks) {
  std::size_t maximum = 0;
  std::size_t first = 0;
  for (std::size_t last = 0; last < records.size(); ++last) {
    while (records[last] - records[first] > absent_ticks) ++first;
    maximum = std::max(maximum, last - first + 1);
  }
  return maximum;
}

}  // namespace pharos::rtl
