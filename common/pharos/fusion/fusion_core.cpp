// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/fusion_core.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/noise_correlation.hpp"
#include "pharos/fusion/chi_squared.hpp"
#include "pharos/fusion/source_view.hpp"
#include "pharos/geometry/symmetric.hpp"

namespace pharos::fusion {
namespace {

constexpr int kFrozenRepeats = 2;   // the third equal pose: noise repeats no digit
constexpr double kJoining_s = 1.0;  // how long a source that came moves the state by one sigma at most
constexpr int kMaxHalvings = 24;
constexpr double kOwnErrorKept = 0.9;  // of the variance of a source's own error, a measurement
// A bias follows where the noise that its source states has changed by this ratio: a smaller change says nothing of it.
constexpr double kOwnErrorStep = 1.25;

bool differs(float now, float before) {
  const float ratio = static_cast<float>(kOwnErrorStep * kOwnErrorStep);  // of variances
  return now > ratio * before || before > ratio * now;
}

// In the middle of where the noise will be until it differs again: in an approach it only falls, and a bias that is set
// to what it is at each step is too large by half of a step in the mean.
float middle_of_next_step(float now, float before) { return before > 0.0F ? now * std::sqrt(now / before) : now; }

// Norm of a correction in the standard deviations before it, the larger of rotation and position.
double sigmas_moved(const Matrix6& before, const Vector6& moved) {
  const auto part = [](const Matrix3& P, const Vector3& d) {
    return std::sqrt(std::max(0.0, mahalanobis_squared<3>(d, P)));
  };
  return std::max(part(before.topLeftCorner<3, 3>(), moved.head<3>()),
                  part(before.bottomRightCorner<3, 3>(), moved.tail<3>()));
}

}  // namespace

FusionCore::FusionCore(const Settings& settings) : settings_(settings), factors_(protection_factors(settings)) {
  for (int dof = 1; dof <= 6; ++dof) {
    gates_[static_cast<std::size_t>(dof)] = chi_squared_bound(settings.detection.gate_probability, dof);
  }
  separation_threshold_ = chi_squared_bound(settings.detection.separation_probability, 3);
}

void FusionCore::predict(FusionState& state, std::int64_t time_ns) const {
  const double dt_s = seconds(time_ns, state.time_ns);
  if (dt_s != 0.0) {
    if (state.main.valid()) state.main.predict(dt_s, settings_);
    for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
      if (state.without[s].valid()) state.without[s].predict(dt_s, settings_);
    }
  }
  state.time_ns = time_ns;
}

bool FusionCore::is_lost(const FusionState& state) const {
  const DetectionSettings& limits = settings_.detection;
  if (seconds(state.time_ns, state.last_used_ns) > limits.coasting_s) return true;
  const LargestSigma sigma = largest_sigma(state.main.pose_covariance());
  return !(sigma.position_m < limits.max_sigma_position_m && sigma.rotation_rad < limits.max_sigma_rotation_rad);
}

Use FusionCore::push(FusionState& state, const Measurement& m) const {
  SourceMonitor& monitor = state.monitors[m.source];
  const bool repeated = monitor.repeats_pose(m.pose);
  const double step_s = monitor.seen ? seconds(m.time_ns, monitor.last_ns) : 0.0;
  monitor.correlation = static_cast<float>(noise_correlation(settings_.sources[m.source].noise_time_s, step_s));
  monitor.seen = true;
  monitor.last_ns = m.time_ns;
  // A gap that no prediction bridges: without this, a wrong clock would cost one step per 50 ms of it.
  if (seconds(m.time_ns, state.time_ns) > settings_.detection.coasting_s) {
    if (state.tracking) restart(state);
    state.search = Search{};
    state.main.invalidate();
    state.without[0].invalidate();
  }
  predict(state, m.time_ns);
  if (state.tracking && is_lost(state)) restart(state);
  if (repeated) {
    if (state.tracking && monitor.repeats >= kFrozenRepeats && !monitor.excluded)
      exclude(state, m.source, FaultKind::kFreeze);
    monitor.proof = Proof{};
    return Use::kFrozen;
  }
  note_own_error(state, m);
  return state.tracking ? track(state, m) : search(state, m);
}

