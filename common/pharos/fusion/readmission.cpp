// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/fusion_core.hpp"

namespace pharos::fusion {
namespace {

constexpr unsigned kBothSides = 3;  // bits: of the first suspect, of the second

// A measurement beside a solution, with its source's bias as unknown as before its first one.
Innovation beside(const Filter& filter, const TargetMeasurement& m, const Settings& settings) {
  Filter probe = filter;
  probe.reset_bias(m.source, settings);
  return probe.innovation(m, settings, probe.second_fits_better(m, settings));
}

// What the source's noise and slow error leave of its measurement, in the vehicle frame.
Vector6 own_variance(const TargetMeasurement& m, const SourceSettings& source) {
  const Vector6 bias = source.bias_covariance.diagonal();
  Vector6 out = m.covariance.diagonal() + bias;
  out.tail<3>().array() += (m.pose.t - source.T_vehicle_sensor.t).squaredNorm() * bias.head<3>().maxCoeff();
  return out;
}

// Squared distance of two residuals in the directions that both sources measure, in their own sigmas.
double apart(const Directions& common, const Vector6& difference, const Vector6& variance) {
  double sum = 0.0;
  for (int i = 0; i < common.rank; ++i) {
    const double along = common.rows.row(i).dot(difference);
    sum += along * along / common.rows.row(i).cwiseAbs2().dot(variance);
  }
  return sum;
}

}  // namespace

void FusionCore::readmit(FusionState& state, std::uint8_t source) const {
  state.monitors[source].excluded = false;
  state.monitors[source].gated_run = 0;
  state.main.reset_bias(source, settings_);
  for (std::size_t k = 0; k < settings_.sources.size(); ++k) {
    if (state.without[k].valid()) state.without[k].reset_bias(source, settings_);
  }
  state.without[source] = state.main;
  ++state.counters.readmissions;
}

Use FusionCore::prove(FusionState& state, const Measurement& raw) const {
  SourceMonitor& monitor = state.monitors[raw.source];
  if (settings_.sources[raw.source].relative) {
    // It is placed anew where it comes back: nothing of before can contradict it.
    if (state.suspects.active) {
      monitor.proof = Proof{};
      return Use::kExcluded;
    }
    monitor.proof.add(raw.time_ns);
    if (monitor.proof.long_enough(raw.time_ns, settings_.detection)) readmit(state, raw.source);
    return Use::kExcluded;
  }
  if (state.suspects.active) {
    prove_in_conflict(state, raw);
    return Use::kExcluded;
  }
  const TargetMeasurement m = view(state, raw, &state.main.mean().pose);
  const Innovation in = beside(state.main, m, settings_);
  monitor.nis = in.nis;
  monitor.rank = in.rank;
  if (!in.ok || !(in.nis < gate(in.rank))) {
    monitor.proof = Proof{};
    examine_contradiction(state, m, in);
    return Use::kExcluded;
  }
  monitor.note_agreement();
  monitor.proof.add(in, m);
  if (!monitor.proof.long_enough(m.time_ns, settings_.detection)) return Use::kExcluded;
  if (monitor.proof.is_sound(in, m)) readmit(state, m.source);
  monitor.proof = Proof{};
  return Use::kExcluded;
}

// An excluded source is the third witness that a conflict lacks: of two sides that contradict each other it can agree
// with one only, and what it agrees with for as long as a readmission takes is right.
void FusionCore::prove_in_conflict(FusionState& state, const Measurement& raw) const {
  SourceMonitor& monitor = state.monitors[raw.source];
  const Suspects suspects = state.suspects;
  unsigned fits = 0;
  double nis = 0.0;
  for (unsigned side = 0; side < 2; ++side) {
    const Filter& filter = state.without[side == 0 ? suspects.second : suspects.first];
    if (!filter.valid()) continue;
    const Innovation in = beside(filter, view(state, raw, &filter.mean().pose), settings_);
    if (!in.ok || !(in.nis < gate(in.rank))) continue;
    nis = fits == 0 || in.nis < nis ? in.nis : nis;
    fits |= 1U << side;
  }
  monitor.nis = nis;
  monitor.rank = raw.directions.rank;
  Proof& proof = monitor.proof;
  const unsigned sides = proof.count == 0 ? fits : proof.sides & fits;
  if (sides == 0) {
    proof = Proof{};
    return;
  }
  monitor.note_agreement();
  proof.add(raw.time_ns);
  proof.sides = sides;
  proof.nis += nis;
  proof.dof += raw.directions.rank;
  if (!proof.long_enough(raw.time_ns, settings_.detection)) return;
  const bool fitted = proof.fits_beside();
  proof = Proof{};
  if (!fitted) return;
  const bool one_side = sides != kBothSides;
  if (one_side) {
    // A side that began with a part of a pose is told the rest by the witness.
    Filter& right = state.without[(sides & 1U) != 0 ? suspects.second : suspects.first];
    if (!right.complete() && raw.directions.rank == 6) right.start(view(state, raw, nullptr), settings_, nullptr);
    const std::uint8_t wrong = (sides & 1U) != 0 ? suspects.second : suspects.first;
    end_conflict(state, wrong, state.monitors[wrong].classify(false, state.monitors[wrong].gated_residual));
  }
  if (state.tracking) readmit(state, raw.source);
}

// Each excluded source alone contradicts the state because it is wrong, as far as the state knows. Two that say the
// same thing against it are not wrong together: the state is, and its solutions hold nothing that could tell.
void FusionCore::examine_contradiction(FusionState& state, const TargetMeasurement& m, const Innovation& in) const {
  SourceMonitor& monitor = state.monitors[m.source];
  monitor.gated_residual = in.residual;
  monitor.contradiction_variance = own_variance(m, settings_.sources[m.source]).cast<float>();
  monitor.directions = m.directions;
  bool agreed = false;
  for (std::size_t k = 0; k < settings_.sources.size(); ++k) {
    const SourceMonitor& other = state.monitors[k];
    if (k == m.source || !other.excluded || other.contradicts_ns == 0) continue;
    if (seconds(m.time_ns, other.contradicts_ns) > settings_.sources[k].silent_after_s) continue;
    const Directions& common = m.directions.rank <= other.directions.rank ? m.directions : other.directions;
    const Vector6 variance = (monitor.contradiction_variance + other.contradiction_variance).cast<double>();
    const double distance = apart(common, in.residual - other.gated_residual, variance);
    agreed = agreed || distance < gate(common.rank);
  }
  monitor.note_contradiction(m.time_ns, agreed);
  if (!monitor.contradiction_confirmed(m.time_ns, settings_.detection)) return;
  int agreeing = 0;  // in the state; where they are two as well nothing tells which two are right
  for (std::size_t k = 0; k < settings_.sources.size(); ++k) {
    const SourceMonitor& other = state.monitors[k];
    const bool live = seconds(m.time_ns, other.last_used_ns) <= settings_.sources[k].silent_after_s;
    agreeing += other.contributed && live && !settings_.sources[k].relative ? 1 : 0;
  }
  if (agreeing < 2) refute(state);
}

// Begins anew with those that contradicted; those that made the state have to prove themselves.
void FusionCore::refute(FusionState& state) const {
  std::array<bool, kMaxSources> made{};
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    made[s] = state.monitors[s].contributed && !settings_.sources[s].relative;
  }
  restart(state);
  ++state.counters.refuted;
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    if (!made[s]) continue;
    state.monitors[s].exclude(state.monitors[s].classify(true, state.monitors[s].gated_residual));
    ++state.counters.exclusions;
  }
}

}  // namespace pharos::fusion
