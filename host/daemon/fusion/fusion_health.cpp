// SPDX-License-Identifier: Apache-2.0
// The health of FusionFeed.
#include <array>

#include "host/daemon/fusion/fusion_feed.hpp"
#include "host/daemon/health_parts.hpp"
#include "host/support/time_units.hpp"
#include "pharos/fusion/words.hpp"

namespace pharos::host {
namespace {

// Words of fusion::Refusal, in its order.
constexpr std::array<const char*, static_cast<std::size_t>(fusion::Refusal::kCount)> kRefusalWords = {
    "none", "unknown_source", "not_finite", "covariance", "time_goes_back", "time_ahead", "too_late"};

std::string joined(const std::string& a, const std::string& b) { return a.empty() ? b : a + ", " + b; }

// Names of the sources in a state, with the reason of an exclusion.
std::string sources_in(const fusion::TargetState& state, const std::vector<std::string>& names,
                       fusion::SourceState wanted) {
  std::string text;
  for (std::size_t s = 0; s < state.sources.size(); ++s) {
    if (state.sources[s].state != wanted) continue;
    const bool excluded = wanted == fusion::SourceState::kExcluded;
    text = joined(text, names[s] + (excluded ? std::string(" (") + word_of(state.sources[s].reason) + ')' : ""));
  }
  return text;
}

}  // namespace

std::vector<SourceHealth> FusionFeed::health() {
  const std::int64_t now_ns = context_.clock.monotonic_ns();
  SourceHealth health;
  health.source = source_;
  health.target = config_.target;
  health.device = config_.mounting_file.string();
  health.identity = std::string("mode ") + word_of(last_ ? last_->state.mode : fusion::Mode::kSearching);
  rate_.report(health, now_ns);
  health.counters = counts();
  assess(health, now_ns);
  return {health};
}

void FusionFeed::assess(SourceHealth& health, std::int64_t now_ns) const {
  using fusion::Mode;
  if (!intake_.error().empty()) {
    health.state = SourceState::kError;
    health.message = intake_.error();
    return;
  }
  health.state = SourceState::kWaiting;
  if (!rate_.any_data()) {
    health.message = "no pose of a fused source came yet";
    return;
  }
  const fusion::TargetState& state = last_ ? last_->state : fusion::TargetState{};
  switch (state.mode) {
    case Mode::kSearching:
      health.message = "no pose is confirmed by the next ones yet";
      return;
    case Mode::kSingle:
    case Mode::kFused: {
      const std::string excluded = sources_in(state, stage_.names(), fusion::SourceState::kExcluded);
      health.state = excluded.empty() ? SourceState::kOk : SourceState::kDegraded;
      if (!excluded.empty()) health.message = "not believed: " + excluded;
      break;
    }
    case Mode::kConflict: {
      const std::string sources = sources_in(state, stage_.names(), fusion::SourceState::kConflict);
      health.state = SourceState::kDegraded;
      health.message = sources.empty()
                           ? "a source contradicts the track, and no second one tells which of them is wrong"
                           : sources + " contradict each other, and nothing tells which is wrong";
      break;
    }
    case Mode::kCoasting:
      health.state = SourceState::kStale;
      health.message = "no source measures the target: its state is predicted";
      break;
    case Mode::kLost:
      health.state = SourceState::kStale;
      health.message = "the target is lost: no source that is believed measures it";
      return;
  }
  if (recorded_ || now_ns - last_ns_ <= kSilence_ns) return;
  health.state = SourceState::kError;
  health.message = "the estimator does not answer";
}

NamedCounts FusionFeed::counts() const {
  NamedCounts out = named_counts(intake_.counters());
  out.push_back({"poses_dropped", poses_dropped_});
  out.push_back({"poses_late", poses_late_});
  for (std::size_t reason = 1; reason < kRefusalWords.size(); ++reason) {
    out.push_back({std::string("refused.") + kRefusalWords[reason], refused_[reason]});
  }
  const fusion::FusionCounters core = last_ ? last_->counters : fusion::FusionCounters{};
  const auto count = [&](const char* name, std::uint64_t value) {
    out.push_back({name, static_cast<std::int64_t>(value)});
  };
  count("poses_used", core.used);
  count("poses_gated", core.gated);
  count("poses_ambiguous", core.ambiguous);
  count("exclusions", core.exclusions);
  count("readmissions", core.readmissions);
  count("conflicts", core.conflicts);
  count("hand_overs", core.hand_overs);
  count("limited_steps", core.limited_steps);
  count("tracks_lost", core.restarts);
  count("tracks_refuted", core.refuted);
  count("contradictions_unresolved", core.unresolved);
  out.push_back({"restarts", last_ ? last_->restarts : 0});
  out.push_back({"looks_dropped", looks_dropped_});
  out.push_back({"states_stale", stale_});
  out.push_back({"states_not_finite", not_finite_});
  out.push_back({"internal_errors", faults_});
  add_times(out, "waiting", waiting_);
  add_times(out, "measurement", in_order_);
  add_times(out, "late_measurement", late_);
  return out;
}

}  // namespace pharos::host
