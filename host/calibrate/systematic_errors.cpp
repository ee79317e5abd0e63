// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "host/calibrate/calibration_file.hpp"
#include "host/calibrate/unknowns.hpp"
#include "pharos/lighthouse/station_model.hpp"

namespace pharos::calibrate {
namespace {

constexpr double kStep_rad = 1e-6;
// Directions in which a rotor's error is evaluated: tangents of the angle from straight ahead, to either side.
constexpr std::array<double, 5> kTangents = {-0.6, -0.3, 0.0, 0.3, 0.6};

double sensor_sigma(const CalibrationFile& file) {
  const auto count = static_cast<double>(file.sensors.size());
  Vector3 middle = Vector3::Zero();
  for (const SensorPlacement& sensor : file.sensors) middle += sensor.position_m / count;
  double square = 0.0;
  for (std::size_t i = 0; i < file.sensors.size(); ++i) {
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) square += file.covariance[k][k];
    const double by_size_m = file.scale_sigma * (file.sensors[i].position_m - middle).norm();
    square -= by_size_m * by_size_m;
  }
  return std::sqrt(std::max(square, 0.0) / (3.0 * count));
}

// In the order of kRotorParameterNames. (parameters_of() belongs to the adjustment, which readers of a file do not
// link.)
using Rotor = lighthouse::RotorCalibration;
constexpr std::array<double Rotor::*, kRotorParameters> kParameters = {
    &Rotor::phase_rad, &Rotor::tilt_rad, &Rotor::curve_rad, &Rotor::gibbous_phase_rad, &Rotor::gibbous_magnitude_rad};

// Derivative of a rotor's raw angle by its five parameters. Form 2 differs in a sign, which does not change the
// variance.
RotorParameters by_parameters(const lighthouse::StationCalibration& station, Axis axis, const Vector3& direction) {
  const auto rotor = static_cast<std::size_t>(index_of(axis));
  RotorParameters derivative{};
  for (std::size_t k = 0; k < kRotorParameters; ++k) {
    const auto shifted = [&](double by) {
      lighthouse::StationCalibration other = station;
      other.rotor[rotor].*kParameters[k] += by;
      return raw_theta(other, lighthouse::ModelForm::kForm1, axis, direction);
    };
    derivative[k] = (shifted(kStep_rad) - shifted(-kStep_rad)) / (2.0 * kStep_rad);
  }
  return derivative;
}

// Mean square error of a rotor's angle; `first`: where its five parameters begin in the covariance.
double rotor_square(const CalibrationFile& file, const lighthouse::StationCalibration& station, Axis axis,
                    std::size_t first) {
  double square = 0.0;
  for (const double x : kTangents) {
    for (const double y : kTangents) {
      const RotorParameters d = by_parameters(station, axis, Vector3(x, y, 1.0));
      for (std::size_t i = 0; i < kRotorParameters; ++i) {
        for (std::size_t j = 0; j < kRotorParameters; ++j) {
          square += d[i] * file.covariance[first + i][first + j] * d[j];
        }
      }
    }
  }
  return std::max(square, 0.0) / static_cast<double>(kTangents.size() * kTangents.size());
}

}  // namespace

motion::SystematicErrors systematic_errors(const CalibrationFile& file) {
  if (!file.has_target()) return motion::kUncalibratedErrors;
  // The parameters' order: sensors, then the rotors of each station (calibration_text).
  std::size_t at = 3 * file.sensors.size();
  const std::size_t rotors = kAxes * file.stations.size();
  if (rotors == 0 || file.covariance.size() < at + kRotorParameters * rotors) return motion::kCalibratedErrors;
  double square = 0.0;
  for (const host::StationEntry& station : file.stations) {
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      square += rotor_square(file, station.calibration, axis, at);
      at += kRotorParameters;
    }
  }
  return {sensor_sigma(file), std::sqrt(square / static_cast<double>(rotors))};
}

}  // namespace pharos::calibrate
