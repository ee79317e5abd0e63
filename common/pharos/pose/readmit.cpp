// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/refine.hpp"
#include "pharos/pose/reject.hpp"

namespace pharos::pose {
namespace {

constexpr int kMaxRounds = 8;

// A hit is let in below this many times the scale, by the degrees of freedom that the scale was estimated from:
// Student's 99.9 % quantile, the first one cut from 637 to what a reflection (2.5 mrad at 8.8 arcsec) must stand out
// by, the last ones raised to 5 so that one good hit in two million is lost.
double gate_for(int degrees_of_freedom) {
  constexpr std::array<double, 7> kGates{60.0, 60.0, 31.6, 12.9, 8.6, 6.9, 6.0};
  const int last = static_cast<int>(kGates.size()) - 1;
  return degrees_of_freedom > last ? 5.0 : kGates[static_cast<std::size_t>(std::max(0, degrees_of_freedom))];
}

// Residual of a place that is not in the fit over what the pose's own uncertainty adds to the hit's.
double studentised(const Hits& hits, const PlaceResidual& place, const LighthouseFromBody& pose,
                   const Factorisation<6>& factor) {
  const Vector6 j = jacobian_of(hits.sightings.body(place.sensor), place.axis, pose);
  const std::array<double, 6> x = factor.solve({j[0], j[1], j[2], j[3], j[4], j[5]});
  double leverage = 0.0;
  for (int i = 0; i < 6; ++i) leverage += j[i] * x[static_cast<std::size_t>(i)];
  return place.size / std::sqrt(1.0 + std::fmax(0.0, leverage));
}

double scale_of(const Fit& fit, int freedom, double sigma_rad) {
  return freedom > 0 ? std::fmax(sigma_rad, std::sqrt(fit.normal.cost / freedom)) : sigma_rad;
}

// Puts in what passes the gate and takes out what does not; how many are in, or -1 where nothing changed.
int regate(Hits& hits, const Fit& fit, double gate) {
  PlaceResiduals residuals;
  sort_places(hits, fit.pose, residuals);
  const Factorisation<6> factor(fit.normal.matrix);
  int in = 0;
  bool changed = false;
  for (const PlaceResidual& r : residuals) {
    const bool was_in = hits.at(r.sensor, r.axis).chosen == r.observation;
    const bool passes = (was_in ? r.size : studentised(hits, r, fit.pose, factor)) <= gate;
    changed = changed || passes != was_in;
    in += passes ? 1 : 0;
    hits.choose(r.sensor, r.axis, passes ? r.observation : Hits::kNone);
  }
  return changed ? in : -1;
}

}  // namespace

void readmit(Hits& hits, const SolveOptions& options, LighthouseFromBody& pose) {
  PlaceResiduals residuals;
  sort_places(hits, pose, residuals);
  int in = core_size(static_cast<int>(residuals.size()));
  choose_first(hits, residuals, in);
  const RefineLimits limits{options.max_iterations, kConvergedShare * options.sigma_rad * options.sigma_rad, 1e300};
  for (int round = 0; round < kMaxRounds && in > 0; ++round) {
    const Fit fit = refine(hits.sightings, pose, Residual::kAngle, limits);
    pose = fit.pose;
    const int freedom = in - kPoseUnknowns;
    in = regate(hits, fit, gate_for(freedom) * scale_of(fit, freedom, options.sigma_rad));
  }
}

}  // namespace pharos::pose
