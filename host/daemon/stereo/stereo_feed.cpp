// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/stereo_feed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/daemon/stereo/camera_pairs.hpp"
#include "host/daemon/stereo/recorded_pairs.hpp"
#include "host/daemon/stereo/ring2_estimator.hpp"
#include "host/daemon/stereo/slam_estimator.hpp"
#include "host/device/gige_module.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

std::unique_ptr<PairSource> source_of(const StereoConfig& config, bool fastest) {
  if (!config.is_recorded()) {
    return std::make_unique<CameraPairs>(
        CameraPairs::Cameras{open_gige_source(config.devices[0]), open_gige_source(config.devices[1])},
        std::llround(config.pairing_window_s * 1e9));
  }
  RecordedPairs::Options options;
  options.fastest = fastest;
  if (config.devices[0].frame_rate_hz > 0.0) options.rate_hz = config.devices[0].frame_rate_hz;
  for (std::size_t side = 0; side < config.devices.size(); ++side) {
    options.sizes_px[side] = {config.devices[side].width_px, config.devices[side].height_px};
  }
  return std::make_unique<RecordedPairs>(config.frames.string(), options);
}

}  // namespace

StereoFeed::StereoFeed(EventLoop& loop, const StereoConfig& config, const PublishConfig& publish, Publisher& publisher,
                       bool fastest, std::function<void()> finished)
    : loop_(loop),
      name_(config.name),
      state_log_(config.name),
      source_(source_of(config, fastest)),
      finished_(std::move(finished)) {
  if (config.ring2) add_system(config, publish, "ring2/", publisher, std::make_unique<Ring2Estimator>(config.rig));
  if (config.slam) add_system(config, publish, "slam/", publisher, std::make_unique<SlamEstimator>(config));
  for (const int fd : source_->fds()) loop_.watch(fd, [this] { on_readable(); });
}

StereoFeed::~StereoFeed() {
  for (const int fd : source_->fds()) loop_.forget(fd);
  for (const auto& system : systems_) loop_.forget(system->worker.fd());
}

void StereoFeed::add_system(const StereoConfig& config, const PublishConfig& publish, const char* word,
                            Publisher& publisher, std::unique_ptr<PairEstimator> estimator) {
  systems_.push_back(std::unique_ptr<System>(
      new System{StereoPipeline(config, publish, word + config.name, publisher), pair_worker(std::move(estimator))}));
  System& system = *systems_.back();
  loop_.watch(system.worker.fd(), [this, &system] { on_results(system); });
}

void StereoFeed::on_readable() {
  if (StereoPairPtr pair = source_->take()) {
    for (const auto& system : systems_) {
      if (!system->line.take(*pair)) continue;
      if (auto discarded = system->worker.post(pair)) {
        system->line.dropped();
        release(std::move(*discarded));
      }
    }
    release(std::move(pair));
  }
  report_when_finished();
}

void StereoFeed::on_results(System& system) {
  while (auto done = system.worker.take()) {
    system.line.done(*done, !source_->clock_notice(monotonic_now_ns()).empty());
    release(std::move(done->job));
  }
  report_when_finished();
}

// Pairs are held by the loop's thread and by workers that give them back to it: the last holder is always here.
void StereoFeed::release(StereoPairPtr pair) {
  if (pair.use_count() == 1) source_->recycle(std::move(pair));
}

void StereoFeed::report_when_finished() {
  if (finish_reported_ || !source_->status().finished) return;
  finish_reported_ =
      std::all_of(systems_.begin(), systems_.end(), [](const auto& system) { return system->worker.idle(); });
  if (finish_reported_) finished_();
}

void StereoFeed::attend(std::int64_t monotonic_ns) {
  state_log_.update(source_->device(), source_->status(), monotonic_ns);
}

std::vector<SourceHealth> StereoFeed::health(std::int64_t monotonic_ns) {
  std::vector<SourceHealth> all;
  const PairSourceStatus status = source_->status();
  for (const auto& system : systems_) {
    all.push_back(system->line.health(source_->device(), status, monotonic_ns));
  }
  return all;
}

}  // namespace pharos::host
