// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "pharos/geometry/types.hpp"

namespace pharos::sim {

/// How a laser plane of Lighthouse 2.0 departs from the ideal one; fields and signs as a station announces them.
struct PlaneErrors {
  double phase_rad = 0.0;
  double tilt_rad = 0.0;
  double curve = 0.0;
  double gibbous_phase_rad = 0.0;
  double gibbous_magnitude_rad = 0.0;
  double ogee_phase_rad = 0.0;
  double ogee_magnitude = 0.0;
};

/// How far the rotor has turned since its sync, rad, when `plane` (0 = a, 1 = b) meets a point of the station's frame L
/// (x right, y down, z ahead; z > 0).
///
/// The rotor turns to the left about the upward axis. At 2/3 pi the ideal plane a holds the line of sight and leans by
/// 30 deg, its upper part to the right; at 4/3 pi plane b, leaning to the left. Tilt adds to the lean; curve and ogee
/// bend the plane along its length by a published series; gibbous is the unevenness of the rotor's speed.
double turned_angle(std::size_t plane, const PlaneErrors& errors, const Vector3& point_L);

}  // namespace pharos::sim
