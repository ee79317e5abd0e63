// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <utility>

#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/optimize/descent.hpp"
#include "pharos/pose/place_residuals.hpp"

namespace pharos::pose {

/// The two minima of one set of bearings.
template <class System>
struct Minima {
  optimize::Descent<System> best;
  optimize::Descent<System> second;
  bool has_second = false;
  bool undecided = false;  // some descent ended early: a second minimum can be neither confirmed nor excluded
  int iterations = 0;
};

// The mirror image of the best minimum as the second; the better of the two first.
template <class System>
void find_second_minimum(const System& system, int max_iterations, double variance, Minima<System>& m) {
  // Two fits nearer than this (squared, in sigmas, by the first one's information) are the same minimum.
  constexpr double kSameMinimum = 1.0;
  // Where cost has risen from the best minimum as its own parabola does, the descent leads back to it.
  constexpr double kParabola = 0.15;
  const auto in_first_basin = [&](const typename System::State& pose, double cost) {
    if constexpr (!System::kChecksBasin) return false;
    const double square = system.square_between(m.best.state, m.best.normal, pose);
    return std::fabs(cost - m.best.normal.cost - square) < kParabola * square;
  };
  const optimize::DescentSettings settings{max_iterations, System::kConverged * variance,
                                           m.best.normal.cost + kAmbiguousDeltaChi2 * variance};
  optimize::descend(system, system.mirrored(m.best.state), settings, in_first_basin, m.second);
  m.iterations += m.second.iterations;
  m.undecided = m.undecided || !m.second.decided();
  const bool usable = m.second.converged() && system.ahead(m.second.state);
  m.has_second =
      usable && !(system.square_between(m.best.state, m.best.normal, m.second.state) < kSameMinimum * variance);
  if (!m.has_second) return;
  // Where no redundancy contradicts a pose (three sensors), the one that the start led to comes first.
  const bool second_is_better = system.rows() > kPoseUnknowns && m.second.normal.cost < m.best.normal.cost;
  const bool first_is_usable = m.best.converged() && system.ahead(m.best.state);
  if (second_is_better || !first_is_usable) std::swap(m.best, m.second);
  m.has_second = first_is_usable;
}

/// Both minima of the rows that take part, from one start. The second converges fully only where it matters: within
/// kAmbiguousDeltaChi2 of the first. `variance`: of one bearing, rad^2.
template <class System>
void both_minima(const System& system, const typename System::State& start, int max_iterations, double variance,
                 Minima<System>& m) {
  constexpr int kRounds = 3;
  optimize::descend(system, start, {max_iterations, System::kConverged * variance, 1e300}, m.best);
  m.has_second = false;
  m.iterations = m.best.iterations;
  m.undecided = !m.best.decided();
  for (int round = 0; round < kRounds; ++round) {
    const double cost_before = m.best.normal.cost;
    find_second_minimum(system, max_iterations, variance, m);
    // Where the start converged to neither of the pair, the mirror image of the better one is still to be tried.
    if (!(m.best.normal.cost + kAmbiguousDeltaChi2 * variance < cost_before)) break;
  }
}

}  // namespace pharos::pose
