// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "pharos/base/result.hpp"
#include "pharos/pointing/station.hpp"

namespace pharos::pointing {

/// One line of sight of a pass as measured by the station: time, direction, and range where it was measured.
struct Observation {
  double time_s = 0.0;
  LineOfSight sight;
  double range_m = 0.0;  ///< 0: not measured, as for most optical stations
};

/// The part of the orbit that determines the directions of nadir and flight.
struct Orbit {
  Vector3 normal_inertial = Vector3::UnitZ();  ///< along r x v
  double radius_m = 0.0;                       ///< mean distance from the Earth's centre
  bool from_ranges = false;
};

enum class OrbitFailure : std::uint8_t {
  kTooShort,    // fewer than three sightings, or the target moves by less than kMinArc_rad around the Earth
  kNotAnOrbit,  // no circular orbit has the angular rate of these lines of sight
};

/// Below this arc around the Earth's centre the flight direction is noise.
inline constexpr double kMinArc_rad = 1e-3;

/// The orbit's plane and radius. Where every sighting has a range, from the positions; else the circular orbit whose
/// speed, sqrt(mu / r^3), is that of the lines of sight intersected with the sphere of radius r. Inertial frame I is E
/// at `epoch_s`. An orbit of eccentricity e is off by about e r: 7 km at 500 km for 0.001, 0.1 deg of nadir.
Result<Orbit, OrbitFailure> find_orbit(std::span<const Observation> observations, const Geodetic& station,
                                       double epoch_s);

/// R_O_I at a sighting: O is the orbital frame, x along flight, y against the orbit's normal, z to nadir.
Matrix3 inertial_to_orbital(const Orbit& orbit, const Observation& observation, const Geodetic& station,
                            double epoch_s);

}  // namespace pharos::pointing
