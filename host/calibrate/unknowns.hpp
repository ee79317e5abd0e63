// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pharos/base/capacity.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "pharos/lighthouse/station_calibration.hpp"

namespace pharos::calibrate {

/// T_reference_station: pose of a station in the reference station's frame.
using ReferenceFromStation = Pose<frame::Lighthouse, frame::Lighthouse>;

inline constexpr std::size_t kRotorParameters = 5;
inline constexpr std::array<const char*, kRotorParameters> kRotorParameterNames = {
    "phase_rad", "tilt_rad", "curve_rad", "gibbous_phase_rad", "gibbous_magnitude_rad"};
using RotorParameters = std::array<double, kRotorParameters>;

RotorParameters parameters_of(const lighthouse::RotorCalibration& rotor);
lighthouse::RotorCalibration rotor_of(const RotorParameters& parameters);

/// Prior 1 sigma errors of the nominal values: the *workshop* errors.
struct PriorSigmas {
  double sensor_position_m = 0.4e-3;  // per axis
  /// In the order of kRotorParameterNames: errors of phase, tilt, curve and gibbous magnitude after OOTX. Gibbous
  /// phase: 0.3 mrad across a magnitude of 6 mrad, the typical one.
  RotorParameters rotor = {0.5e-3, 0.3e-3, 0.3e-3, 0.05, 0.3e-3};
};

/// A measured distance between two sensors.
struct MeasuredLength {
  std::uint8_t a = 0;
  std::uint8_t b = 0;
  double length_m = 0.0;
  double sigma_m = 0.0;
};

/// The unknowns of a calibration.
struct Unknowns {
  Target target;                                        // sensor positions; numbers and normals do not change
  std::vector<lighthouse::StationCalibration> station;  // by index; the first is the reference
  std::vector<std::optional<ReferenceFromStation>>
      T_reference_station;                      // empty: never seen together with the reference
  std::vector<LighthouseFromBody> T_home_body;  // of each interval, in the frame of its home station
};

/// Poses of one interval from each station, solved alone; empty where that gave none.
using StationPoses = std::array<std::optional<LighthouseFromBody>, kMaxStations>;

/// The station in whose frame an interval's pose is expressed: the reference where it sees the target or its relative
/// pose to a station that does is known.
using Homes = std::vector<std::size_t>;

}  // namespace pharos::calibrate
