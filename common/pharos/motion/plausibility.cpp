// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/plausibility.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/ticks.hpp"

namespace pharos::motion {
namespace {

// Jerk of a hand that shakes a target, 1 sigma: at 33 ms a turn the shifts of controller_quick depart from the
// prediction by 25 mm so, 4 sigma twice in 50 s; at 17 ms it is 3 mm.
constexpr double kHandJerk_m_s3 = 4000.0;
constexpr double kLeapSigmas = 4.0;
// Shifts from which on a pose waits for the next sweeps: 2.4 sigma, and 8 mm, two fifths of what makes a pose wrong.
constexpr double kImprobableChi2 = 6.0, kLargeShift_m = 8e-3;
// A shift this much larger than the one before may be the same motion.
constexpr double kGoesOnMin = 0.5, kGoesOnMax = 5.0;
// NIS from which on a withheld sweep speaks against the target at all, and fully (decades on).
constexpr double kDisputeNis = 40.0, kFullDisputeDecades = 1.5;
// Time since a sweep that was taken where there was none.
constexpr double kNever_s = 1.0;

// Of what the prediction and the noise leave open.
double shift_variance(const SweepFit& fit, const StateEstimate& prediction, const SweepNoise& noise) {
  return fit.shift_jacobian.dot(prediction.covariance.lazyProduct(fit.shift_jacobian)) + noise.own_rad * noise.own_rad +
         noise.common_rad * noise.common_rad;
}

}  // namespace

bool leaps(const SweepFit& fit, const StateEstimate& prediction, const SweepNoise& noise, double since_s) {
  if (fit.sensors < kMinSensorsToJudge) return false;
  const double moved_m = kHandJerk_m_s3 / 6.0 * since_s * since_s * since_s;
  const double variance =
      shift_variance(fit, prediction, noise) + moved_m * moved_m * fit.shift_jacobian.tail<3>().squaredNorm();
  return fit.shift_rad * fit.shift_rad > kLeapSigmas * kLeapSigmas * variance;
}

bool shift_is_improbable(const SweepFit& fit, const StateEstimate& prediction, const SweepNoise& noise) {
  return fit.sensors >= kMinSensorsToJudge &&
         fit.shift_rad * fit.shift_rad > kImprobableChi2 * shift_variance(fit, prediction, noise);
}

bool shifts_far(const SweepFit& fit) { return std::abs(fit.shift_rad) * fit.pose.t.norm() > kLargeShift_m; }

bool hits_disagree(const SweepFit& fit) {
  return fit.sensors >= kMinSensorsToJudge && fit.foreign >= 2 && 3 * fit.foreign >= fit.sensors;
}

double dispute_of(const SweepFit& fit, bool withheld, double nis) {
  if (hits_disagree(fit) || (withheld && fit.used.empty())) return 1.0;
  if (withheld) return std::clamp(std::log10(nis / kDisputeNis) / kFullDisputeDecades, 0.0, 1.0);
  return fit.foreign >= 2 && 5 * fit.foreign >= fit.sensors ? kSomeDispute : 0.0;
}

bool Leaps::go_on(const SweepFit& fit, bool contradicted) const {
  if (shift_rad_ == 0.0) return contradicted;
  const double ratio = fit.shift_rad / shift_rad_;
  return ratio > kGoesOnMin && ratio < kGoesOnMax;
}

double Leaps::since_taken_s(std::int64_t time_ticks) const {
  return taken_ticks_ == INT64_MIN ? kNever_s : ticks_to_seconds(time_ticks - taken_ticks_);
}

}  // namespace pharos::motion
