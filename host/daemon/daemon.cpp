// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/daemon.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include "host/daemon/port_feed.hpp"
#include "host/runtime/now.hpp"
#include "host/runtime/process_usage.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

// Ports are tried again at their own pace, twice a second.
constexpr std::chrono::milliseconds kAttendPeriod{100};
constexpr std::int64_t kLogPeriod_ns = 10'000'000'000;

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

/// One target: where its bytes come from, where they are kept, what they become.
struct Daemon::Channel {
  std::string name;
  std::optional<StreamRecorder> recorder;
  std::unique_ptr<LighthousePipeline> line;
  std::unique_ptr<ByteFeed> feed;
};

Daemon::Daemon(const DaemonConfig& config, MessageSink& sink, Signals& signals, ReplaySpeed replay_speed)
    : config_(config),
      signals_(signals),
      publisher_(sink, config.lcm.channel_prefix),
      memory_(config.state_directory),
      log_limit_(kLogPeriod_ns),
      started_ns_(monotonic_now_ns()) {
  load_memory();
  for (const TargetConfig& target : config_.targets) add_channel(target, replay_speed);
  for (const TofConfig& camera : config_.cameras) add_camera(camera, replay_speed);
  for (const PointingConfig& telescope : config_.telescopes) {
    telescopes_.push_back(std::make_unique<PointingFeed>(loop_, telescope, publisher_));
  }
  for (const StereoConfig& stereo : config_.stereos) {
    stereos_.push_back(std::make_unique<StereoFeed>(loop_, stereo, config_.publish, publisher_,
                                                    replay_speed == ReplaySpeed::kFastest,
                                                    [this] { stop_when_all_ended(); }));
  }
  loop_.watch(signals_.fd(), [this] { on_signal(); });
  loop_.watch(attend_timer_.fd(), [this] { attend(); });
  loop_.watch(status_timer_.fd(), [this] { publish_health(); });
}

Daemon::~Daemon() = default;

// What cannot be read is worth a word, not a stop: stations tell it all again within seconds.
void Daemon::load_memory() {
  try {
    memory_.load();
  } catch (const InputError& error) {
    spdlog::warn("remembered calibrations are not used: {}", error.what());
  }
}

void Daemon::add_channel(const TargetConfig& target, ReplaySpeed replay_speed) {
  channels_.push_back(std::make_unique<Channel>());
  Channel& channel = *channels_.back();
  channel.name = target.name;
  if (config_.recording && !target.is_replay()) {
    channel.recorder.emplace(RecorderOptions{config_.recording->directory, target.name, target.baud,
                                             config_.recording->rotate_bytes, config_.recording->rotate_s});
  }
  channel.feed = make_feed(target, replay_speed, channel);
  int baud = target.baud;
  if (target.is_replay()) baud = static_cast<int>(static_cast<const ReplayFeed&>(*channel.feed).header().baud);
  const std::string source = "lighthouse/" + config_.source + (target.is_replay() ? "/replay" : "");
  channel.line = std::make_unique<LighthousePipeline>(target, config_.publish, source, publisher_, memory_, baud);
}

void Daemon::add_camera(const TofConfig& camera, ReplaySpeed replay_speed) {
  cameras_.push_back(std::make_unique<TofFeed>(loop_, camera, config_.publish, publisher_,
                                               replay_speed == ReplaySpeed::kFastest,
                                               [this] { stop_when_all_ended(); }));
}

void Daemon::stop_when_all_ended() {
  const auto ended = [](const auto& any) { return any->finished(); };
  const auto replayed = [](const auto& any) { return any->feed->finished(); };
  if (telescopes_.empty() && std::all_of(channels_.begin(), channels_.end(), replayed) &&
      std::all_of(cameras_.begin(), cameras_.end(), ended) && std::all_of(stereos_.begin(), stereos_.end(), ended)) {
    loop_.stop();
  }
}

std::unique_ptr<ByteFeed> Daemon::make_feed(const TargetConfig& target, ReplaySpeed replay_speed, Channel& channel) {
  ByteFeedEvents events;
  // Poses first: they are what somebody waits for.
  events.bytes = [&channel](std::span<const std::uint8_t> bytes, const Arrival& arrival) {
    channel.line->push(bytes, arrival);
    if (channel.recorder) channel.recorder->append(bytes, arrival.utc_ns, arrival.monotonic_ns);
  };
  events.lost = [&channel] { channel.line->line_lost(); };
  events.finished = [this, &channel] {
    channel.line->end_of_input();
    stop_when_all_ended();
  };
  if (target.is_replay()) {
    return std::make_unique<ReplayFeed>(loop_, target.name, target.replay_file().string(), replay_speed,
                                        std::move(events));
  }
  return std::make_unique<PortFeed>(loop_, target.name, target.port, target.baud, std::move(events));
}