// The source's own slow error follows the noise that it states, smoothed: stated covariances have noise themselves.
void FusionCore::note_own_error(FusionState& state, const Measurement& m) const {
  const SourceSettings& source = settings_.sources[m.source];
  if (source.own_rotation_ratio == 0.0 && source.own_position_ratio == 0.0) return;
  const auto rows = m.directions.rows.topRows(m.directions.rank);
  const Matrix3 measured = rows.leftCols<3>().transpose().lazyProduct(rows.leftCols<3>());  // projector
  const Matrix3 rotation = measured.lazyProduct(m.covariance.topLeftCorner<3, 3>());
  const double axes = std::max(measured.trace(), 1.0);
  const double rotation_sigma = source.own_rotation_ratio * std::sqrt(rotation.trace() / axes);
  const double position_sigma =
      source.own_position_ratio * std::sqrt(m.covariance.bottomRightCorner<3, 3>().trace() / 3.0);
  OwnVariance& own = state.monitors[m.source].own;
  const OwnVariance last = own;
  const double kept = last.rotation == 0.0F && last.position == 0.0F ? 0.0 : kOwnErrorKept;
  const auto smoothed = [kept](float before, double now) {
    return static_cast<float>(kept * static_cast<double>(before) + (1.0 - kept) * now);
  };
  own = {smoothed(last.rotation, rotation_sigma * rotation_sigma),
         smoothed(last.position, position_sigma * position_sigma)};
  const OwnVariance& used = state.main.own_variance(m.source);
  if (!differs(own.rotation, used.rotation) && !differs(own.position, used.position)) return;
  const OwnVariance next{middle_of_next_step(own.rotation, used.rotation),
                         middle_of_next_step(own.position, used.position)};
  state.main.set_own_variance(m.source, next, settings_);
  for (Filter& filter : state.without) filter.set_own_variance(m.source, next, settings_);
}

Use FusionCore::track(FusionState& state, const Measurement& raw) const {
  if (state.monitors[raw.source].excluded) return prove(state, raw);
  if (state.suspects.active) return track_in_conflict(state, raw);
  const Use use = use_or_gate(state, raw);
  if (state.tracking && !state.suspects.active) examine_separations(state);
  if (state.tracking && state.unresolved.active) examine_unresolved(state);
  return use;
}

TargetMeasurement FusionCore::view(const FusionState& state, const Measurement& raw,
                                   const TargetPose* reference) const {
  const SourceSettings& source = settings_.sources[raw.source];
  TargetMeasurement out =
      to_target(raw, source, source.relative ? state.T_target_feature[raw.source] : source.T_target_feature, reference);
  out.correlation = static_cast<double>(state.monitors[raw.source].correlation);
  return out;
}

// Of a relative source: where its first pose says, so that its bias begins at zero.
void FusionCore::place_feature(FusionState& state, const Measurement& raw) const {
  const auto T_vehicle_feature = settings_.sources[raw.source].T_vehicle_sensor * raw.pose;
  state.T_target_feature[raw.source] = state.main.mean().pose.inverse() * T_vehicle_feature;
  for (Filter& filter : state.without) {
    if (filter.valid()) filter.reset_bias(raw.source, settings_);
  }
}

