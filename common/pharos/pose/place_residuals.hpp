// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/static_vector.hpp"
#include "pharos/pose/hit_candidates.hpp"

namespace pharos::pose {

inline constexpr int kPoseUnknowns = 6;
/// Maximum places (sensor, axis) of one cycle.
inline constexpr std::size_t kMaxPlaces = kAxes * kMaxSensors;

/// The hit of one place that fits a pose best.
struct PlaceResidual {
  double size;  // tangent of |residual|: equivalent to the angle where it is small, and cheaper
  std::int16_t observation;
  std::uint8_t sensor;
  Axis axis;
};

using PlaceResiduals = StaticVector<PlaceResidual, kMaxPlaces>;

/// The best hit of every place that has one, best places first.
void sort_places(const HitCandidates& hits, const LighthouseFromBody& pose, PlaceResiduals& residuals);

/// Puts the first `count` places into the table and leaves the others out; returns the sum of squares of those put in.
double choose_first(HitCandidates& hits, const PlaceResiduals& residuals, int count);

/// Places in the core of a trimmed fit: two thirds, since up to a third may be reflections, but at least one more than
/// unknowns, the minimum with any redundancy.
int core_size(int places);

/// Maximum chi-squared that white noise of sigma gives a valid fit of so many degrees of freedom, exceeded once in ten
/// thousand: up to it no search for outliers is needed.
double chi2_threshold(int degrees_of_freedom);

}  // namespace pharos::pose
