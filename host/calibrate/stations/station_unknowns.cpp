// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/station_unknowns.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

using network::Generation;

// What a station's own calibration leaves: the `workshop` errors of DESIGN, rad. The gibbous phase: 0.3 mrad across a
// magnitude of 6 mrad. Curve and ogee of LH2 are factors of a polynomial that is 0.0076 s^2 at its angle s: 0.3 mrad at
// 45 deg.
constexpr PlaneFields kSentLh1 = {0.5e-3, 0.3e-3, 0.3e-3, 0.05, 0.3e-3, 1.0, 1.0};
constexpr PlaneFields kSentLh2 = {0.5e-3, 0.3e-3, 0.06, 0.05, 0.3e-3, 0.1, 0.06};
// The spread of the fields that real stations send: LH1 of 10, LH2 of 6 stations.
constexpr PlaneFields kAnyLh1 = {0.03, 0.005, 0.005, 1.5, 0.008, 1.0, 1.0};
constexpr PlaneFields kAnyLh2 = {0.005, 0.05, 0.3, 1.5, 0.003, 1.5, 0.4};

}  // namespace

PlaneFields fields_of(const lighthouse::PlaneCalibration& p) {
  return {p.phase_rad,      p.tilt_rad,      p.curve, p.gibbous_phase_rad, p.gibbous_magnitude_rad,
          p.ogee_phase_rad, p.ogee_magnitude};
}

lighthouse::PlaneCalibration plane_of(const PlaneFields& f) { return {f[0], f[1], f[2], f[3], f[4], f[5], f[6]}; }

PlaneFields with_phases_in_a_turn(PlaneFields fields) {
  for (const std::size_t k : {3U, 5U}) fields[k] = std::remainder(fields[k], 2.0 * kPi);
  return fields;
}

PlaneFields prior_sigmas(Generation generation, const PlaneFields& at) {
  const bool sent = std::any_of(at.begin(), at.end(), [](double value) { return value != 0.0; });
  if (generation == Generation::kLighthouse1) return sent ? kSentLh1 : kAnyLh1;
  return sent ? kSentLh2 : kAnyLh2;
}

}  // namespace pharos::calibrate
