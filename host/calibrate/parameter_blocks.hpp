// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "host/calibrate/bundle.hpp"

namespace pharos::calibrate {

/// The unknowns as Ceres parameter blocks. Ceres keeps their addresses: a ParameterBlocks must not be moved.
struct ParameterBlocks {
  explicit ParameterBlocks(const BundleProblem& problem);
  /// The unknowns with the blocks' values.
  Unknowns unknowns(const BundleProblem& problem) const;

  std::vector<std::array<double, 3>> sensor;              // m
  std::vector<std::array<RotorParameters, kAxes>> rotor;  // by station
  std::array<double, 6> station_delta{};                  // of the second station, relative to its starting pose
  std::vector<std::array<double, 6>> pose_delta;          // by interval, relative to its starting pose
  std::vector<std::vector<double>> common;                // by interval and view, rad
  bool pair = false;                                      // the second station's pose is an unknown
  std::vector<bool> hit;                                  // by sensor: it has at least one bearing
};

/// Index of a sensor number in the target; its size where there is none.
std::size_t index_in(const Target& target, std::uint8_t sensor);

/// Names and prior of the calibration's parameters, in the order of ParameterBlocks: sensors, rotors, second station.
std::vector<Parameter> parameters_of(const BundleProblem& problem, const ParameterBlocks& blocks);

}  // namespace pharos::calibrate
