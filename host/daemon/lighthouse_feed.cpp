// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/lighthouse_feed.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "host/daemon/port_feed.hpp"
#include "host/daemon/replay_feed.hpp"
#include "host/record/recording_file.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {
namespace {

/// The calibrations that all targets share: read at the start, written at the attend timer. A source without
/// measurements.
class CalibrationKeeper final : public Source {
 public:
  explicit CalibrationKeeper(const SourceContext& context)
      : clock_(context.clock), memory_(context.config.state_directory) {
    // An unreadable file is only logged: stations send their calibrations again within seconds.
    try {
      memory_.load();
    } catch (const InputError& error) {
      spdlog::warn("remembered calibrations are not used: {}", error.what());
    }
  }
  CalibrationMemory& memory() { return memory_; }

  const std::string& name() const override { return name_; }
  void attend() override { memory_.save(clock_.monotonic_ns()); }
  void stop() override { memory_.save_at_last(); }
  std::vector<SourceHealth> health() override { return {}; }
  bool finished() const override { return true; }
  StorageError storage_error() const override { return {"calibrations", memory_.error()}; }
  NamedCounts daemon_counters() const override {
    return {{"calibrations.kept", static_cast<std::int64_t>(memory_.stations().size())},
            {"calibrations.dropped", memory_.counters().dropped},
            {"calibrations.damaged_files", memory_.counters().damaged_files},
            {"calibrations.write_failures", memory_.counters().write_failures}};
  }

 private:
  const Clock& clock_;
  std::string name_ = "calibrations";
  CalibrationMemory memory_;
};

}  // namespace

LighthouseFeed::LighthouseFeed(const SourceContext& context, const TargetConfig& config, CalibrationMemory& memory)
    : context_(context), name_(config.name) {
  const DaemonConfig& daemon = context.config;
  if (daemon.recording && !config.is_replay()) {
    recorder_.emplace(RecorderOptions{daemon.recording->directory, config.name, config.baud,
                                      daemon.recording->rotate_bytes, daemon.recording->rotate_s});
  }
  bytes_ = open(config);
  const std::string source = "lighthouse/" + daemon.source + (config.is_replay() ? "/replay" : "");
  pipeline_.emplace(config, daemon.publish, source, context.publisher, context.clock, memory, bytes_->baud());
}

std::unique_ptr<ByteFeed> LighthouseFeed::open(const TargetConfig& config) {
  ByteFeedEvents events;
  events.bytes = [this](std::span<const std::uint8_t> bytes, const Arrival& arrival) { on_bytes(bytes, arrival); };
  events.lost = [this] { pipeline_->line_lost(); };
  events.finished = [this] {
    pipeline_->end_of_input();
    context_.on_finished();
  };
  if (config.is_replay()) {
    return std::make_unique<ReplayFeed>(context_.loop, *context_.replay, config.name,
                                        recording_files(config.replay_file(), config.name, kStreamSuffix),
                                        std::move(events));
  }
  return std::make_unique<PortFeed>(context_.loop, context_.clock, config.name, config.port, config.baud,
                                    std::move(events));
}

// Poses are published before the bytes are recorded, for the lowest latency.
void LighthouseFeed::on_bytes(std::span<const std::uint8_t> bytes, const Arrival& arrival) {
  pipeline_->push(bytes, arrival);
  if (recorder_) recorder_->append(bytes, arrival.utc_ns, arrival.monotonic_ns);
}

void LighthouseFeed::reconfigure() {
  pipeline_->set_publish(context_.config.publish);
  for (const TargetConfig& target : context_.config.targets) {
    if (target.name == name_) pipeline_->recalibrate(target);
  }
}

void LighthouseFeed::attend() {
  bytes_->attend(context_.clock.monotonic_ns());
  if (pipeline_->state_changed(bytes_->monotonic_now())) context_.on_state_change();
}

std::vector<SourceHealth> LighthouseFeed::health() {
  SourceHealth health = pipeline_->health(bytes_->device(), bytes_->state(), bytes_->error(), bytes_->monotonic_now());
  NamedCounts& counts = health.counters;
  const NamedCounts of_bytes = bytes_->counters();
  counts.insert(counts.end(), of_bytes.begin(), of_bytes.end());
  if (recorder_) {
    const RecorderCounters& recorded = recorder_->counters();
    counts.push_back({"recording.bytes", static_cast<std::int64_t>(recorded.bytes_recorded)});
    counts.push_back({"recording.bytes_lost", static_cast<std::int64_t>(recorded.bytes_lost)});
    counts.push_back({"recording.files", static_cast<std::int64_t>(recorded.files)});
    counts.push_back({"recording.failures", static_cast<std::int64_t>(recorded.failures)});
  }
  return {std::move(health)};
}

StorageError LighthouseFeed::storage_error() const {
  return {"recording", recorder_ ? recorder_->error() : std::string()};
}

std::size_t open_target_feeds(const SourceContext& context, SourceList& sources) {
  auto keeper = std::make_unique<CalibrationKeeper>(context);
  CalibrationMemory& memory = keeper->memory();
  for (const TargetConfig& target : context.config.targets) {
    sources.push_back(std::make_unique<LighthouseFeed>(context, target, memory));
  }
  sources.push_back(std::move(keeper));
  return context.config.targets.size();
}

}  // namespace pharos::host
