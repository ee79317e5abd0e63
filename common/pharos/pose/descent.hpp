// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace pharos::pose {

/// Where a descent stands. System: what is summed and solved, and in which numbers (DoubleSystem, FixedSystem).
template <class System>
struct Descent {
  typename System::Pose pose{};
  typename System::Normal normal{};   // at the pose, or at one that differs by less than the tolerance
  double smallest_pivot_ratio = 1.0;  // of the last step's normal matrix
  int iterations = 0;
  bool converged = false;
  bool abandoned = false;  // given up: see RefineLimits, or `in_known_basin` said so
  /// Where it ends is not known: steps ran out, or the system's numbers could not follow.
  bool undecided() const { return !converged && !abandoned; }
};

struct RefineLimits {
  int max_iterations = 50;
  /// Stop when a step's predicted decrease of r^T r falls below this (rad^2).
  double tolerance = 0.0;
  /// Give up (not converged) when a step shows that r^T r will stay above this.
  double abandon_cost = 1e300;
};

/// Nielsen's rule (IMM-REP-1999-05) for the damping, and where it starts and ends.
class Damping {
 public:
  double value() const { return value_; }
  bool none() const { return value_ == 0.0; }
  /// After a step that lowered the cost by `gain` times what the linear model predicted.
  void succeeded(double gain) {
    constexpr double kNoDamping = 1e-5;
    const double excess = 2.0 * gain - 1.0;
    value_ *= std::fmax(1.0 / 3.0, 1.0 - excess * excess * excess);
    if (value_ < kNoDamping) value_ = 0.0;
    growth_ = 2.0;
  }
  /// After one that did not; false where there is no more damping to try.
  bool failed() {
    constexpr double kFirstDamping = 1e-3, kLargestDamping = 1e8;
    value_ = value_ > 0.0 ? value_ * growth_ : kFirstDamping;
    growth_ *= 2.0;
    return value_ < kLargestDamping;
  }

 private:
  double value_ = 0.0;
  double growth_ = 2.0;
};

/// Levenberg-Marquardt on the left error of the pose. The first step is undamped (Gauss-Newton); damping enters only
/// where a step fails to lower the cost, so a good start costs about three linearisations.
///
/// `in_known_basin(pose, cost)`: asked after every step that lowered the cost; true ends the descent. `fit`: where the
/// descent is followed, whatever it holds.
template <class System, class InKnownBasin>
void descend(const System& system, const typename System::Pose& start, const RefineLimits& limits,
             InKnownBasin in_known_basin, Descent<System>& fit) {
  // A fit is given up only when even thrice the decrease that the linear model predicts would leave it hopeless, and
  // only after this many steps: far from a minimum the model's prediction is worth little.
  constexpr double kOptimism = 3.0;
  constexpr int kStepsBeforeGivingUp = 1;
  fit.pose = start;
  fit.normal = system.linearise(start);
  fit.smallest_pivot_ratio = 1.0;
  fit.iterations = 0;
  fit.converged = fit.abandoned = false;
  if (!(fit.normal.cost < 1e300)) return;
  Damping damping;
  while (fit.iterations < limits.max_iterations) {
    ++fit.iterations;
    const typename System::Step step = system.step(fit.normal, damping.value());
    if (!step.solved) return;
    fit.smallest_pivot_ratio = step.smallest_pivot_ratio;
    if (damping.none() && step.decrease < limits.tolerance) {
      // The step is worth taking, its linearisation is not worth repeating.
      fit.pose = system.stepped(fit.pose, step);
      fit.normal.cost = std::fmax(0.0, fit.normal.cost - step.decrease);
      fit.converged = true;
      return;
    }
    if (!damping.none() && step.decrease < limits.tolerance) {
      damping = {};  // whether this is the minimum, only an undamped step can tell
      continue;
    }
    if (fit.iterations > kStepsBeforeGivingUp && fit.normal.cost - kOptimism * step.decrease > limits.abandon_cost) {
      fit.abandoned = true;
      return;
    }
    const typename System::Pose trial = system.stepped(fit.pose, step);
    const typename System::Normal at_trial = system.linearise(trial);
    if (at_trial.cost <= fit.normal.cost) {
      damping.succeeded((fit.normal.cost - at_trial.cost) / step.decrease);
      fit.pose = trial;
      fit.normal = at_trial;
      if (in_known_basin(fit.pose, fit.normal.cost)) {
        fit.abandoned = true;
        return;
      }
    } else if (!damping.failed()) {
      fit.converged = step.decrease < limits.tolerance;
      return;
    }
  }
  return;
}

template <class System>
void descend(const System& system, const typename System::Pose& start, const RefineLimits& limits,
             Descent<System>& fit) {
  descend(
      system, start, limits, [](const typename System::Pose&, double) { return false; }, fit);
}

}  // namespace pharos::pose
