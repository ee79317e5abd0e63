// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "pharos/lighthouse/sweep.hpp"

namespace pharos::tools {

/// What a rotor's figures are good for.
enum class NoiseVerdict : std::uint8_t {
  kOk,
  kMoving,    ///< the angles wander: the target or the station moves
  kDisagree,  ///< as many sensors are left out as agree, or but one agrees: which are right is not known
};

/// Noise of one rotor's angles at rest, as paper 002 models it: (18), (19).
struct RotorNoise {
  std::uint8_t station = 0;
  Axis axis = Axis::kX;
  int sensors = 0;         ///< hit often enough, with a sigma within a factor of two of the median sensor's
  int left_out = 0;        ///< hit often enough, but noisier or quieter than that: a reflection, a partly hidden sensor
  int turns = 0;           ///< of the sensor that was hit most often
  double sigma_rad = 0.0;  ///< of one angle: root mean square over sensors
  /// Mean correlation between two sensors of the rotor, over the turns that hit both; nothing for a single sensor.
  std::optional<double> rho;
  /// Variance of the blocks' means over that of means of independent angles, of the sensor with most: about 1 at rest.
  double drift = 0.0;
  NoiseVerdict verdict() const;
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
