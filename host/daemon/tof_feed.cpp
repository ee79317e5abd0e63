// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/tof_feed.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "host/daemon/camera_input.hpp"
#include "host/device/recorded_source.hpp"

namespace pharos::host {
namespace {

// Frame rate of the camera that `pharos sim tof` simulates, which is the Helios' highest.
constexpr double kUsualRate_hz = 30.0;

std::unique_ptr<FrameSource> frames_of(const SourceContext& context, const TofConfig& config) {
  if (!config.is_recorded()) return open_recorded_camera(context, config.device, config.name);
  if (config.replays_camera) return replayed_camera(context, config.frames, config.device, config.name);
  const double asked_hz = config.device.frame_rate_hz;
  const double rate_hz = asked_hz > 0.0 ? asked_hz : kUsualRate_hz;
  return std::make_unique<RecordedSource>(config.frames.string(), config.device.width_px, config.device.height_px,
                                          context.replay_speed == ReplaySpeed::kFastest ? 0.0 : rate_hz);
}

// Frames of a recording have its times.
const Clock& clock_of(const SourceContext& context, const TofConfig& config) {
  return config.replays_camera ? static_cast<const Clock&>(*context.replay) : context.clock;
}

}  // namespace

TofFeed::TofFeed(const SourceContext& context, const TofConfig& config)
    : context_(context),
      name_(config.name),
      state_log_(config.name),
      clock_(clock_of(context, config)),
      frames_(frames_of(context, config)),
      pipeline_(config, context.config.publish, "tof/" + config.name, context.publisher, clock_),
      estimator_(config.camera, config.tof),
      worker_(tof_worker(estimator_)) {
  context_.loop.watch(worker_.fd(), [this] { on_results(); });
  watch_frames();
}

TofFeed::~TofFeed() {
  forget_frames();
  context_.loop.forget(worker_.fd());
}

void TofFeed::watch_frames() {
  if (watched_) return;
  watched_ = true;
  context_.loop.watch(frames_->fd(), [this] { on_readable(); });
}

void TofFeed::forget_frames() {
  if (!watched_) return;
  watched_ = false;
  context_.loop.forget(frames_->fd());
}

// While one frame is measured the source keeps the newest that come. At full speed all recordings wait: the frame would
// be dropped for a newer one, and its pose would come among other poses in another order each time.
void TofFeed::on_readable() {
  if (DepthFramePtr frame = frames_->take()) {
    if (const auto time = pipeline_.take(*frame)) {
      forget_frames();
      if (context_.replay_speed == ReplaySpeed::kFastest) context_.replay->hold();
      worker_.post({std::move(frame), *time});
    } else {
      frames_->recycle(std::move(frame));
    }
  } else if (!finished_ && frames_->status().finished) {
    finished_ = true;
    context_.on_finished();
  }
}

void TofFeed::on_results() {
  while (auto done = worker_.take()) {
    const std::optional<TofReport> report = pipeline_.done(*done);
    if (report && context_.preview_due(report->source)) {  // the estimator rests: it still holds what it found
      std::vector<AnnotatedImage> picture(1, annotated_image(done->job.frame->intensity_view(), estimator_.drawing()));
      context_.previews->take(*report, std::move(picture));
    }
    frames_->recycle(std::move(done->job.frame));
    if (context_.replay_speed == ReplaySpeed::kFastest) context_.replay->go_on();
    watch_frames();
  }
}

void TofFeed::attend() {
  const FrameSourceStatus status = frames_->status();
  const std::int64_t now_ns = clock_.monotonic_ns();
  state_log_.update(frames_->device(), status, now_ns);
  if (pipeline_.state_changed(status, now_ns)) context_.on_state_change();
}

std::vector<SourceHealth> TofFeed::health() {
  const FrameSourceStatus status = frames_->status();
  SourceHealth health = pipeline_.health(frames_->device(), status, clock_.monotonic_ns());
  add_recording(health.counters, "recording.", status);
  return {std::move(health)};
}

std::size_t open_tof_feeds(const SourceContext& context, SourceList& sources) {
  for (const TofConfig& camera : context.config.cameras) sources.push_back(std::make_unique<TofFeed>(context, camera));
  return context.config.cameras.size();
}

}  // namespace pharos::host
