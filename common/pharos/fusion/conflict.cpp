// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pharos/fusion/fusion_core.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::fusion {
namespace {

constexpr double kAgree_probability_chi2 = 11.3;  // 1 % of three degrees of freedom
constexpr double kStarved_s = 1.0;                // a side that accepts nothing of its source begins anew

double distance(const Filter& a, const Filter& b, int at) {
  const Vector6 apart = pose_difference(a.mean().pose, b.mean().pose);
  const Matrix3 P = (a.pose_covariance() + b.pose_covariance()).block<3, 3>(at, at);
  const Vector3 d = apart.segment<3>(at);
  return mahalanobis_squared<3>(d, P);
}

// How badly the measurements of sources that are not suspect fit the solution without one of the suspects.
double side_misfit(const FusionState& state, std::uint8_t without) {
  double sum = 0.0;
  for (std::size_t s = 0; s < kMaxSources; ++s) {
    if (s == state.suspects.first || s == state.suspects.second || !state.monitors[s].contributed) continue;
    const InnovationMean& mean = state.innovation_means[without][s];
    sum += std::max(0.0, mean.chi2() - mean.rank);
  }
  return sum;
}

}  // namespace

void FusionCore::enter_conflict(FusionState& state, std::uint8_t first, std::uint8_t second) const {
  ++state.counters.conflicts;
  state.suspects = Suspects{true, first, second, 0};
  for (SourceMonitor& monitor : state.monitors) monitor.proof = Proof{};  // it was beside the main one
  for (const std::uint8_t s : {first, second}) {
    state.monitors[s].contributed = true;  // the level covers the fault of either
    state.monitors[s].gated_run = 0;
    state.monitors[s].scattered = 0;
  }
}

// The suspects' measurements go only into the solutions without the other one.
Use FusionCore::track_in_conflict(FusionState& state, const Measurement& raw) const {
  Suspects& suspects = state.suspects;
  const TargetMeasurement m = view(state, raw, &state.main.mean().pose);
  SourceMonitor& monitor = state.monitors[m.source];
  const bool suspect = m.source == suspects.first || m.source == suspects.second;
  if (!suspect) {
    const Use use = use_or_gate(state, raw);
    if (state.tracking && suspects.active) examine_conflict(state);
    return use;
  }
  const std::uint8_t other = m.source == suspects.first ? suspects.second : suspects.first;
  Filter& side = state.without[other];
  const bool whole = m.directions.rank == 6 && !settings_.sources[m.source].relative;
  if (!side.valid() || (whole && !side.complete())) {
    const bool second = state.main.second_fits_better(m, settings_);
    if (!settings_.sources[m.source].relative) side.start(m.chosen(second), settings_, &state.main.mean().pose);
    monitor.gated_run = 0;
    return Use::kConflict;
  }
  const TargetMeasurement own = view(state, raw, &side.mean().pose);
  if (settings_.sources[m.source].relative && !side.aligned(m.source)) {
    side.align(own, settings_);
    return Use::kConflict;
  }
  const bool second = side.second_fits_better(own, settings_);
  const Innovation in = side.innovation(own, settings_, second);
  monitor.nis = in.nis;
  monitor.rank = in.rank;
  if (in.ok && in.nis < gate(in.rank)) {
    const Innovation weighed = own.correlation > 1.0 ? side.innovation(own.as_one_of_many(), settings_, second) : in;
    if (weighed.ok) side.correct(weighed, m.source, settings_);
    monitor.gated_run = 0;
  } else {
    if (monitor.gated_run == 0) monitor.gated_since_ns = m.time_ns;
    ++monitor.gated_run;
    if (seconds(m.time_ns, monitor.gated_since_ns) > kStarved_s) {
      if (m.directions.rank == 6 && !settings_.sources[m.source].relative) side.start(m, settings_, nullptr);
      monitor.gated_run = 0;
    }
  }
  state.last_used_ns = m.time_ns;
  examine_conflict(state);
  return Use::kConflict;
}

void FusionCore::end_conflict(FusionState& state, std::uint8_t wrong, FaultKind why) const {
  state.suspects.active = false;
  exclude(state, wrong, why);
}

void FusionCore::examine_conflict(FusionState& state) const {
  Suspects& suspects = state.suspects;
  const Filter& without_first = state.without[suspects.first];
  const Filter& without_second = state.without[suspects.second];
  if (!without_first.valid() || !without_second.valid()) return;
  // Other sources' measurements fit one side and contradict the other: the source that only the worse side uses is the
  // wrong one. Not by likelihood, which favours the side of the better source whatever is wrong.
  const double misfit_of_first = side_misfit(state, suspects.second);
  const double misfit_of_second = side_misfit(state, suspects.first);
  if (std::abs(misfit_of_first - misfit_of_second) > settings_.detection.attribution_chi2) {
    const std::uint8_t wrong = misfit_of_first > misfit_of_second ? suspects.first : suspects.second;
    // What contradicts both sides does not make the better one right.
    if (std::min(misfit_of_first, misfit_of_second) > settings_.detection.attribution_chi2) {
      restart_unresolved(state);
    } else {
      end_conflict(state, wrong, state.monitors[wrong].classify(false, state.monitors[wrong].gated_residual));
    }
    return;
  }
  const bool agree = distance(without_first, without_second, 0) < kAgree_probability_chi2 &&
                     distance(without_first, without_second, 3) < kAgree_probability_chi2;
  if (!agree) {
    suspects.agree_since_ns = 0;
    return;
  }
  if (suspects.agree_since_ns == 0) suspects.agree_since_ns = state.time_ns;
  if (seconds(state.time_ns, suspects.agree_since_ns) < settings_.detection.proof_s) return;
  // Both again: the main solution goes on from the better one, which holds the other suspect's measurements.
  if (!without_first.complete() && !without_second.complete()) return;
  const bool first_better =
      without_first.complete() && (!without_second.complete() || without_first.pose_covariance().diagonal().sum() <
                                                                     without_second.pose_covariance().diagonal().sum());
  const std::uint8_t left_out = first_better ? suspects.first : suspects.second;
  const std::uint8_t held = first_better ? suspects.second : suspects.first;
  suspects.active = false;
  state.main = state.without[left_out];
  state.monitors[left_out].contributed = false;
  for (std::uint8_t k = 0; k < sources(); ++k) {
    if (k != left_out && k != held && state.monitors[k].contributed) drop_without(state, k);
  }
}

}  // namespace pharos::fusion
