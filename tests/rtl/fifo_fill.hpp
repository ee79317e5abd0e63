// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pharos/lighthouse/pulse.hpp"

namespace pharos::rtl {

/// Ticks at which the capture block would store a record, in order: those in which at least one of the sensors in
/// `sensors` (a bit each) has an edge.
std::vector<std::int64_t> record_ticks(std::span<const lighthouse::RawPulse> pulses, std::uint32_t sensors);

/// Mask of the `count` sensors with the most pulses.
std::uint32_t busiest_sensors(std::span<const lighthouse::RawPulse> pulses, std::size_t count);

/// Largest number of waiting records for a reader that needs `service_ticks` for each, including the one being read.
std::size_t worst_fill(std::span<const std::int64_t> records, std::int64_t service_ticks);

/// Largest number of records stored during `absent_ticks` without reading.
std::size_t max_in_window(std::span<const std::int64_t> records, std::int64_t absent_ticks);

}  // namespace pharos::rtl
