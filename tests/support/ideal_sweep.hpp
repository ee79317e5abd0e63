// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "pharos/base/units.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/station_model.hpp"
#include "pharos/lighthouse/sweep.hpp"

namespace pharos::test {

inline constexpr std::int64_t kHalfTurn = 416'667;
inline constexpr double kTurn = 833'334.0;

/// Eight sensors, numbers from 3.
inline Target cube_target() {
  Target target;
  const double h = 0.06;
  std::uint8_t number = 3;  // numbers need not start at 0
  for (const double x : {-h, h}) {
    for (const double y : {-h, h}) {
      for (const double z : {-h, 0.7 * h}) target.push_back({number++, {x, y, z}, Vector3::Zero()});
    }
  }
  return target;
}

inline LighthouseFromBody some_pose() { return {rotation_exp({0.4, -0.8, 0.3}), {0.3, -0.2, 2.0}}; }

inline lighthouse::StationCalibration some_calibration() {
  lighthouse::StationCalibration c;
  c.id = 0xBEC08E38;
  c.rotor[0] = {0.0156, 0.0003, -0.0018, -0.327, 0.00425};
  c.rotor[1] = {0.0382, 0.0022, -0.0017, -1.508, -0.00576};
  return c;
}

/// The sweep of an ideal receiver: no noise except quantisation to half a tick.
inline lighthouse::Sweep make_sweep(const Target& target, const LighthouseFromBody& pose,
                                    const lighthouse::StationCalibration& c, Axis axis, std::int64_t flash_ticks,
                                    std::uint8_t station = 0) {
  lighthouse::Sweep sweep;
  sweep.flash.start_ticks = flash_ticks;
  sweep.flash.length_ticks = 3125;
  sweep.flash.station = station;
  sweep.flash.axis = axis;
  sweep.flash.sensors = 8;
  sweep.period_sixteenth_ticks = static_cast<std::uint32_t>(kTurn * 16);
  for (const SensorPlacement& s : target) {
    const double theta = raw_theta(c, lighthouse::ModelForm::kForm1, axis, pose * s.position_m);
    sweep.hits.push_back({s.sensor, 200, static_cast<std::int32_t>(std::lround(2.0 * theta / kTwoPi * kTurn))});
  }
  return sweep;
}

}  // namespace pharos::test
