// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "pharos/fusion/fusion_core.hpp"

namespace pharos::fusion {
namespace {

constexpr double kSuspicious = 1.0 / 3.0;  // of the separation's threshold: another source may be the faulty one
constexpr double kWitnessed = 0.7;         // of a direction: the witness measures it
constexpr double kOutlierFraction = 0.35;  // of a source's measurements: it is not believed
constexpr int kJudged = 12;                // before that fraction says something
constexpr int kScatteredRun = 3;           // gated poses that contradict each other: no motion does that
constexpr double kAlone_s = 1.0;           // after which the only source is followed
constexpr double kPoor = 1.0 / 6.0;        // sigma over the largest level

}  // namespace

void FusionCore::exclude(FusionState& state, std::uint8_t source, FaultKind why) const {
  ++state.counters.exclusions;
  const bool contributed = state.monitors[source].contributed;
  state.monitors[source].exclude(why);
  if (!state.tracking || !contributed) return;
  const Suspects& suspects = state.suspects;
  if (suspects.active && source != suspects.first && source != suspects.second) {
    // Both sides of the conflict hold its measurements. A frozen one's are right: repeated poses were never used.
    if (why == FaultKind::kFreeze) {
      state.without[source] = state.main;
    } else {
      restart_unresolved(state);
    }
    return;
  }
  if (!state.without[source].valid() || !state.without[source].complete()) {
    restart(state);  // nothing is left that knows the whole pose
    return;
  }
  // The solution without it never held the fault. All others did: they start anew from the next measurements.
  state.main = state.without[source];
  for (std::size_t k = 0; k < settings_.sources.size(); ++k) {
    if (k != source && state.monitors[k].contributed) {
      drop_without(state, k);
    } else if (k != source) {
      state.without[k] = state.main;
    }
  }
  state.suspects = Suspects{};
}

void FusionCore::examine_gated(FusionState& state, const TargetMeasurement& m, const Innovation& in) const {
  SourceMonitor& monitor = state.monitors[m.source];
  const Vector6 change = in.residual - monitor.gated_residual;
  const Matrix6 noise = 2.0 * m.covariance;
  double apart = 0.0;
  for (int i = 0; i < 6; ++i) apart += change[i] * change[i] / noise(i, i);
  monitor.note_gated(m.time_ns, in.residual, apart);
  if (state.suspects.active) return;  // one contradiction at a time
  if ((monitor.judged >= kJudged && monitor.outliers > kOutlierFraction && monitor.scattered > 0) ||
      monitor.scattered >= kScatteredRun) {
    exclude(state, m.source, FaultKind::kOutliers);
    return;
  }
  const DetectionSettings& limits = settings_.detection;
  const double run_s = seconds(m.time_ns, monitor.gated_since_ns);
  if (monitor.gated_run < limits.gated_run || run_s < limits.gated_run_s) return;
  // Who else measures this direction, and agrees with the state?
  Vector6 direction = in.residual;
  for (int i = 0; i < 6; ++i) direction[i] /= std::sqrt(m.covariance(i, i));
  direction.normalize();
  int witnesses = 0;
  std::uint8_t witness = 0;
  for (std::uint8_t k = 0; k < sources(); ++k) {
    const SourceMonitor& other = state.monitors[k];
    const SourceSettings& source = settings_.sources[k];
    if (k == m.source || other.excluded || other.last_gated || source.relative || !other.contributed) continue;
    if (seconds(m.time_ns, other.last_used_ns) > source.silent_after_s) continue;
    if (other.last_used_ns < monitor.gated_since_ns) continue;
    if (other.directions.fraction_of(direction) < kWitnessed) continue;
    ++witnesses;
    witness = k;
  }
  if (witnesses == 0) {
    mark_unresolved(state, m.source);
    if (run_s > kAlone_s) restart(state);
    return;
  }
  std::uint8_t suspect = witness;
  bool doubted = witnesses == 1;
  for (std::uint8_t k = 0; k < sources(); ++k) {
    if (k == m.source || !state.monitors[k].contributed) continue;
    const double largest = std::fmax(separation(state, k, true), separation(state, k, false));
    if (largest > kSuspicious * separation_threshold_) {
      doubted = true;
      suspect = k;
    }
  }
  if (doubted && source_is_alone(state, suspect)) {
    // A relative source beside the only one that tells the whole pose: there is no solution without that. It is placed
    // anew, and the other one has to agree with what both made.
    exclude(state, m.source, monitor.classify(false, in.residual));
    if (state.tracking) mark_unresolved(state, suspect);
  } else if (doubted) {
    enter_conflict(state, m.source, suspect);
  } else {
    exclude(state, m.source, monitor.classify(false, in.residual));
  }
}

bool FusionCore::source_is_alone(const FusionState& state, std::uint8_t source) const {
  return !state.without[source].valid() || !state.without[source].complete();
}

// 0 where it says nothing.
double FusionCore::separation(const FusionState& state, std::size_t source, bool rotation) const {
  const Filter& other = state.without[source];
  if (!state.monitors[source].contributed || !other.valid() || !other.complete()) return 0.0;
  const int at = rotation ? 0 : 3;
  const Vector3 d = pose_difference(state.main.mean().pose, other.mean().pose).segment<3>(at);
  const Matrix3 P_other = other.pose_covariance().block<3, 3>(at, at);
  // A solution that poor bounds nothing, and is too wide for a linear difference.
  const double largest = rotation ? settings_.integrity.max_rotation_rad : settings_.integrity.max_position_m;
  if (P_other.trace() > kPoor * kPoor * largest * largest) return 0.0;
  // Never below separation_chi2(), and cheaper; where it suspects nothing the other does not either.
  const Matrix3 P = state.main.pose_covariance().block<3, 3>(at, at);
  const Eigen::LDLT<Matrix3> factor(P_other * (1.0 + kSeparationSlack) - P);
  if (factor.info() == Eigen::Success && factor.isPositive()) {
    const double chi2 = d.dot(factor.solve(d));
    if (chi2 < kSuspicious * separation_threshold_) return chi2;
  }
  return separation_chi2(d, P_other, P);
}

// How badly the measurements of all other sources fit the solution without one: what a fault of another source leaves.
double FusionCore::misfit(const FusionState& state, std::size_t without) const {
  double sum = 0.0;
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    if (s == without || !state.monitors[s].contributed) continue;
    const InnovationMean& mean = state.innovation_means[without][s];
    sum += std::fmax(0.0, mean.chi2() - mean.rank);
  }
  return sum;
}

