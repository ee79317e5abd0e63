// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/axis.hpp"

namespace pharos::lighthouse {

/// Departure of one rotor's laser plane from the ideal one, as a station sends it over OOTX.
struct RotorCalibration {
  double phase_rad = 0.0;
  double tilt_rad = 0.0;
  double curve_rad = 0.0;
  double gibbous_phase_rad = 0.0;
  double gibbous_magnitude_rad = 0.0;

  bool operator==(const RotorCalibration&) const = default;
};

/// The two signs of the curve term in published models; form 1 leaves the smaller residual on 8 of 8 real station and
/// recording sets.
enum class ModelForm : std::uint8_t { kForm1 = 1, kForm2 = 2 };

/// A station's identity and calibration. Equal id and equal rotors mean the same calibration.
struct StationCalibration {
  std::uint32_t id = 0;
  std::array<RotorCalibration, kAxes> rotor;

  const RotorCalibration& operator[](Axis axis) const { return rotor[static_cast<std::size_t>(index_of(axis))]; }
  bool operator==(const StationCalibration&) const = default;
};

/// Where a calibration comes from, which says what it leaves of the station's errors.
enum class CalibrationSource : std::uint8_t {
  kSurvey,  // measured here: its file says what it leaves
  kSent,    // by the station itself, as its factory measured it
};

}  // namespace pharos::lighthouse
