// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/cycle_bearings.hpp"

#include <algorithm>

#include "pharos/base/ticks.hpp"

namespace pharos::host {
namespace {

// The solver's word on the n-th hit of this sensor and axis.
const track::BearingResidual* find_residual(const track::BearingResiduals& residuals, const pose::Observation& wanted,
                                            int occurrence) {
  for (const track::BearingResidual& residual : residuals) {
    if (residual.sensor == wanted.sensor && residual.axis == wanted.axis && occurrence-- == 0) return &residual;
  }
  return nullptr;
}

int occurrence_of(const pose::Observations& observations, std::size_t index) {
  const auto same = [&](const pose::Observation& other) {
    return other.sensor == observations[index].sensor && other.axis == observations[index].axis;
  };
  return static_cast<int>(std::count_if(observations.begin(), observations.begin() + index, same));
}

ReportedBearing raw_bearing(const lighthouse::Bearing& bearing, Axis axis, std::int64_t reference_ticks) {
  ReportedBearing reported;
  reported.sensor = bearing.sensor;
  reported.axis = axis;
  reported.width_ticks = bearing.width_ticks;
  reported.offset_ns = ticks_to_nanoseconds(bearing.time_ticks - reference_ticks);
  reported.raw_theta_rad = bearing.theta_rad;
  reported.ideal_theta_rad = bearing.theta_rad;
  return reported;
}

}  // namespace

std::optional<track::Cycle> CycleBearings::push(const lighthouse::Sweep& sweep) {
  if (sweep.flash.station >= kMaxStations) return std::nullopt;
  Station& station = stations_[sweep.flash.station];
  const auto axis = static_cast<std::size_t>(index_of(sweep.flash.axis));
  const lighthouse::SmoothedFlash smoothed = station.smoother[axis].push(sweep);
  if (sweep.flash.skip) return std::nullopt;
  const lighthouse::SweepBearings bearings =
      options_.smooth_flashes ? lighthouse::bearings_of(sweep, smoothed) : lighthouse::bearings_of(sweep);
  return station.assembler.push(sweep.flash.station, sweep.flash.axis, sweep.flash.start_ticks, sweep.flags, bearings);
}

std::vector<ReportedBearing> CycleBearings::report(const track::Cycle& cycle,
                                                   const lighthouse::StationCalibration* calibration,
                                                   const track::EpochResult& result,
                                                   const track::BearingResiduals& residuals) const {
  const LighthouseFromBody* pose = result.pose ? &result.pose->pose : nullptr;
  const track::IdealObservations ideal = track::ideal_observations(cycle, target_, calibration, options_.form, pose);
  std::vector<ReportedBearing> reported;
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    for (const lighthouse::Bearing& bearing : cycle[axis]) {
      reported.push_back(raw_bearing(bearing, axis, result.time_ticks));
      for (std::size_t i = 0; i < ideal.observations.size(); ++i) {
        const pose::Observation& observation = ideal.observations[i];
        if (observation.sensor != bearing.sensor || observation.axis != axis ||
            ideal.centre_ticks[i] != bearing.time_ticks) {
          continue;
        }
        reported.back().ideal_theta_rad = observation.theta_rad;
        const auto* residual = find_residual(residuals, observation, occurrence_of(ideal.observations, i));
        if (residual == nullptr) continue;
        reported.back().used = residual->used;
        reported.back().residual_rad = residual->used ? residual->residual_rad : 0.0;
      }
    }
  }
  return reported;
}

}  // namespace pharos::host
