// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "pharos/fusion/fusion_core.hpp"

namespace pharos::fusion {
namespace {

constexpr double kLosing_chi2 = 18.4;   // 1 in 10,000: the candidate that explains the measurements this much worse
constexpr double kOutside_chi2 = 30.0;  // what a measurement outside of a candidate's gate counts
constexpr int kMaxRejected = 3;         // in a row, by all candidates: the first pose was wrong

Filter& candidate(FusionState& state, std::size_t k) { return k == 0 ? state.main : state.without[0]; }

std::size_t candidates(const FusionState& state) {
  return static_cast<std::size_t>(state.main.valid()) + static_cast<std::size_t>(state.without[0].valid());
}

}  // namespace

void FusionCore::restart(FusionState& state) const {
  // One that was not believed may begin the next track: without a track nothing can prove it right, or wrong. Of a
  // source that stood still it is known when it is over.
  bool unproved = state.unresolved.active;
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    const SourceMonitor& monitor = state.monitors[s];
    unproved = unproved || (monitor.excluded && monitor.reason != FaultKind::kFreeze && !settings_.sources[s].relative);
  }
  if (unproved) note_unresolved_restart(state);
  state.tracking = false;
  state.lost = true;
  state.main.invalidate();
  for (std::size_t k = 0; k < kMaxSources; ++k) drop_without(state, k);
  state.search = Search{};
  state.suspects = Suspects{};
  for (SourceMonitor& monitor : state.monitors) {
    monitor.contributed = false;
    monitor.excluded = false;
    monitor.gated_run = 0;
    monitor.scattered = 0;
  }
  ++state.counters.restarts;
}

void FusionCore::begin_search(FusionState& state, const Measurement& raw) const {
  state.search = Search{};
  state.main.invalidate();
  state.without[0].invalidate();
  if (settings_.sources[raw.source].relative || raw.directions.rank < 6) return;
  TargetMeasurement m = view(state, raw, nullptr);
  state.main.start(m, settings_, nullptr);
  if (m.second) {
    m.pose = *m.second;
    state.without[0].start(m, settings_, nullptr);
  }
  state.search.accepted = 1;
  state.search.sources = 1U << raw.source;
}

Use FusionCore::search(FusionState& state, const Measurement& raw) const {
  const SourceSettings& source = settings_.sources[raw.source];
  if (source.relative) return Use::kNotUsable;
  if (state.monitors[raw.source].excluded) {
    // Of a track that was refuted: it begins no other one while anything else is heard.
    for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
      const SourceMonitor& other = state.monitors[s];
      if (settings_.sources[s].relative || other.excluded || !other.seen) continue;
      if (seconds(raw.time_ns, other.last_ns) <= settings_.sources[s].silent_after_s) return Use::kExcluded;
    }
    state.monitors[raw.source].excluded = false;
  }
  if (state.search.accepted > 0 && seconds(raw.time_ns, state.time_ns) > settings_.start.window_s) {
    state.search.accepted = 0;
  }
  if (state.search.accepted == 0) {
    begin_search(state, raw);
    return state.search.accepted > 0 ? Use::kSearching : Use::kNotUsable;
  }
  bool accepted = false;
  double best = 1e300;
  for (std::size_t k = 0; k < 2; ++k) {
    Filter& filter = candidate(state, k);
    if (!filter.valid()) continue;
    const TargetMeasurement m = view(state, raw, &filter.mean().pose);
    const bool second = filter.second_fits_better(m, settings_);
    const Innovation own = filter.innovation(m, settings_, second);
    const bool fits = own.ok && own.nis < gate(own.rank);
    const Innovation in = filter.innovation(m.as_one_of_many(), settings_, second);
    state.search.score[k] += fits ? in.nis + in.log_det : kOutside_chi2 + in.log_det;
    best = std::min(best, state.search.score[k]);
    if (fits) filter.correct(in, raw.source, settings_);
    accepted = accepted || fits;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (state.search.score[k] > best + kLosing_chi2) candidate(state, k).invalidate();
  }
  if (!accepted) {
    if (++state.search.rejected_run >= kMaxRejected) begin_search(state, raw);
    return Use::kGated;
  }
  state.search.rejected_run = 0;
  state.search.sources |= 1U << raw.source;
  ++state.search.accepted;
  if (state.search.accepted >= settings_.start.measurements && candidates(state) == 1) begin_track(state, raw.time_ns);
  return Use::kSearching;
}

void FusionCore::begin_track(FusionState& state, std::int64_t time_ns) const {
  if (!state.main.valid()) state.main = state.without[0];
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    SourceMonitor& monitor = state.monitors[s];
    monitor.contributed = (state.search.sources >> s & 1U) != 0;
    if (monitor.contributed) {
      drop_without(state, s);
      monitor.note_used(time_ns);
      monitor.joined_ns = time_ns;
    } else {
      state.without[s] = state.main;
      state.innovation_means[s] = {};
    }
  }
  state.tracking = true;
  state.lost = false;
  state.last_used_ns = time_ns;
}

}  // namespace pharos::fusion
