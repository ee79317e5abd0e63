// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "firmware/bench/report.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::bench {

/// A target of so many rows.
inline Target target_of(Input& input, std::uint32_t sensors) {
  Target target;
  for (std::uint32_t k = 0; k < sensors; ++k) {
    const auto& row = input.next<SensorRow>();
    target.push_back(
        {static_cast<std::uint8_t>(row.sensor), {row.position_m[0], row.position_m[1], row.position_m[2]}, {}});
  }
  return target;
}

inline lighthouse::StationCalibration calibration_of(const StationRow& row) {
  lighthouse::StationCalibration calibration;
  for (std::size_t r = 0; r < 2; ++r) {
    const auto& v = row.rotor[r];
    calibration.rotor[r] = {v[0], v[1], v[2], v[3], v[4]};
  }
  return calibration;
}

inline lighthouse::Edge edge_of(const EdgeRow& row) { return {row.stamp_ticks(), row.sensor(), row.rising()}; }

}  // namespace pharos::bench