void Daemon::run() {
  attend_timer_.start({}, kAttendPeriod);
  status_timer_.start_every(std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(config_.publish.status_period_s)));
  const std::string cameras = cameras_.empty() ? "" : ", " + counted(cameras_.size(), "camera");
  const std::string rigs = stereos_.empty() ? "" : ", " + counted(stereos_.size(), "stereo rig");
  const std::string domes = telescopes_.empty() ? "" : ", " + counted(telescopes_.size(), "telescope");
  spdlog::info("pharosd {} started, {}{}{}{}", PHAROS_VERSION, counted(channels_.size(), "target"), cameras, rigs,
               domes);
  loop_.run();
  memory_.save_at_last();
  message_ = "stopped";
  publish_health();
  spdlog::info("stopped");
}

void Daemon::attend() {
  attend_timer_.take_expiries();
  const std::int64_t now_ns = monotonic_now_ns();
  for (const auto& channel : channels_) channel->feed->attend(now_ns);
  for (const auto& camera : cameras_) camera->attend(now_ns);
  for (const auto& telescope : telescopes_) telescope->attend(now_ns);
  for (const auto& stereo : stereos_) stereo->attend(now_ns);
  // Poses first, files when no bytes are in hand.
  memory_.save(now_ns);
  warn("calibrations", memory_.error(), now_ns);
  warn("recording", recording_error(), now_ns);
  const std::int64_t failed = publisher_.counters().failed;
  if (failed > failures_logged_ && log_limit_.pass("lcm", now_ns)) {
    spdlog::warn("{} messages could not be sent over LCM: is there still a route for multicast?",
                 failed - failures_logged_);
    failures_logged_ = failed;
  }
}

void Daemon::warn(const char* kind, const std::string& error, std::int64_t now_ns) {
  if (!error.empty() && log_limit_.pass(kind, now_ns)) spdlog::warn("{}", error);
}

void Daemon::on_signal() {
  while (const auto signal = signals_.take()) spdlog::info("{} received", ::strsignal(*signal));
  loop_.stop();
}

std::string Daemon::recording_error() const {
  for (const auto& channel : channels_) {
    if (channel->recorder && !channel->recorder->error().empty()) return channel->recorder->error();
  }
  return "";
}

// What is wrong beside the sources, the first thing first; empty when nothing is.
std::string Daemon::error() const {
  if (!message_.empty()) return message_;
  for (const auto& channel : channels_) {
    const std::string notice = channel->line->clock_notice(channel->feed->monotonic_now());
    if (!notice.empty()) return channel->name + ": " + notice;
  }
  for (const auto& camera : cameras_) {
    const std::string notice = camera->clock_notice(monotonic_now_ns());
    if (!notice.empty()) return camera->name() + ": " + notice;
  }
  for (const auto& stereo : stereos_) {
    const std::string notice = stereo->clock_notice(monotonic_now_ns());
    if (!notice.empty()) return stereo->name() + ": " + notice;
  }
  const std::string recording = recording_error();
  return recording.empty() ? memory_.error() : recording;
}

void Daemon::publish_health() {
  status_timer_.take_expiries();
  DaemonHealth health;
  health.utc_ns = utc_now_ns();
  health.uptime_ns = monotonic_now_ns() - started_ns_;
  health.host = host_name();
  health.version = PHAROS_VERSION;
  health.message = error();
  health.counters = named_counts();
  for (const auto& channel : channels_) {
    const ByteFeed& feed = *channel->feed;
    health.sources.push_back(channel->line->health(feed.device(), feed.state(), feed.error(), feed.monotonic_now()));
    NamedCounts& counts = health.sources.back().counters;
    const NamedCounts of_feed = feed.counters();
    counts.insert(counts.end(), of_feed.begin(), of_feed.end());
    if (!channel->recorder) continue;
    const RecorderCounters& recorded = channel->recorder->counters();
    counts.push_back({"recording.bytes", static_cast<std::int64_t>(recorded.bytes_recorded)});
    counts.push_back({"recording.bytes_lost", static_cast<std::int64_t>(recorded.bytes_lost)});
    counts.push_back({"recording.files", static_cast<std::int64_t>(recorded.files)});
    counts.push_back({"recording.failures", static_cast<std::int64_t>(recorded.failures)});
  }
  for (const auto& camera : cameras_) health.sources.push_back(camera->health(monotonic_now_ns()));
  for (const auto& telescope : telescopes_) health.sources.push_back(telescope->health(monotonic_now_ns()));
  for (const auto& stereo : stereos_) {
    for (SourceHealth& system : stereo->health(monotonic_now_ns())) health.sources.push_back(std::move(system));
  }
  publisher_.publish_health(health);
}

NamedCounts Daemon::named_counts() const {
  const PublishCounters& sent = publisher_.counters();
  const ProcessUsage usage = process_usage();
  return {{"published_poses", sent.poses},
          {"published_bearings", sent.bearings},
          {"published_pointings", sent.pointings},
          {"published_spins", sent.spins},
          {"published_status", sent.status},
          {"published_bytes", sent.bytes},
          {"publish_failures", sent.failed},
          {"calibrations.kept", static_cast<std::int64_t>(memory_.stations().size())},
          {"calibrations.dropped", memory_.counters().dropped},
          {"calibrations.write_failures", memory_.counters().write_failures},
          {"process_cpu_us", usage.cpu_us},
          {"process_resident_kib", usage.resident_kib}};
}

}  // namespace pharos::host