// A separation beyond its threshold tells that there is a fault; the solution that the remaining sources fit tells
// whose. The largest separation does not: a solution without the best source is the most sensitive to any other's ramp.
void FusionCore::examine_separations(FusionState& state) const {
  double largest = 0.0;
  std::array<double, 2> best{1e300, 1e300};
  std::array<std::uint8_t, 2> who{};
  int candidates = 0;
  for (std::uint8_t s = 0; s < sources(); ++s) {
    if (!state.monitors[s].contributed || !state.without[s].valid() || !state.without[s].complete()) continue;
    largest = std::fmax(largest, std::fmax(separation(state, s, true), separation(state, s, false)));
    const double fit = misfit(state, s);
    ++candidates;
    if (fit < best[0]) {
      best = {fit, best[0]};
      who = {s, who[0]};
    } else if (fit < best[1]) {
      best[1] = fit;
      who[1] = s;
    }
  }
  if (largest < separation_threshold_ || candidates < 2) return;
  if (best[1] - best[0] > settings_.detection.attribution_chi2) {
    exclude(state, who[0], state.monitors[who[0]].classify(true, state.monitors[who[0]].gated_residual));
  } else if (largest > settings_.detection.conflict_ratio * separation_threshold_) {
    enter_conflict(state, who[0], who[1]);
  }
}

}  // namespace pharos::fusion