Use FusionCore::use_or_gate(FusionState& state, const Measurement& raw) const {
  SourceMonitor& monitor = state.monitors[raw.source];
  const SourceSettings& source = settings_.sources[raw.source];
  const bool align = source.relative && !state.main.aligned(raw.source);
  if (align) place_feature(state, raw);
  TargetMeasurement m = view(state, raw, &state.main.mean().pose);
  monitor.directions = m.directions;
  if (align) {
    state.main.align(m, settings_);
    for (std::size_t k = 0; k < settings_.sources.size(); ++k) {
      if (k != m.source) correct_without(state, k, m.as_one_of_many(), false);
    }
    monitor.note_used(m.time_ns);
    return Use::kUsed;
  }
  Innovation in = state.main.innovation(m, settings_);
  bool second = false;
  if (m.second) {
    const Innovation other = state.main.innovation(m, settings_, true);
    const bool both = in.ok && other.ok && in.nis < gate(in.rank) && other.nis < gate(other.rank);
    if (both && std::abs(in.nis - other.nis) < kAmbiguousDeltaChi2) {
      ++state.counters.ambiguous;
      return Use::kAmbiguous;
    }
    second = other.ok && other.nis < in.nis;
    if (second) in = other;
  }
  monitor.nis = in.nis;
  monitor.rank = in.rank;
  monitor.sums.add(in, m, state.main.mean(), source);
  if (!in.ok || !(in.nis < gate(in.rank))) {
    ++state.counters.gated;
    // What the other solutions think of it counts, although they do not use it.
    for (std::size_t k = 0; k < settings_.sources.size(); ++k) {
      Filter& filter = state.without[k];
      if (k == m.source || !filter.valid() || (source.relative && !filter.aligned(m.source))) continue;
      state.innovation_means[k][m.source].add(filter.innovation(m.as_one_of_many(), settings_, second), m.time_ns);
    }
    examine_gated(state, m, in);
    return Use::kGated;
  }
  if (m.correlation > 1.0) {
    m = m.as_one_of_many();
    in = state.main.innovation(m, settings_, second);
  }
  correct_main(state, m, in, second);
  for (std::size_t k = 0; k < settings_.sources.size(); ++k) {
    if (k != m.source) correct_without(state, k, m, second);
  }
  monitor.note_used(m.time_ns);
  state.last_used_ns = m.time_ns;
  ++state.counters.used;
  return Use::kUsed;
}

void FusionCore::correct_main(FusionState& state, TargetMeasurement& m, const Innovation& first, bool second) const {
  SourceMonitor& monitor = state.monitors[m.source];
  const bool came =
      !monitor.ever_used || seconds(m.time_ns, monitor.last_used_ns) > settings_.sources[m.source].silent_after_s;
  if (came) {
    monitor.joined_ns = m.time_ns;
    ++state.counters.hand_overs;
  }
  if (seconds(m.time_ns, monitor.joined_ns) > kJoining_s) {
    state.main.correct(first, m.source, settings_);
    return;
  }
  // A source that comes may lie anywhere within the state's sigma; with the weight that it deserves it would move the
  // state by more than one in three cases of ten. It gets less until one sigma is not exceeded: conservative. The
  // other solutions take it with the same weight, or their differences would not be what the covariances say.
  const Matrix6 before = state.main.pose_covariance();
  const TargetPose pose_before = state.main.mean().pose;
  Innovation in = first;
  const Filter saved = state.main;
  for (int step = 0;; ++step) {
    state.main.correct(in, m.source, settings_);
    const double moved = sigmas_moved(before, pose_difference(state.main.mean().pose, pose_before));
    if (moved <= 1.0 || step == kMaxHalvings) {
      state.counters.largest_hand_over_sigma = std::max(state.counters.largest_hand_over_sigma, moved);
      break;
    }
    if (step == 0) ++state.counters.limited_steps;
    m.covariance *= 2.0;
    state.main = saved;
    in = state.main.innovation(m, settings_, second);
  }
}

void FusionCore::correct_without(FusionState& state, std::size_t k, const TargetMeasurement& m, bool second) const {
  Filter& filter = state.without[k];
  const SourceSettings& source = settings_.sources[m.source];
  // One that began with a part of a pose begins anew with the first whole one.
  const bool whole = !source.relative && m.directions.rank == 6;
  if (!filter.valid() || (whole && !filter.complete())) {
    if (!source.relative) filter.start(m.alone().chosen(second), settings_, &state.main.mean().pose);
    return;
  }
  if (source.relative && !filter.aligned(m.source)) {
    filter.align(m.alone(), settings_);
    return;
  }
  const Innovation in = filter.innovation(m, settings_, second);
  state.innovation_means[k][m.source].add(in, m.time_ns);
  if (in.ok && in.nis < gate(in.rank)) filter.correct(in, m.source, settings_);
}

void FusionCore::drop_without(FusionState& state, std::size_t k) const {
  state.without[k].invalidate();
  state.innovation_means[k] = {};
}

