// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/fusion_core.hpp"

namespace pharos::fusion {

// The only source that tells the whole pose contradicts the track. As long as the track stands it is enough that the
// source agrees with it again.
void FusionCore::mark_unresolved(FusionState& state, std::uint8_t source) const {
  if (!state.unresolved.active) ++state.counters.unresolved;
  const bool restarted = state.unresolved.active && state.unresolved.restarted;
  state.unresolved = Unresolved{true, restarted, source, state.time_ns};
}

// What begins now may rest on a source that contradicted what was known before.
void FusionCore::note_unresolved_restart(FusionState& state) const {
  if (!state.unresolved.active) ++state.counters.unresolved;
  state.unresolved = Unresolved{true, true, 0, state.time_ns};
}

void FusionCore::restart_unresolved(FusionState& state) const {
  note_unresolved_restart(state);
  restart(state);
}

// It ends where two sources have agreed for as long as a readmission takes, where the source agrees again with a track
// that never held what it contradicted, or by time.
void FusionCore::examine_unresolved(FusionState& state) const {
  const double since_s = seconds(state.time_ns, state.unresolved.since_ns);
  if (since_s < settings_.detection.proof_s) return;
  int agreeing = 0;
  bool source_agrees = false;
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    const SourceMonitor& monitor = state.monitors[s];
    if (settings_.sources[s].relative || monitor.excluded || !monitor.contributed || monitor.last_gated) continue;
    if (seconds(state.time_ns, monitor.last_used_ns) > settings_.sources[s].silent_after_s) continue;
    if (seconds(state.time_ns, monitor.joined_ns) < settings_.detection.proof_s) continue;
    ++agreeing;
    source_agrees = source_agrees || s == state.unresolved.source;
  }
  const bool confirmed = state.unresolved.restarted ? agreeing > 1 : source_agrees;
  if (confirmed || since_s > settings_.detection.unresolved_s) state.unresolved = Unresolved{};
}

}  // namespace pharos::fusion
