// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/target_estimator.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::fusion {
namespace {

// With snapshots 0.1 s apart the oldest of three is 0.2 to 0.3 s old.
constexpr double kSnapshotInterval_s = TargetEstimator::kMinLag_s / (static_cast<double>(kSnapshots) - 1.0);
constexpr double kMaxAhead_s = 5.0;  // no source is that much fresher than all others
constexpr int kAheadRun = 5;         // consecutive ones, nothing else heard: the clock was set
// A source's times got this far, and its usual step, ahead of the others' in one step: believed, it would make all
// others too late. Delays that vary are below.
constexpr double kMaxJump_s = 0.1;
constexpr double kUsualStep_s = 0.2;  // a longer one was a gap
constexpr double kJumpTrial_s = 1.0;  // of its own time in which nothing else is heard: the others are gone
constexpr std::int64_t kBegin_ns = 1;
// Times beyond this (29 years either side of zero on an unset clock is covered) could overflow differences.
constexpr std::int64_t kMaxTime_ns = std::int64_t{1} << 62;

static_assert(sizeof(TargetEstimator) <= 256 * 1024, "the state's limit");

bool before(const Measurement& a, const Measurement& b) {
  return a.time_ns != b.time_ns ? a.time_ns < b.time_ns : a.source < b.source;
}

}  // namespace

TargetEstimator::TargetEstimator(const Settings& settings) : settings_(settings), core_(settings_) {}

void TargetEstimator::reset() {
  const FusionCounters counters = current_.counters;
  current_ = FusionState{};
  current_.counters = counters;
  snapshots_.clear();
  buffer_.clear();
  heard_ = {};
  ahead_run_ = {};
  stamped_ns_ = {};
  stamped_then_ns_ = {};
  step_s_ = {};
  jumped_since_ns_ = {};
  started_ = false;
}

bool TargetEstimator::set_bias_covariance(std::uint8_t source, const Matrix6& covariance) {
  if (source >= settings_.sources.size() || heard_[source]) return false;
  if (!covariance.allFinite() || !positive_inverse<6>(covariance)) return false;
  settings_.sources[source].bias_covariance = covariance;
  reset_bias(current_, source);
  for (FusionState& snapshot : snapshots_) reset_bias(snapshot, source);
  return true;
}

// Filters that have not used the source hold the covariance of before.
void TargetEstimator::reset_bias(FusionState& state, std::uint8_t source) const {
  if (state.main.valid()) state.main.reset_bias(source, settings_);
  for (Filter& filter : state.without) {
    if (filter.valid()) filter.reset_bias(source, settings_);
  }
}

void TargetEstimator::begin(std::int64_t time_ns) {
  reset();
  started_ = true;
  current_.time_ns = time_ns - kBegin_ns;
  current_.last_used_ns = current_.time_ns;
  take_snapshot();
}

Refusal TargetEstimator::check_time(const Measurement& m) {
  if (m.time_ns <= -kMaxTime_ns || m.time_ns >= kMaxTime_ns) return Refusal::kTimeAhead;
  if (heard_[m.source] && m.time_ns <= last_ns_[m.source]) return Refusal::kTimeGoesBack;
  if (!started_) {
    begin(m.time_ns);
  } else if (seconds(m.time_ns, current_.time_ns) > kMaxAhead_s) {
    if (++ahead_run_[m.source] < kAheadRun) return Refusal::kTimeAhead;
    begin(m.time_ns);
    current_.lost = true;
  }
  if (m.time_ns <= snapshots_[0].time_ns) return Refusal::kTooLate;
  return jumps_ahead(m) ? Refusal::kTimeAhead : Refusal::kNone;
}

