// SPDX-License-Identifier: Apache-2.0
#include "pharos/motion/mirrored_tilt.hpp"

#include <algorithm>
#include <utility>

#include "pharos/motion/mahalanobis.hpp"

namespace pharos::motion {
namespace {

// Sigmas between an attitude and the mirrored one up to which what is stated holds both.
constexpr double kApart = 4.0;
// Up to which the two are one.
constexpr double kMet = 1.0;
// Difference of chi-squared from which the side is told: e^9 to one.
constexpr double kTold = 18.0;

}  // namespace

void MirroredTilt::reset() {
  mirrored_.reset();
  delta_chi2_ = 0.0;
  open_ = false;
}

void MirroredTilt::begin(const Hypothesis& second) {
  mirrored_ = second;
  delta_chi2_ = 0.0;
  open_ = true;
}

bool MirroredTilt::push(Hypothesis& best, const lighthouse::SweepBearings& bearings, Axis axis, const StationView& view,
                        const AssumedNoise& noise, bool may_swap) {
  bool swapped = false;
  if (mirrored_) {
    mirrored_->push(bearings, axis, view, noise);
    delta_chi2_ = std::min(delta_chi2_ + mirrored_->side_cost(noise) - best.side_cost(noise), kTold);
    swapped = may_swap && delta_chi2_ <= -kTold;
    if (swapped) {
      std::swap(best, *mirrored_);
      delta_chi2_ = kTold;
    }
  }
  judge(best);
  return swapped;
}

void MirroredTilt::judge(const Hypothesis& best) {
  if (best.sees_relief()) {
    if (!mirrored_ || delta_chi2_ >= kTold || same_pose(best, *mirrored_)) reset();
    return;
  }
  if (!best.sees_tilt()) return;
  const double apart = best.mirrored_apart();
  if (!open_ && apart < kTiltMayBeZero) {
    open_ = true;
    delta_chi2_ = kTold;
  }
  if (!open_) return;
  // What is told is no more certain than that the tilt has not been zero since.
  delta_chi2_ = std::min(delta_chi2_, apart * apart);
  if (apart < kMet) {
    mirrored_.reset();
    delta_chi2_ = 0.0;
  } else if (delta_chi2_ >= kTold && apart > kTiltMayBeZero) {
    reset();
  } else if (!mirrored_ || (delta_chi2_ > 0.0 && best.is_nearer_than_mirrored(mirrored_->state_estimate().pose))) {
    mirrored_ = best.mirrored();
  }
}

bool MirroredTilt::apart(const Hypothesis& best) const {
  if (!mirrored_) return false;
  if (best.sees_tilt()) return best.mirrored_apart() > kApart;
  const StateEstimate& stated = best.state_estimate();
  return mahalanobis_squared(mirrored_->state_estimate().pose, stated.pose, stated.covariance) > kApart * kApart;
}

}  // namespace pharos::motion
