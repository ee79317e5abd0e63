// SPDX-License-Identifier: Apache-2.0
// What two stations tell NetworkTracker at once, beside its filter.
#include <algorithm>

#include "pharos/network/network_tracker.hpp"

namespace pharos::network {
namespace {

// Chi-squared of what lies between the filter's position or velocity and what two stations tell at once.
constexpr double kStrayedChi2 = 14.0;
// So many times the variance of what two stations tell at once: the filter goes on from there.
constexpr double kVague = 9.0;
constexpr double kBetterFix = 4.0;  // times the filter's variance: it is the position's while its sweeps all agree
// A target that tells its range is asked so often while its light fits: the position's fix is a third of the cost.
constexpr double kAsk_s = 0.03;
constexpr double kConfirming_m = 0.06;  // a position that is known less well confirms nothing
// About any axis, 1 sigma: an attitude that may be the mirrored one, as far as some of the sensors' middle is
// concerned.
constexpr double kMirrored_rad = 1.0;
// Hits that do not fit the others of their sweep: an attitude that leaves out so many is wrong.
constexpr double kAttitudeSuspect = 0.125, kAttitudeDoubted = 0.25;

}  // namespace

// Of what lies between the filter and the position that two stations tell at once; `but_one`: where one sweep that may
// be a reflection explains it, it is none.
double NetworkTracker::apart_chi2(const PositionFix& fix, bool but_one) const {
  const NetworkState& state = filter_.mean();
  const StateMatrix& P = state.covariance;
  const Vector3 p = fix.position_m - state.pose.t, v = fix.velocity_m_s - state.rate.tail<3>();
  const Vector3 p1 = fix.by_one.head<3>(), v1 = fix.by_one.segment<3>(3);
  const double part = but_one ? 1.0 : 0.0;
  const Matrix3 Sp = P.block<3, 3>(kPoseAt + 3, kPoseAt + 3) + fix.position_covariance() + part * p1 * p1.transpose();
  const Matrix3 Sv =
      P.block<3, 3>(kRateAt + 3, kRateAt + 3) + fix.covariance.block<3, 3>(3, 3) + part * v1 * v1.transpose();
  return std::max(p.dot(Sp.inverse() * p), v.dot(Sv.inverse() * v));
}

// Where two stations see the body they tell at once where it is: a state that is elsewhere, as after a time with one
// station alone, whose range of a small target drifts, goes on from there.
bool NetworkTracker::strayed(bool taken) {
  fix_.reset();
  const bool sure = taken && confirmed(time_s_) && tells_range(target_, options_.noise);
  if (sure && asked_.within(kAsk_s, time_s_)) return false;
  asked_.set(time_s_);
  fix_ = fix_of(used_recent(), stations_, target_, filter_.mean(), time_s_, options_.noise, attitude_doubt_rad());
  if (!fix_) return false;
  const double fix_m2 = fix_->position_covariance().trace();
  const bool confirming = fix_m2 < kConfirming_m * kConfirming_m;
  if (confirming) fixed_.set(time_s_);
  // A filter whose attitude is wrong refuses the light that would tell it the position, and all fits it that it does
  // not know.
  const bool vague = confirming && position_variance() > kVague * fix_->doubted_covariance().trace();
  if (confirming) saw(*fix_);
  if (!vague && apart_chi2(*fix_, true) < kStrayedChi2) return false;
  // A state that did not know its position has an attitude of one station alone, that may be the mirror of the true
  // one.
  if (vague && check_attitude()) return true;
  filter_.place(*fix_, vague);
  ++counters_.strays;
  // What did not fit the filter fits the position.
  if (vague || fix_->sound) planes_.forget_contradictions(*fix_);
  return true;
}

// A filter takes what stations are wrong by for noise of each sweep, so that planes which contradict each other move it
// in turn: in motion it knows no more than all sweeps together, each at its own instant. At rest it does.
bool NetworkTracker::fix_is_better() const {
  if (!fix_ || tells_range(target_, options_.noise)) return false;
  return fix_->doubted_covariance().trace() < (fix_->sound ? kBetterFix : 1.0) * position_variance();
}

bool NetworkTracker::attitude_suspect() const {
  return left_out_ > kAttitudeSuspect && !tells_range(target_, options_.noise);
}

// True where other poses explain the recent sweeps better, and one of them is followed from now on.
bool NetworkTracker::check_attitude() {
  if (!confirmed(time_s_) || time_s_ - checked_s_ < kCheckAmbiguous_s) return false;
  const std::uint64_t starts = counters_.starts;
  check_alternatives(time_s_, true);
  return counters_.starts > starts;
}

// Then the light that a wrong attitude takes draws the position of a small target away.
bool NetworkTracker::attitude_doubted() const {
  return left_out_ > kAttitudeDoubted && !tells_range(target_, options_.noise);
}

// Of a flat target it may be the mirrored one while it is new, or leaves out hits. The sensors of a sweep that lacks
// some are then elsewhere: 12 mm off at a stated 4.
double NetworkTracker::attitude_doubt_rad() const {
  const bool open = attitude_suspect() || (!confirmed(time_s_) && !tells_range(target_, options_.noise));
  return open ? kMirrored_rad : 0.0;
}

double NetworkTracker::position_variance() const { return filter_.mean().position_variance(); }

}  // namespace pharos::network