// Whether the source's time went on by much more than that of every other one since its last measurement.
bool TargetEstimator::jumps_ahead(const Measurement& m) {
  if (!heard_[m.source]) return false;
  const std::int64_t last_ns = last_ns_[m.source];
  double jump_s = 1e9;
  bool live = false;  // others that were silent before tell nothing
  for (std::size_t s = 0; s < kMaxSources; ++s) {
    const std::int64_t then_ns = stamped_then_ns_[m.source][s];
    if (s == m.source || then_ns == 0 || std::abs(seconds(last_ns, then_ns)) > kJumpTrial_s) continue;
    live = true;
    jump_s = std::min(jump_s, seconds(m.time_ns, last_ns) - seconds(stamped_ns_[s], then_ns));
  }
  if (!live || jump_s < kMaxJump_s + std::min(step_s_[m.source], kUsualStep_s)) return false;
  std::int64_t& since_ns = jumped_since_ns_[m.source];
  if (since_ns == 0) since_ns = m.time_ns;
  return seconds(m.time_ns, since_ns) < kJumpTrial_s;
}

Outcome TargetEstimator::push(const Measurement& measurement) {
  Outcome out;
  out.refusal = check_measurement(measurement, settings_.sources.size());
  if (out.refusal == Refusal::kNone) {
    out.refusal = check_time(measurement);
    stamped_ns_[measurement.source] = measurement.time_ns;
  }
  if (out.refusal != Refusal::kNone) {
    ++refused_[static_cast<std::size_t>(out.refusal)];
    return out;
  }
  ahead_run_ = {};
  jumped_since_ns_ = {};
  stamped_then_ns_[measurement.source] = stamped_ns_;
  step_s_[measurement.source] =
      heard_[measurement.source] ? seconds(measurement.time_ns, last_ns_[measurement.source]) : kUsualStep_s;
  heard_[measurement.source] = true;
  last_ns_[measurement.source] = measurement.time_ns;
  while (buffer_.full()) drop_oldest_snapshot();
  out.late = !buffer_.empty() && before(measurement, buffer_.back());
  insert(measurement);
  if (!out.late) {
    out.use = process(measurement);
    return out;
  }
  ++late_;
  // From the newest copy before it, all over again; copies taken after it are wrong now.
  while (snapshots_.size() > 1 && snapshots_.back().time_ns >= measurement.time_ns) snapshots_.pop_back();
  current_ = snapshots_.back();
  const std::int64_t from_ns = current_.time_ns;
  for (std::size_t k = 0; k < buffer_.size(); ++k) {
    if (buffer_[k].time_ns <= from_ns) continue;
    const bool is_it = buffer_[k].time_ns == measurement.time_ns && buffer_[k].source == measurement.source;
    const Use use = core_.push(current_, buffer_[k]);
    if (is_it) out.use = use;
    // A copy between two measurements of one time would lose the second, be it still to come.
    const bool last_of_time = k + 1 < buffer_.size() && buffer_[k + 1].time_ns != buffer_[k].time_ns;
    if (last_of_time && seconds(current_.time_ns, snapshots_.back().time_ns) >= kSnapshotInterval_s) take_snapshot();
  }
  return out;
}

Use TargetEstimator::process(const Measurement& measurement) {
  // Taken before a later measurement, so that all of one time are in it.
  if (measurement.time_ns > current_.time_ns &&
      seconds(current_.time_ns, snapshots_.back().time_ns) >= kSnapshotInterval_s) {
    take_snapshot();
  }
  return core_.push(current_, measurement);
}

void TargetEstimator::insert(const Measurement& measurement) {
  buffer_.push_back(measurement);
  for (std::size_t k = buffer_.size() - 1; k > 0 && before(buffer_[k], buffer_[k - 1]); --k) {
    std::swap(buffer_[k], buffer_[k - 1]);
  }
}

void TargetEstimator::take_snapshot() {
  if (snapshots_.full()) drop_oldest_snapshot();
  snapshots_.push_back(current_);
}

// With it go the measurements that only it needs. Where it is the last, the present state takes its place.
void TargetEstimator::drop_oldest_snapshot() {
  for (std::size_t k = 1; k < snapshots_.size(); ++k) snapshots_[k - 1] = snapshots_[k];
  if (snapshots_.size() > 1) {
    snapshots_.pop_back();
  } else {
    snapshots_[0] = current_;
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < buffer_.size(); ++k) {
    if (buffer_[k].time_ns > snapshots_[0].time_ns) buffer_[kept++] = buffer_[k];
  }
  buffer_.resize(kept);
}

}  // namespace pharos::fusion
