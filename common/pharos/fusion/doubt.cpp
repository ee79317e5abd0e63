// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/fusion_core.hpp"

namespace pharos::fusion {

// The only source that tells the whole pose contradicts the track. As long as the track stands it is enough that the
// source agrees with it again.
void FusionCore::doubt_track(FusionState& state, std::uint8_t source) const {
  if (!state.doubt.active) ++state.counters.doubts;
  const bool restarted = state.doubt.active && state.doubt.restarted;
  state.doubt = Doubt{true, restarted, source, state.time_ns};
}

// What begins now may rest on a source that contradicted what was known before.
void FusionCore::note_restart_in_doubt(FusionState& state) const {
  if (!state.doubt.active) ++state.counters.doubts;
  state.doubt = Doubt{true, true, 0, state.time_ns};
}

void FusionCore::restart_in_doubt(FusionState& state) const {
  note_restart_in_doubt(state);
  restart(state);
}

// It ends where two sources have agreed for as long as a readmission takes, where the source agrees again with a track
// that never held what it contradicted, or by time.
void FusionCore::examine_doubt(FusionState& state) const {
  const double since_s = seconds(state.time_ns, state.doubt.since_ns);
  if (since_s < settings_.detection.proof_s) return;
  int agreeing = 0;
  bool source_agrees = false;
  for (std::size_t s = 0; s < settings_.sources.size(); ++s) {
    const SourceMonitor& monitor = state.monitors[s];
    if (settings_.sources[s].relative || monitor.excluded || !monitor.contributed || monitor.last_gated) continue;
    if (seconds(state.time_ns, monitor.last_used_ns) > settings_.sources[s].silent_after_s) continue;
    if (seconds(state.time_ns, monitor.joined_ns) < settings_.detection.proof_s) continue;
    ++agreeing;
    source_agrees = source_agrees || s == state.doubt.source;
  }
  const bool confirmed = state.doubt.restarted ? agreeing > 1 : source_agrees;
  if (confirmed || since_s > settings_.detection.doubt_s) state.doubt = Doubt{};
}

}  // namespace pharos::fusion
