// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pharos/lighthouse/flash_smoother.hpp"
#include "pharos/motion/doubtful_sweep.hpp"
#include "pharos/motion/mirrored_tilt.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::motion {

/// Track of one station: the best hypothesis, and at times an alternative.
///
/// An alternative is the second minimum of the first solution, the solution of a cycle solved alone that contradicts
/// the best one, or the best one without a doubtful sweep. Both take every sweep; the likelihood decides.
class StationTrack {
 public:
  void push(const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view, const AssumedNoise& noise);
  /// A complete cycle whose sweeps were pushed: starts the track, or checks it now and then, by solving the cycle
  /// alone. last_refusal() is why that failed.
  void check(const track::Cycle& cycle, const StationView& view, const AssumedNoise& noise,
             const pose::SolveOptions& options);
  void lose();

  const Hypothesis* best() const { return best_ ? &*best_ : nullptr; }
  /// The alternative once it may be compared with the best, else null; its chi-squared minus the best one's.
  const Hypothesis* alternative() const {
    return settled_alternative()              ? &*alternative_
           : best_ && mirrored_.apart(*best_) ? &mirrored_.hypothesis()
                                              : nullptr;
  }
  double delta_chi2() const { return settled_alternative() ? alternative_chi2() : mirrored_.delta_chi2(); }
  bool has_alternative() const {
    return alternative_.has_value() || (alternative() != nullptr && delta_chi2() < kAmbiguousDeltaChi2);
  }
  pose::Refusal last_refusal() const { return refusal_; }

 private:
  bool settled_alternative() const { return alternative_ && alternative_settled_; }
  double alternative_chi2() const { return alternative_->cost() - best_->cost(); }
  bool due() const;
  bool agrees(const LighthouseFromBody& pose, const Matrix6& covariance) const;
  void decide();
  void drop_alternative();

  std::optional<Hypothesis> best_, alternative_;
  bool alternative_settled_ = false;
  MirroredTilt mirrored_;
  DoubtfulSweep doubt_;  // open: the alternative is the best one without that sweep
  int cycles_unchecked_ = 0;
  // The last cycle solved alone without an alternative.
  std::optional<LighthouseFromBody> solved_;
  std::int64_t solved_flash_ticks_ = 0;
  pose::Refusal refusal_ = pose::Refusal::kTooFewSensors;
};

}  // namespace pharos::motion
