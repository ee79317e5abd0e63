// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/daemon.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "host/config/live_changes.hpp"
#include "host/runtime/process_usage.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

// Ports limit their own attempts to two per second.
constexpr std::chrono::milliseconds kAttendPeriod{100};
// The configuration is read again at most so often, whatever number of SIGHUP comes: reading takes milliseconds, and
// poses wait for it.
constexpr std::int64_t kRereadPeriod_ns = 500'000'000;
constexpr std::int64_t kLogPeriod_ns = 10'000'000'000;
constexpr std::int64_t kNsPerMs = 1'000'000;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

Daemon::Daemon(const DaemonConfig& config, MessageSink& sink, Signals& signals, ReplaySpeed replay_speed,
               const Clock& clock, const SourceKinds& kinds, DaemonControl control)
    : config_(config),
      control_(std::move(control)),
      signals_(signals),
      clock_(clock),
      publisher_(sink, config.lcm.channel_prefix),
      previews_(loop_, publisher_, config_.publish, clock),
      log_limit_(kLogPeriod_ns),
      context_{loop_,
               clock,
               publisher_,
               config_,
               replay_speed,
               [this] { stop_when_all_finished(); },
               [this] { publish_health(); }},
      started_ns_(clock.monotonic_ns()),
      last_reread_ns_(started_ns_ - kRereadPeriod_ns) {
  context_.previews = &previews_;
  for (const SourceRegistration& kind : kinds) counts_.emplace_back(kind.noun, kind.open(context_, sources_));
  loop_.watch(signals_.fd(), [this] { on_signal(); });
  loop_.watch(reread_timer_.fd(), [this] { reread_config(); });
  loop_.watch(attend_timer_.fd(), [this] { attend(); });
  loop_.watch(status_timer_.fd(), [this] { publish_health(); });
}

void Daemon::stop_when_all_finished() {
  if (std::all_of(sources_.begin(), sources_.end(), [](const auto& source) { return source->finished(); })) {
    loop_.stop();
  }
}

// The first kind is always named, even with a count of 0; the others in alphabetical order if there are any.
std::string Daemon::sources_text() const {
  auto counts = counts_;
  if (counts.empty()) return "no source";
  std::sort(counts.begin() + 1, counts.end());
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto& [noun, count] = counts[i];
    if (i > 0 && count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
  }
  return text;
}

void Daemon::run() {
  attend_timer_.start({}, kAttendPeriod);
  start_status_timer();
  spdlog::info("pharosd {} started, {}", PHAROS_VERSION, sources_text());
  loop_.run();
  for (const auto& source : sources_) source->stop();
  message_ = "stopped";
  publish_health();
  spdlog::info("stopped");
}

void Daemon::start_status_timer() {
  status_timer_.start_every(std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(config_.publish.status_period_s)));
}

void Daemon::attend() {
  attend_timer_.take_expiries();
  const std::int64_t now_ns = clock_.monotonic_ns();
  for (const auto& source : sources_) source->attend();
  for (const auto& source : sources_) {
    const StorageError error = source->storage_error();
    warn(error.what, error.text, now_ns);
  }
  const std::int64_t failed = publisher_.counters().failed;
  if (failed > last_logged_failed_ && log_limit_.pass("lcm", now_ns)) {
    spdlog::warn("{} messages could not be sent over LCM: is there still a route for multicast?",
                 failed - last_logged_failed_);
    last_logged_failed_ = failed;
  }
}

void Daemon::warn(const char* kind, const std::string& text, std::int64_t now_ns) {
  if (!text.empty() && log_limit_.pass(kind, now_ns)) spdlog::warn("{}", text);
}

