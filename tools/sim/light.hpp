// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "tools/sim/scenario.hpp"

namespace pharos::sim {

/// A station's light at one sensor.
struct Illumination {
  bool lit = false;
  double range_m = 0.0;
  double cosine = 1.0;  // of the incidence; 1 for sensors without a normal
};

/// Light of one station on one sensor of the target in the pose T_L_B: within the station's field of view and range,
/// incidence below the limit, and not occluded by the body (if any).
Illumination illuminate(const LighthouseFromBody& T_L_B, const SensorPlacement& sensor, const LightScenario& light,
                        const std::vector<BodyFace>& body);

/// Difference of a flash's length on a sensor to the nominal one, ticks: +78 at 1 m and normal incidence, -47 at 5 m
/// (3075 and 2955 of 3000 ticks at 48 MHz were measured), much shorter within 10 deg of the incidence limit.
double flash_excess_ticks(const Illumination& seen, const LightScenario& light);

/// Width of a laser hit, ticks: 208 at 2.9 m and normal incidence, inversely proportional to range, down to 15 % at the
/// incidence limit; 28 to 1381 (27 to 1326 at 48 MHz were measured).
double hit_width_ticks(const Illumination& seen, const LightScenario& light);

/// Nominal length of a flash, ticks: (3000 + 500 axis + 1000 data + 2000 skip) 50/48.
double nominal_flash_ticks(Rotor rotor, bool data, bool skip);

}  // namespace pharos::sim
