// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pharos::tools {

/// One quantity of an answer against its truth: the length of its error and the square root of its covariance's trace,
/// in one unit.
struct Deviation {
  std::string quantity;  ///< "attitude", "position", "axis", with the unit: "attitude, deg"
  double error = 0.0;
  double sigma = 0.0;
  double tolerance = 0.0;  ///< an error below it is no integrity failure, whatever its sigma: 1 deg, 10 mm
};

/// A result with the status `ok` is an integrity failure beyond this number of its own sigmas and beyond its tolerance.
inline constexpr double kIntegritySigmas = 5.0;

/// Result of one seed.
struct IntegrityTrial {
  bool answerable = true;             ///< by the kind's rule, from the geometry alone
  std::string status;                 ///< `ok`, `ambiguous` or `refused_<reason>`
  std::vector<Deviation> deviations;  ///< of answers with the status `ok`

  bool ok() const { return status == "ok"; }
  bool ambiguous() const { return status == "ambiguous"; }
  bool failed() const;
};

/// One estimator under test. A seed is a body, its light, its cameras and their noise.
struct IntegrityKind {
  std::string name;
  std::string rule;  ///< the rule of availability, as text
  std::function<IntegrityTrial(std::uint64_t seed)> trial;
  /// Writes the images of that seed's trial, for inspection; grey ones by a tone curve of that power (1: linear).
  std::function<void(std::uint64_t seed, const std::filesystem::path& folder, double tone_power)> write;
  /// The same trial by cameras whose grey values are a power of the light (sim::tone_power); empty: no grey pictures.
  std::function<IntegrityTrial(std::uint64_t seed)> toned = {};
};

/// All kinds, by the names that --kind takes.
const std::vector<IntegrityKind>& integrity_kinds();

}  // namespace pharos::tools
