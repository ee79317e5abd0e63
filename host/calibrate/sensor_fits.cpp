// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/sensor_fits.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/lighthouse/station_model.hpp"

namespace pharos::calibrate {

void SensorFits::Sum::add(double residual_rad) {
  square += residual_rad * residual_rad;
  ++count;
}

double SensorFits::Sum::rms() const { return std::sqrt(square / std::max(count, 1)); }

void SensorFits::add_before(const BundleProblem& problem, const std::vector<StationPoses>& poses) {
  const Unknowns& nominal = problem.nominal;
  for (std::size_t i = 0; i < problem.intervals->size(); ++i) {
    for (const RotorView& view : (*problem.intervals)[i].rotors) {
      const std::optional<LighthouseFromBody>& T_station_body = poses[i][view.station];
      if (!T_station_body) continue;
      for (const MeanBearing& bearing : view.bearings) {
        const Vector3 p = *T_station_body * find_sensor(nominal.target, bearing.sensor)->position_m;
        const double expected = lighthouse::raw_theta(nominal.station[view.station], problem.form, view.axis, p);
        cells_[{view.station, view.axis, bearing.sensor}].before.add(bearing.raw_rad - expected);
      }
    }
  }
}

void SensorFits::add_after(const std::vector<StationaryAverage>& intervals,
                           const std::vector<BearingResidual>& residuals) {
  for (const BearingResidual& residual : residuals) {
    const RotorView& view = intervals[residual.interval].rotors[residual.view];
    const std::uint8_t sensor = view.bearings[residual.bearing].sensor;
    cells_[{view.station, view.axis, sensor}].after.add(residual.residual_rad);
  }
}

std::vector<SensorFit> SensorFits::table() const {
  std::vector<SensorFit> fits;
  for (const auto& [key, cell] : cells_) {
    const auto& [station, axis, sensor] = key;
    fits.push_back({station, axis, sensor, cell.after.count, cell.before.rms(), cell.after.rms()});
  }
  return fits;
}

}  // namespace pharos::calibrate
