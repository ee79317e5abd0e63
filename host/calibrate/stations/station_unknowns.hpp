// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "host/calibrate/stations/body_spline.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/network/sweep.hpp"

namespace pharos::calibrate {

/// A plane's calibration as an optimiser's block, in the order of PlaneCalibration. The ogee is of LH2 alone.
inline constexpr std::size_t kPlaneFields = 7;
using PlaneFields = std::array<double, kPlaneFields>;
inline constexpr std::array<const char*, kPlaneFields> kPlaneFieldNames = {
    "phase", "tilt", "curve", "gibbous_phase", "gibbous_magnitude", "ogee_phase", "ogee_magnitude"};

PlaneFields fields_of(const lighthouse::PlaneCalibration& plane);
lighthouse::PlaneCalibration plane_of(const PlaneFields& fields);

/// The same plane, its phases of gibbous and ogee within half a turn of zero.
PlaneFields with_phases_in_a_turn(PlaneFields fields);

/// 1 sigma of what is known of a plane's fields before, around `at`: of a plane that sent its calibration, what such a
/// calibration leaves; of one without (all zero), the spread of real stations' fields.
PlaneFields prior_sigmas(network::Generation generation, const PlaneFields& at);

/// Noise of one plane's hits, 1 sigma.
struct PlaneNoise {
  double own_rad = 40e-6;     // of each hit alone
  double common_rad = 60e-6;  // the same for all hits of a sweep
  double apart_rad = 0.0;     // of each hit against the sweep's mean, beside its own
};

/// The unknowns of an adjustment of stations.
struct StationUnknowns {
  network::Stations stations;  // poses and calibration; all have a pose
  Target target;
  std::vector<BodySpline> motion;
};

}  // namespace pharos::calibrate
