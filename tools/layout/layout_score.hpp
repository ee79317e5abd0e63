// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"

namespace pharos::layout {

/// Statistic over the poses' precision: mean, maximum, or a percentile.
struct Objective {
  enum class Kind { kMean, kWorst, kPercentile };
  Kind kind = Kind::kMean;
  double percentile = 95.0;
};
double statistic(std::vector<double> values, const Objective& objective);

/// Precision factors (22) of paper 002 at each pose; none where the target cannot be measured.
struct Dop {
  double adop_deg_per_rad = 0.0;
  double pdop_m_per_rad = 0.0;
};
using Dops = std::vector<std::optional<Dop>>;

/// Properties of light and sensors.
struct Sight {
  double incidence_rad = 0.0;  // largest angle from a sensor's normal at which it sees the station
  double rho = 0.0;            // correlation of bearings within a rotor, (19)
};

/// Visibility follows from the sensors' normals: the body is convex and does not occlude a sensor that faces the
/// station.
Dops dops_of(const Target& target, const std::vector<LighthouseFromBody>& poses, const Sight& sight);

/// Statistics of the factors over poses.
struct Score {
  double adop_deg_per_rad = 0.0;
  double pdop_m_per_rad = 0.0;
  std::size_t measured = 0;
};

/// Over the poses that can be measured; zeros where there is none.
Score score_of(const Dops& dops, const Objective& objective);

/// Cost of a layout: weight * ADOP / reference + (1 - weight) * PDOP / reference, 1 for the reference
/// itself. A pose that cannot be measured counts as a hundred times the reference, worse than any other.
class LayoutEvaluator {
 public:
  /// Precondition: `reference` measures at least one pose.
  LayoutEvaluator(std::vector<LighthouseFromBody> poses, Sight sight, Objective objective, double attitude_weight,
                  const Score& reference);
  double operator()(const Target& target) const;

 private:
  std::vector<LighthouseFromBody> poses_;
  Sight sight_;
  Objective objective_;
  double attitude_weight_;
  Score reference_;
};

}  // namespace pharos::layout
