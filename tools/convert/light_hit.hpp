// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pharos/geometry/types.hpp"

namespace pharos::convert {

/// One hit of a sensor by a station's laser plane, as a row of sweeps.csv.
struct LightHit {
  double time_s = 0.0;       // of the hit, on the log's own clock
  std::uint8_t station = 0;  // the station's number
  std::uint8_t plane = 0;    // LH1: 0 = x, 1 = y; LH2: 0 = a, 1 = b
  std::uint8_t sensor = 0;
  double theta_rad = 0.0;  // LH1: DESIGN's raw theta; LH2: 0 straight ahead, growing to the station's left
};

/// One sample of an inertial unit in its own axes.
struct ImuSample {
  double time_s = 0.0;
  Vector3 gyro_rad_s = Vector3::Zero();
  Vector3 acceleration_m_s2 = Vector3::Zero();  // specific force: +g upwards at rest
};

/// A position that the log's maker computed by crossing the beams of two stations, world frame.
struct CrossingBeam {
  double time_s = 0.0;
  Vector3 position_m = Vector3::Zero();
  double delta_m = 0.0;  // by how much the beams miss each other
};

/// What a log says happened at a time.
struct LogEvent {
  double time_s = 0.0;
  const char* what = "";
};

}  // namespace pharos::convert
