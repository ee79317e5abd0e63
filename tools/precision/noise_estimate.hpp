// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "pharos/lighthouse/sweep.hpp"

namespace pharos::tools {

/// Noise of one rotor's angles at rest, as paper 002 models it: (18), (19).
struct RotorNoise {
  std::uint8_t station = 0;
  Axis axis = Axis::kX;
  int sensors = 0;         ///< hit often enough
  int turns = 0;           ///< of the sensor that was hit most often
  double sigma_rad = 0.0;  ///< of one angle: root mean square over sensors
  /// Mean correlation between two sensors of the rotor, over the turns that hit both; nothing for a single sensor.
  std::optional<double> rho;
  /// How much the angles of a block scatter about their mean over how much the blocks' means do: 1 at rest.
  double drift = 0.0;
  bool moving() const;
};

/// Collects raw angles (no smoothing, no station model) of a recording and estimates their noise. Angles are taken
/// about their mean over blocks of a second, so that slow drifts do not count as noise.
class NoiseEstimator {
 public:
  void push(const lighthouse::Sweep& sweep);
  /// One entry a rotor that hit any sensor often enough (six blocks), in the order of stations and axes.
  std::vector<RotorNoise> estimate() const;

 private:
  struct Turn {
    std::int64_t number = 0;
    double theta_rad = 0.0;
  };
  using Series = std::vector<Turn>;
  struct Rotor {
    std::int64_t turns = 0;
    std::map<std::uint8_t, Series> sensors;
  };
  static std::optional<RotorNoise> noise_of(const Rotor& rotor);

  std::map<std::pair<std::uint8_t, Axis>, Rotor> rotors_;
};

}  // namespace pharos::tools