// One signal a turn of the loop: where signals come faster than they are taken, poses must have their turn.
void Daemon::on_signal() {
  const std::optional<int> signal = signals_.take();
  if (!signal) return;
  if (*signal != SIGHUP) {
    control_.on_stop();
    loop_.stop();
    spdlog::info("{} received", ::strsignal(*signal));
    return;
  }
  if (reread_asked_) return;
  reread_asked_ = true;
  const std::int64_t wait_ns = last_reread_ns_ + kRereadPeriod_ns - clock_.monotonic_ns();
  reread_timer_.start(std::chrono::nanoseconds(std::max<std::int64_t>(0, wait_ns)));
}

// After an error in the file the daemon continues with its current configuration.
void Daemon::reread_config() try {
  reread_timer_.take_expiries();
  reread_asked_ = false;  // a signal from here on asks again: the file may change while it is read
  last_reread_ns_ = clock_.monotonic_ns();
  spdlog::info("{} received", ::strsignal(SIGHUP));
  const std::optional<DaemonConfig> fresh = control_.reread();
  if (!fresh) return;
  const double status_period_s = config_.publish.status_period_s;
  const std::vector<std::string> not_taken = take_live_changes(*fresh, config_);
  control_.renew_log(config_.log);
  for (const auto& source : sources_) source->reconfigure();
  if (config_.publish.status_period_s != status_period_s) start_status_timer();  // else a status that is due is put off
  spdlog::info(
      "configuration read again: the log's level, [publish], vehicle.rate_hz and calibrations of targets are in use; "
      "camera and rig "
      "files are read at the start only");
  for (const std::string& line : not_taken) spdlog::warn("needs a restart: {}", line);
} catch (const InputError& error) {
  spdlog::error("configuration not read again: {}", error.what());
}

// The most important error that is not part of a source's health; empty if there is none.
std::string Daemon::error() const {
  if (!message_.empty()) return message_;
  for (const auto& source : sources_) {
    const std::string notice = source->clock_notice();
    if (!notice.empty()) return source->name() + ": " + notice;
  }
  for (const auto& source : sources_) {
    const StorageError error = source->storage_error();
    if (!error.text.empty()) return error.text;
  }
  return "";
}

void Daemon::publish_health() {
  status_timer_.take_expiries();
  DaemonHealth health;
  health.utc_ns = clock_.utc_ns();
  health.uptime_ns = clock_.monotonic_ns() - started_ns_;
  health.host = host_name();
  health.version = PHAROS_VERSION;
  health.message = error();
  health.counters = named_counts();
  for (const auto& source : sources_) {
    for (SourceHealth& system : source->health()) {
      spdlog::debug("{}: {}, data {} ms old, pose {} ms old, {:.1f} poses/s{}{}", system.source, name_of(system.state),
                    system.data_age_ns / kNsPerMs, system.pose_age_ns / kNsPerMs, system.pose_rate_hz,
                    system.message.empty() ? "" : ": ", system.message);
      health.sources.push_back(std::move(system));
    }
  }
  publisher_.publish_health(health);
}

NamedCounts Daemon::named_counts() const {
  const PublishCounters& sent = publisher_.counters();
  const ProcessUsage usage = process_usage();
  NamedCounts counts{
      {"published_poses", sent.poses}, {"published_bearings", sent.bearings}, {"published_pointings", sent.pointings},
      {"published_spins", sent.spins}, {"published_states", sent.states},     {"published_status", sent.status},
      {"published_clock", sent.clock}, {"published_bytes", sent.bytes},       {"publish_failures", sent.failed}};
  const NamedCounts previews = previews_.named_counts();
  counts.insert(counts.end(), previews.begin(), previews.end());
  for (const auto& source : sources_) {
    const NamedCounts own = source->daemon_counters();
    counts.insert(counts.end(), own.begin(), own.end());
  }
  counts.push_back({"log_lines_dropped", control_.log_lines_dropped()});
  counts.push_back({"process_cpu_us", usage.cpu_us});
  counts.push_back({"process_resident_kib", usage.resident_kib});
  return counts;
}

}  // namespace pharos::host
