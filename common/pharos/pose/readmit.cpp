// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/refine.hpp"
#include "pharos/pose/reject.hpp"

namespace pharos::pose {
namespace {

constexpr int kMaxRounds = 8;

// A hit is admitted below this many times the scale, by the degrees of freedom that the scale was estimated from: about
// Student's quantile, the first ones limited to what a reflection (2.5 mrad at 8.8 arcsec) must exceed, the last ones
// raised so that one good hit in two million is lost.
using Gates = std::array<double, 9>;
// 99.98 %: for noise of unknown size.
constexpr Gates kWideGates{60.0, 60.0, 45.0, 22.0, 12.9, 9.6, 8.0, 7.2, 6.6};
// 99.9 %: where reflections are certain.
constexpr Gates kNarrowGates{60.0, 60.0, 31.6, 12.9, 8.6, 6.9, 6.0, 5.4, 5.0};

// Scale that systematic errors may give a fit (an uncalibrated station: 1 mrad). Above it there are reflections among
// the admitted hits, and the gate was too wide.
constexpr double kLargestSystematic_rad = 1.5e-3;

double gate_for(const Gates& gates, int degrees_of_freedom) {
  const int last = static_cast<int>(gates.size()) - 1;
  return gates[static_cast<std::size_t>(std::clamp(degrees_of_freedom, 0, last))];
}

// Residual of a place that is not in the fit over the hit's sigma and the pose's own uncertainty.
double studentised(const HitCandidates& hits, const PlaceResidual& place, const LighthouseFromBody& pose,
                   const Factorisation<6>& factor) {
  const Vector6 j = jacobian_of(hits.table.body(place.sensor), place.axis, pose);
  const std::array<double, 6> x = factor.solve({j[0], j[1], j[2], j[3], j[4], j[5]});
  double leverage = 0.0;
  for (int i = 0; i < 6; ++i) leverage += j[i] * x[static_cast<std::size_t>(i)];
  return place.size / std::sqrt(1.0 + std::fmax(0.0, leverage));
}

double scale_of(const Fit& fit, int freedom, double sigma_rad) {
  return freedom > 0 ? std::fmax(sigma_rad, std::sqrt(fit.normal.cost / freedom)) : sigma_rad;
}

// Adds what passes the gate and removes what does not; returns how many are in, or -1 where nothing changed.
int regate(HitCandidates& hits, const Fit& fit, double gate) {
  PlaceResiduals residuals;
  sort_places(hits, fit.state, residuals);
  const Factorisation<6> factor(fit.normal.matrix);
  int in = 0;
  bool changed = false;
  for (const PlaceResidual& r : residuals) {
    const bool was_in = hits.at(r.sensor, r.axis).chosen == r.observation;
    const bool passes = (was_in ? r.size : studentised(hits, r, fit.state, factor)) <= gate;
    changed = changed || passes != was_in;
    in += passes ? 1 : 0;
    hits.choose(r.sensor, r.axis, passes ? r.observation : HitCandidates::kNone);
  }
  return changed ? in : -1;
}

// From the core of a pose to the hits that pass the gates; returns the scale of the fit to them.
double readmit_by(const Gates& gates, HitCandidates& hits, const SolveOptions& options, LighthouseFromBody& pose) {
  PlaceResiduals residuals;
  sort_places(hits, pose, residuals);
  int in = core_size(static_cast<int>(residuals.size()));
  choose_first(hits, residuals, in);
  const optimize::DescentSettings settings{options.max_iterations,
                                           kConvergedFraction * options.sigma_rad * options.sigma_rad, 1e300};
  double scale = options.sigma_rad;
  for (int round = 0; round < kMaxRounds && in > 0; ++round) {
    const Fit fit = refine(hits.table, pose, Residual::kAngle, settings);
    pose = fit.state;
    const int freedom = in - kPoseUnknowns;
    scale = scale_of(fit, freedom, options.sigma_rad);
    in = regate(hits, fit, gate_for(gates, freedom) * scale);
  }
  return scale;
}

}  // namespace

void readmit_inliers(HitCandidates& hits, const SolveOptions& options, LighthouseFromBody& pose) {
  const LighthouseFromBody core = pose;
  if (readmit_by(kWideGates, hits, options, pose) <= std::fmax(kLargestSystematic_rad, options.sigma_rad)) return;
  pose = core;
  readmit_by(kNarrowGates, hits, options, pose);
}

}  // namespace pharos::pose
