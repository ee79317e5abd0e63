// SPDX-License-Identifier: Apache-2.0
// The health of RemoteFeed.
#include <fmt/format.h>

#include "host/daemon/remote/remote_feed.hpp"
#include "host/support/time_units.hpp"
#include "pharos/clock_exchange_t.hpp"

namespace pharos::host {
namespace {

// Poses come more slowly or faster than this fraction of what is expected.
constexpr double kTooSlow = 0.5;
constexpr double kTooFast = 1.5;

std::string with_peer(const RemoteConfig& config) {
  return config.daemon.empty() ? config.source : config.source + " of " + config.daemon;
}

// Why messages come and none of them is used.
std::string why_none(const RemoteConfig& config, const RemoteIntake& intake) {
  switch (intake.last()) {
    case RemoteOutcome::poses_foreign:
      return fmt::format("not believed: {} came, expected are {}, {}", intake.foreign(), config.frame, config.feature);
    case RemoteOutcome::poses_without_answer:
      return "its source has no pose: " + intake.refusal();
    case RemoteOutcome::poses_doubtful:
      return "not believed: its poses are flagged uncalibrated, suspect or clock_set";
    case RemoteOutcome::poses_late:
      return fmt::format("not used: its poses are older than {} s when they come", config.max_age_s);
    case RemoteOutcome::poses_ahead:
      return "not believed: its poses are from the future; compare both computers' clocks";
    case RemoteOutcome::poses_no_clock:
      return fmt::format(
          "not used: the clock of {} is not known yet; it needs lcm.answer_clock = true and the same lcm.clock_channel",
          config.daemon);
    default:
      return std::string("not believed: ") + word_of(intake.last());
  }
}

}  // namespace

void RemoteFeed::assess(const Remote& remote, SourceHealth& health, std::int64_t now_ns) {
  const RemoteConfig& config = remote.config;
  const auto silent_ns = static_cast<std::int64_t>(config.silent_after_s * static_cast<double>(kNsPerSecond));
  const auto say = [&health](SourceState state, std::string text) {
    health.state = state;
    health.message = std::move(text);
  };
  const bool doubled =
      remote.intake.series().doubled(now_ns) || (remote.peer != nullptr && remote.peer->doubled(now_ns));
  const std::string other =
      remote.intake.foreign().empty() ? "" : "; " + remote.intake.foreign() + " came there in its place";
  if (!remote.rate.any_data()) {
    say(SourceState::kWaiting, fmt::format("no message of {} on {} yet: does that daemon run, with the same lcm.url "
                                           "and a ttl that reaches this computer?{}",
                                           with_peer(config), config.channel, other));
  } else if (!remote.rate.data_within(silent_ns, now_ns)) {
    say(SourceState::kStale, fmt::format("silent: no message for more than {} s{}", config.silent_after_s, other));
  } else if (doubled) {
    say(SourceState::kError, fmt::format("not believed: two programs send {} on {} under one name; stop one of them",
                                         with_peer(config), config.channel));
  } else if (!remote.rate.pose_within(silent_ns, now_ns)) {
    const bool refused = remote.intake.last() == RemoteOutcome::poses_without_answer;
    say(refused ? SourceState::kStale : SourceState::kError, why_none(config, remote.intake));
  } else {
    health.state = SourceState::kOk;
    if (!(config.rate_hz > 0.0) || !remote.poses.full(now_ns)) return;
    const double rate_hz = static_cast<double>(remote.poses.sum(now_ns).came) / RollingCount::kWindow_s;
    if (rate_hz > kTooSlow * config.rate_hz && rate_hz < kTooFast * config.rate_hz) return;
    say(SourceState::kDegraded, fmt::format("{:.1f} messages a second, expected {:.1f}", rate_hz, config.rate_hz));
  }
}

SourceHealth RemoteFeed::health_of(Remote& remote, std::int64_t now_ns) const {
  SourceHealth health;
  health.source = "remote/" + remote.config.name;
  health.target = remote.config.target;
  health.device = remote.config.channel;
  health.identity = with_peer(remote.config);
  health.counters = remote.intake.counts();
  if (remote.peer != nullptr) {
    const PeerClock& peer = *remote.peer;
    health.clock_sigma_ns = static_cast<double>(peer.relation().sigma_ns());
    health.clock_drift_ppm = peer.relation().drift_ppm();
    const NamedCounts clock{{"clock.asked", peer.asked()},
                            {"clock.answered", peer.answered()},
                            {"clock.refused", peer.refused()},
                            {"clock.contradictions", peer.relation().contradictions()},
                            {"clock.steps", peer.relation().steps()},
                            {"clock.restarts", peer.restarts()},
                            {"clock.round_trip_us", peer.relation().round_trip_ns() / kNsPerUs}};
    health.counters.insert(health.counters.end(), clock.begin(), clock.end());
  } else {
    health.clock_sigma_ns = remote.config.clock_sigma_s.value_or(0.0) * static_cast<double>(kNsPerSecond);
  }
  assess(remote, health, now_ns);
  return health;
}

std::vector<SourceHealth> RemoteFeed::health() {
  const std::int64_t now_ns = context_.clock.monotonic_ns();
  std::vector<SourceHealth> out;
  for (const auto& remote : remotes_) {
    out.push_back(health_of(*remote, now_ns));
    remote->rate.report(out.back(), now_ns);
  }
  return out;
}

// Each change is told once, in the log and at once by a status.
void RemoteFeed::attend() {
  const std::int64_t now_ns = context_.clock.monotonic_ns();
  bool changed = false;
  for (const auto& remote : remotes_) {
    const SourceHealth health = health_of(*remote, now_ns);
    const std::string told = std::string(name_of(health.state)) + (health.message.empty() ? "" : ": " + health.message);
    if (told == remote->told) continue;
    const bool same_state = remote->told.starts_with(name_of(health.state));
    remote->told = told;
    if (same_state && health.state == SourceState::kDegraded) continue;  // only the rate in its text
    const bool good = health.state == SourceState::kOk || health.state == SourceState::kWaiting;
    good ? remote->log.info("state", told, now_ns) : remote->log.warn("state", told, now_ns);
    changed = true;
  }
  if (changed) context_.on_state_change();
}

}  // namespace pharos::host
