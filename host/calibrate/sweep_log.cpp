// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/sweep_log.hpp"

#include "pharos/lighthouse/bearing.hpp"

namespace pharos::calibrate {

void RecordingLog::push(const lighthouse::Sweep& sweep) {
  constexpr unsigned kDoubtful = lighthouse::kSweepFlashWeak | lighthouse::kSweepPeriodNominal;
  if (sweep.flash.skip || sweep.flash.station >= kMaxStations || (sweep.flags & kDoubtful) != 0) return;
  LoggedSweep logged{sweep.flash.start_ticks, sweep.flash.station, sweep.flash.axis, {}};
  for (const lighthouse::Bearing& bearing : lighthouse::bearings_of(sweep)) {
    if (bearing.sensor < kMaxSensors) logged.hits.push_back({bearing.sensor, bearing.theta_rad});
  }
  if (!logged.hits.empty()) sweeps.push_back(std::move(logged));
}

}  // namespace pharos::calibrate