// Before anything is decided: as many sources contradict the track, twice in a row, as agree with it.
bool FusionCore::is_contradicted(const FusionState& state, std::int64_t time_ns) const {
  int agreeing = 0;
  int contradicting = 0;
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    const SourceMonitor& monitor = state.monitors[s];
    if (settings_.sources[s].relative || monitor.excluded || !monitor.seen) continue;
    if (seconds(time_ns, monitor.last_ns) > settings_.sources[s].silent_after_s) continue;
    if (monitor.last_gated) {
      contradicting += monitor.gated_run > 1 ? 1 : 0;
    } else {
      agreeing += monitor.contributed ? 1 : 0;
    }
  }
  return contradicting > 0 && contradicting >= agreeing;
}

Mode FusionCore::mode_at(const FusionState& state, std::int64_t time_ns) const {
  if (!state.tracking) return state.lost ? Mode::kLost : Mode::kSearching;
  // Nor is anything told of a time long before (the caller's clock was set).
  if (std::abs(seconds(time_ns, state.last_used_ns)) > settings_.detection.coasting_s) return Mode::kLost;
  if (state.suspects.active || state.unresolved.active || is_contradicted(state, time_ns)) return Mode::kConflict;
  int used = 0;
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    const SourceMonitor& monitor = state.monitors[s];
    used +=
        monitor.contributed && seconds(time_ns, monitor.last_used_ns) <= settings_.sources[s].silent_after_s ? 1 : 0;
  }
  return used == 0 ? Mode::kCoasting : used == 1 ? Mode::kSingle : Mode::kFused;
}

TargetState FusionCore::report(const FusionState& state, std::int64_t time_ns) const {
  TargetState out;
  out.time_ns = time_ns;
  out.mode = mode_at(state, time_ns);
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    const SourceMonitor& monitor = state.monitors[s];
    SourceReport report;
    report.heard = monitor.seen;
    report.age_s = monitor.seen ? seconds(time_ns, monitor.last_ns) : 0.0;
    report.reason = monitor.reason;
    report.normalised_innovation = monitor.rank > 0 ? monitor.nis / monitor.rank : 0.0;
    const bool suspect = state.suspects.active && (state.suspects.first == s || state.suspects.second == s);
    if (monitor.excluded) {
      report.state = SourceState::kExcluded;
    } else if (suspect) {
      report.state = SourceState::kConflict;
    } else if (monitor.seen && report.age_s <= settings_.sources[s].silent_after_s) {
      report.state = monitor.last_gated ? SourceState::kGated : SourceState::kUsed;
    }
    out.sources.push_back(report);
  }
  out.valid = out.mode != Mode::kSearching && out.mode != Mode::kLost;
  if (!out.valid) return out;
  const double dt_s = seconds(time_ns, state.time_ns);
  Filter main = state.main;
  main.predict(dt_s, settings_);
  out.kinematics = main.mean();
  out.covariance = main.kinematic_covariance();
  const LargestSigma sigma = largest_sigma(main.pose_covariance());
  out.protection = {true, true, factors_.fault_free * sigma.position_m, factors_.fault_free * sigma.rotation_rad};
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    if (!state.monitors[s].contributed) continue;
    if (!state.without[s].valid()) {
      out.protection.position_available = out.protection.rotation_available = false;
      continue;
    }
    Filter other = state.without[s];
    other.predict(dt_s, settings_);
    widen(out.protection, main, other, factors_.without[s]);
    if (!other.complete()) out.protection.rotation_available = out.protection.position_available = false;
    if (!state.suspects.active) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      if ((side == 0 ? state.suspects.first : state.suspects.second) != s) continue;
      out.conflict[side] = {static_cast<std::uint8_t>(s), true, other.mean().pose, other.pose_covariance()};
    }
  }
  if (state.unresolved.active) out.protection.position_available = out.protection.rotation_available = false;
  ProtectionLevel& level = out.protection;
  level.position_available = level.position_available && level.position_m <= settings_.integrity.max_position_m;
  level.rotation_available = level.rotation_available && level.rotation_rad <= settings_.integrity.max_rotation_rad;
  if (!level.position_available) level.position_m = 0.0;
  if (!level.rotation_available) level.rotation_rad = 0.0;
  return out;
}

}  // namespace pharos::fusion
