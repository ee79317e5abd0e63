// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/unknowns.hpp"

namespace pharos::calibrate {

RotorParameters parameters_of(const lighthouse::RotorCalibration& rotor) {
  return {rotor.phase_rad, rotor.tilt_rad, rotor.curve_rad, rotor.gibbous_phase_rad, rotor.gibbous_magnitude_rad};
}

lighthouse::RotorCalibration rotor_of(const RotorParameters& parameters) {
  return {parameters[0], parameters[1], parameters[2], parameters[3], parameters[4]};
}

}  // namespace pharos::calibrate
