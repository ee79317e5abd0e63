// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>

#include "pharos/optimize/damping.hpp"

namespace pharos::optimize {

/// Interface of a least-squares problem: its State, the sums of a linearisation there (Normal), and the step that
/// solves them (Step). LeastSquares provides all but `linearise` and `moved`; the integers of the pose room provide
/// their own.
template <class P>
concept Problem = requires(const P& problem, const typename P::State& state, const typename P::Normal& normal,
                           const typename P::Step& step) {
  /// Sums at a state. `cost` is not finite where the state is impossible.
  { problem.linearise(state) } -> std::same_as<typename P::Normal>;
  { normal.cost } -> std::convertible_to<double>;
  /// The Levenberg-Marquardt step, damped relative to the matrix' diagonal; 0: Gauss-Newton.
  { problem.step(normal, 0.0) } -> std::same_as<typename P::Step>;
  /// False where the matrix is too near to singular.
  { step.solved } -> std::convertible_to<bool>;
  /// Decrease of the cost predicted by the linear model for the step: -gradient . delta.
  { step.decrease } -> std::convertible_to<double>;
  /// Smallest pivot of the matrix that was solved over its diagonal element, at most 1.
  { step.smallest_pivot_ratio } -> std::convertible_to<double>;
  /// The retraction: the state moved by a step.
  { problem.moved(state, step.delta) } -> std::same_as<typename P::State>;
  /// Damping of the first step.
  { P::kFirstDamping } -> std::convertible_to<double>;
  /// Whether an undamped step that cannot be solved ends the descent (kSingular); else it is damped.
  { P::kEndsWhereSingular } -> std::convertible_to<bool>;
  /// Whether the sums are computed again at the end; else they are those one step before, which is less than the
  /// tolerance away, and the cost is the linear model's prediction.
  { P::kSumsAtEnd } -> std::convertible_to<bool>;
};

/// Why a descent ended.
enum class Ending : std::uint8_t {
  kConverged,      // an undamped step gains less than the tolerance
  kHopeless,       // the cost would stay above DescentSettings::hopeless_cost
  kStopped,        // the caller asked for it
  kStalled,        // damped steps gain less than the tolerance, and the undamped one does not lower the cost
  kSingular,       // the undamped step cannot be solved
  kMaxIterations,  // steps ran out
  kMaxDamping,     // no step lowers the cost, however short
  kBadStart,       // the cost at the start is not finite
};

/// A cost from here on, or NaN, is invalid.
inline constexpr double kUnusableCost = 1e300;

struct DescentSettings {
  int max_iterations = 50;
  /// Converged when an undamped step's predicted decrease is no more than this (in the cost's unit): with residuals in
  /// standard deviations, the squared distance to the minimum, in standard deviations.
  double tolerance = 0.0;
  /// Stop when a step shows that the cost will stay above this.
  double hopeless_cost = 1e300;
};

/// State of a descent.
template <class P>
struct Descent {
  typename P::State state{};
  typename P::Normal normal{};        // sums at the state, see kSumsAtEnd; its matrix is the information
  double smallest_pivot_ratio = 1.0;  // of the last step's matrix
  int iterations = 0;                 // steps that were solved for, taken or not
  Ending ending = Ending::kBadStart;

  bool converged() const { return ending == Ending::kConverged; }
  /// The outcome is decided: a minimum, or a cost above the limit.
  bool decided() const { return ending <= Ending::kStopped; }
};

/// The step below the tolerance: worth taking, its linearisation mostly not worth repeating.
template <Problem P>
void take_last(const P& problem, const typename P::Step& step, Descent<P>& d) {
  d.ending = Ending::kConverged;
  if constexpr (P::kSumsAtEnd) {
    // So near the minimum rounding decides whether the cost falls.
    const typename P::State last = problem.moved(d.state, step.delta);
    const typename P::Normal at_last = problem.linearise(last);
    if (!(at_last.cost < kUnusableCost)) return;
    d.state = last;
    d.normal = at_last;
  } else {
    d.state = problem.moved(d.state, step.delta);
    d.normal.cost = std::fmax(0.0, d.normal.cost - step.decrease);
  }
}

/// Levenberg-Marquardt from a start. A step is taken only where it lowers the cost (or is the last one, below the
/// tolerance); what is not finite is never taken. With kFirstDamping = 0 damping enters only where a step fails, so
/// that a good start costs about three linearisations.
///
/// `stop(state, cost)`: called after every step that lowered the cost; true ends the descent. `d`: state of the
/// descent, overwritten. No heap; inlines into the caller.
template <Problem P, class Stop>
void descend(const P& problem, const typename P::State& start, const DescentSettings& settings, Stop stop,
             Descent<P>& d) {
  // Stopped only when even thrice the decrease that the linear model predicts would leave the cost above the limit, and
  // only after this many steps: far from a minimum the model's prediction is inaccurate.
  constexpr double kOptimism = 3.0;
  constexpr int kStepsBeforeGivingUp = 1;
  d.state = start;
  d.normal = problem.linearise(start);
  d.smallest_pivot_ratio = 1.0;
  d.iterations = 0;
  d.ending = Ending::kBadStart;
  if (!(d.normal.cost < kUnusableCost)) return;
  Damping damping(P::kFirstDamping);
  bool undamped_failed = false;  // from this state
  d.ending = Ending::kMaxIterations;
  while (d.iterations < settings.max_iterations) {
    ++d.iterations;
    const typename P::Step step = problem.step(d.normal, damping.value());
    if (step.solved) {
      d.smallest_pivot_ratio = step.smallest_pivot_ratio;
      if (step.decrease <= settings.tolerance) {
        if (damping.none()) {
          take_last(problem, step, d);
          return;
        }
        if (undamped_failed) {
          d.ending = Ending::kStalled;
          return;
        }
        damping = {};  // only an undamped step shows whether this is the minimum
        continue;
      }
      if (d.iterations > kStepsBeforeGivingUp && d.normal.cost - kOptimism * step.decrease > settings.hopeless_cost) {
        d.ending = Ending::kHopeless;
        return;
      }
      const typename P::State trial = problem.moved(d.state, step.delta);
      const typename P::Normal at_trial = problem.linearise(trial);
      if (at_trial.cost <= d.normal.cost) {
        damping.succeeded((d.normal.cost - at_trial.cost) / step.decrease);
        undamped_failed = false;
        d.state = trial;
        d.normal = at_trial;
        if (stop(d.state, d.normal.cost)) {
          d.ending = Ending::kStopped;
          return;
        }
        continue;
      }
    } else if constexpr (P::kEndsWhereSingular) {
      d.ending = Ending::kSingular;
      return;
    }
    undamped_failed = undamped_failed || damping.none();
    if (!damping.failed()) {
      d.ending = Ending::kMaxDamping;
      return;
    }
  }
}

template <Problem P>
void descend(const P& problem, const typename P::State& start, const DescentSettings& settings, Descent<P>& d) {
  descend(
      problem, start, settings, [](const typename P::State&, double) { return false; }, d);
}

}  // namespace pharos::optimize
