// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/stereo_feed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/daemon/camera_input.hpp"
#include "host/daemon/stereo/camera_pairs.hpp"
#include "host/daemon/stereo/recorded_pairs.hpp"
#include "host/daemon/stereo/ring2_estimator.hpp"
#include "host/daemon/stereo/slam_estimator.hpp"
#include "host/record/recording_file.hpp"

namespace pharos::host {
namespace {

std::unique_ptr<PairSource> pairs_of(const SourceContext& context, const StereoConfig& config) {
  if (!config.is_loose()) {
    CameraPairs::Cameras cameras;
    for (std::size_t side = 0; side < cameras.size(); ++side) {
      const std::string name = side_name(config.name, side);
      CameraSettings settings = config.devices[side];
      if (config.replays_camera) settings.format = CameraFormat::kMono16;  // grey of either depth is recorded so
      cameras[side] = config.replays_camera ? replayed_camera(context, config.frames, settings, name)
                                            : open_recorded_camera(context, settings, name);
    }
    return std::make_unique<CameraPairs>(std::move(cameras), std::llround(config.pairing_window_s * 1e9));
  }
  RecordedPairs::Options options;
  options.fastest = context.replay_speed == ReplaySpeed::kFastest;
  if (config.devices[0].frame_rate_hz > 0.0) options.rate_hz = config.devices[0].frame_rate_hz;
  for (std::size_t side = 0; side < config.devices.size(); ++side) {
    options.sizes_px[side] = {config.devices[side].width_px, config.devices[side].height_px};
  }
  return std::make_unique<RecordedPairs>(context.clock, config.frames.string(), options);
}

}  // namespace

StereoFeed::StereoFeed(const SourceContext& context, const StereoConfig& config)
    : context_(context),
      name_(config.name),
      state_log_(config.name),
      clock_(config.replays_camera ? static_cast<const Clock&>(*context.replay) : context.clock),
      pairs_(pairs_of(context, config)) {
  if (config.ring2) add_system(config, "ring2/", std::make_shared<Ring2Estimator>(config.rig));
  if (config.slam) add_system(config, "slam/", std::make_shared<SlamEstimator>(config));
  watch_pairs();
}

StereoFeed::~StereoFeed() {
  forget_pairs();
  for (const auto& system : systems_) context_.loop.forget(system->worker.fd());
}

void StereoFeed::watch_pairs() {
  if (watched_) return;
  watched_ = true;
  for (const int fd : pairs_->fds()) context_.loop.watch(fd, [this] { on_readable(); });
}

void StereoFeed::forget_pairs() {
  if (!watched_) return;
  watched_ = false;
  for (const int fd : pairs_->fds()) context_.loop.forget(fd);
}

bool StereoFeed::idle() const {
  return std::all_of(systems_.begin(), systems_.end(), [](const auto& system) { return system->worker.idle(); });
}

void StereoFeed::add_system(const StereoConfig& config, const char* word,
                            const std::shared_ptr<PairEstimator>& estimator) {
  systems_.push_back(std::unique_ptr<System>(
      new System{StereoPipeline(config, context_.config.publish, word + config.name, context_.publisher, clock_),
                 pair_worker(estimator)}));
  System& system = *systems_.back();
  context_.loop.watch(system.worker.fd(), [this, &system] { on_results(system); });
}

void StereoFeed::on_readable() {
  if (StereoPairPtr pair = pairs_->take()) {
    pair->with_pictures = std::any_of(systems_.begin(), systems_.end(), [this](const auto& system) {
      return context_.preview_due(system->pipeline.source());
    });
    for (const auto& system : systems_) {
      if (!system->pipeline.take(*pair)) continue;
      if (auto discarded = system->worker.post(pair)) {
        system->pipeline.dropped();
        release(std::move(*discarded));
      }
    }
    release(std::move(pair));
    // At full speed all recordings wait until the pair is measured: it would be dropped for the next one, and its pose
    // would come among other poses in another order each time.
    if (context_.replay_speed == ReplaySpeed::kFastest && !idle()) {
      forget_pairs();
      context_.replay->hold();
    }
  }
  finish_when_all_answered();
}

void StereoFeed::on_results(System& system) {
  while (auto done = system.worker.take()) {
    const std::optional<StereoReport> report = system.pipeline.done(*done, !clock_notice().empty());
    if (report && context_.previews != nullptr) context_.previews->take(*report, std::move(done->answer.pictures));
    release(std::move(done->job));
  }
  if (!watched_ && idle()) {
    watch_pairs();
    context_.replay->go_on();
  }
  finish_when_all_answered();
}

// Pairs are shared by the event loop's thread and by workers that return them to it, so that the last reference is
// always released here.
void StereoFeed::release(StereoPairPtr pair) {
  if (pair.use_count() == 1) pairs_->recycle(std::move(pair));
}

void StereoFeed::finish_when_all_answered() {
  if (finished_ || !pairs_->status().finished) return;
  finished_ = idle();
  if (finished_) context_.on_finished();
}

void StereoFeed::attend() {
  const PairSourceStatus status = pairs_->status();
  const std::int64_t now_ns = clock_.monotonic_ns();
  state_log_.update(pairs_->device(), status, now_ns);
  bool changed = false;
  for (const auto& system : systems_) changed = system->pipeline.state_changed(status, now_ns) || changed;
  if (changed) context_.on_state_change();
}

std::vector<SourceHealth> StereoFeed::health() {
  std::vector<SourceHealth> all;
  const PairSourceStatus status = pairs_->status();
  for (const auto& system : systems_) {
    all.push_back(system->pipeline.health(pairs_->device(), status, clock_.monotonic_ns()));
  }
  return all;
}

std::size_t open_stereo_feeds(const SourceContext& context, SourceList& sources) {
  for (const StereoConfig& rig : context.config.stereos) sources.push_back(std::make_unique<StereoFeed>(context, rig));
  return context.config.stereos.size();
}

}  // namespace pharos::host
