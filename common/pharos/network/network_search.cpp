// SPDX-License-Identifier: Apache-2.0
// Where NetworkTracker starts, and which other poses explain the recent sweeps too.
#include <algorithm>
#include <cmath>

#include "pharos/network/network_tracker.hpp"

namespace pharos::network {
namespace {

constexpr double kSwitchCost = 18.0;
// Poses that turn less from each other are one.
constexpr double kSameRotation_rad = 0.2, kSamePosition_m = 0.05;
// A hit left out costs as much as an outlier anywhere within 20 mrad.
constexpr double kOutlierCost = 16.0;

bool same_pose(const WorldFromBody& a, const WorldFromBody& b) {
  return rotation_angle_between(a.R, b.R) < kSameRotation_rad && (a.t - b.t).norm() < kSamePosition_m;
}

}  // namespace

// The sweeps that led to a start are added again, each at its own instant.
void NetworkTracker::start_at(const WorldFromBody& pose, double time_s) {
  filter_.start(pose);
  running_ = true;
  ++counters_.starts;
  // What did not fit the state before says nothing of this one.
  planes_.forget_contradictions();
  time_s_ = recent_[0].time_s();
  accepted_s_ = checked_s_ = started_s_ = time_s;
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    const PlaneSweep& sweep = recent_[i];
    const double now_s = std::max(time_s_, sweep.time_s());
    filter_.predict(now_s - time_s_);
    time_s_ = now_s;
    if (watch_.excluded(sweep.station)) continue;
    const LinearisedSweep linearised = linearise(sweep, stations_, target_, filter_.mean(), now_s, options_.noise);
    if (!fits(linearised)) {
      planes_.refuse(linearised);
      continue;
    }
    filter_.correct(linearised);
    saw(linearised);
  }
  fix_ = fix_of(used_recent(), stations_, target_, filter_.mean(), time_s_, options_.noise, attitude_doubt_rad());
  if (fix_) filter_.place(*fix_, false);
  refused_in_row_ = 0;
  left_out_ = 0.0;
}

// Sweeps of several stations overlap: the last that was closed need not be the latest.
double NetworkTracker::latest_s() const {
  double latest_s = recent_[0].time_s();
  for (std::size_t i = 1; i < recent_.size(); ++i) latest_s = std::max(latest_s, recent_[i].time_s());
  return latest_s;
}

bool NetworkTracker::try_start(double time_s) {
  const Starts starts = starts_of(all_recent(), stations_, target_);
  if (starts.empty()) return false;
  const Choice choice = best_start(starts);
  if (!(choice.cost < 1e299)) return false;
  WorldFromBody pose = choice.pose;
  NetworkState near;
  near.pose = pose;
  if (const auto fix = fix_of(used_recent(), stations_, target_, near, latest_s(), options_.noise, 0.0)) {
    pose.t = fix->position_m;
  }
  watch_.begin();
  start_at(pose, time_s);
  ambiguous_ = choice.second_cost - choice.cost < kAmbiguousDeltaChi2;
  second_ = choice.second;
  delta_chi2_ = choice.second_cost - choice.cost;
  return true;
}

// What the recent sweeps cost from a start: -2 ln of their likelihood, twice over, so that the start itself is only a
// point to linearise at.
double NetworkTracker::cost_of(const WorldFromBody& start, WorldFromBody& refined) {
  WorldFromBody pose = start;
  double cost = 0.0;
  for (int round = 0; round < 2; ++round) {
    trial_.start(pose);
    cost = 0.0;
    double at_s = recent_[0].time_s();
    for (std::size_t i = 0; i < recent_.size(); ++i) {
      const PlaneSweep& sweep = recent_[i];
      if (watch_.excluded(sweep.station)) continue;
      const double now_s = std::max(at_s, sweep.time_s());
      trial_.predict(now_s - at_s);
      at_s = now_s;
      const LinearisedSweep linearised = linearise(sweep, stations_, target_, trial_.mean(), now_s, options_.noise);
      cost += kOutlierCost * (static_cast<double>(sweep.hits.size()) - linearised.hits());
      if (linearised.hits() == 0) continue;
      // In units of the noise: the same constant for every start.
      cost += linearised.hits() * 20.0;
      const double limit = 2.0 * kOutlierCost * linearised.hits();
      if (trial_.widest_chi2(linearised) > limit) {
        cost += limit;
        continue;
      }
      cost += trial_.correct(linearised);
    }
    pose = trial_.mean().pose;
  }
  refined = pose;
  return cost;
}

NetworkTracker::Choice NetworkTracker::best_start(const Starts& starts) {
  Choice choice;
  for (const WorldFromBody& start : starts) {
    WorldFromBody refined;
    const double cost = cost_of(start, refined);
    if (!refined.is_finite() || !std::isfinite(cost)) continue;
    if (cost < choice.cost) {
      if (choice.cost < 1e299 && !same_pose(choice.pose, refined)) {
        choice.second = choice.pose;
        choice.second_cost = choice.cost;
      }
      choice.pose = refined;
      choice.cost = cost;
    } else if (cost < choice.second_cost && !same_pose(choice.pose, refined)) {
      choice.second = refined;
      choice.second_cost = cost;
    }
  }
  return choice;
}

// A wrong minimum of a flat target may live on: stations alone, and the mirror that they tell, are asked now and then.
void NetworkTracker::check_alternatives(double time_s, bool doubted) {
  checked_s_ = time_s;
  const Starts starts = starts_of(all_recent(), stations_, target_);
  if (starts.empty()) return;
  // A start at the present pose leads to it again.
  Starts others;
  for (const WorldFromBody& start : starts) {
    if (!same_pose(start, filter_.mean().pose)) others.push_back(start);
  }
  if (others.empty()) {
    ambiguous_ = false;
    return;
  }
  WorldFromBody own;
  const double own_cost = cost_of(filter_.mean().pose, own);
  const Choice choice = best_start(others);
  if (!(choice.cost < 1e299)) return;
  const bool other = !same_pose(choice.pose, own);
  if (other && choice.cost < own_cost - kSwitchCost) {
    start_at(choice.pose, time_s);
    ambiguous_ = false;
    return;
  }
  // Followed again from the present pose the recent sweeps may lead elsewhere too: those that were refused count then.
  if (doubted && rotation_angle_between(own.R, filter_.mean().pose.R) > kSameRotation_rad) start_at(own, time_s);
  const double rival_cost = other ? choice.cost : choice.second_cost;
  ambiguous_ = rival_cost - own_cost < kAmbiguousDeltaChi2;
  second_ = other ? choice.pose : choice.second;
  delta_chi2_ = rival_cost - own_cost;
}

}  // namespace pharos::network
