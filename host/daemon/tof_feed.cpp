// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/tof_feed.hpp"

#include <utility>

#include "host/device/gige_module.hpp"
#include "host/device/recorded_source.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

// Of the camera that `pharos sim tof` simulates, and the Helios' own greatest.
constexpr double kUsualRate_hz = 30.0;

std::unique_ptr<FrameSource> source_of(const TofConfig& config, bool fastest) {
  if (!config.is_recorded()) return open_gige_source(config.device);
  const double asked_hz = config.device.frame_rate_hz;
  const double rate_hz = asked_hz > 0.0 ? asked_hz : kUsualRate_hz;
  return std::make_unique<RecordedSource>(config.frames.string(), config.device.width_px, config.device.height_px,
                                          fastest ? 0.0 : rate_hz);
}

}  // namespace

TofFeed::TofFeed(EventLoop& loop, const TofConfig& config, const PublishConfig& publish, Publisher& publisher,
                 bool fastest, std::function<void()> finished)
    : loop_(loop),
      name_(config.name),
      recorded_(config.is_recorded()),
      state_log_(config.name),
      source_(source_of(config, fastest)),
      estimator_(config.camera, config.tof),
      line_(config, publish, "tof/" + config.name, publisher,
            [this](const DepthFrame& frame) { return estimator_.measure(frame); }),
      finished_(std::move(finished)) {
  loop_.watch(source_->fd(), [this] { on_readable(); });
}

TofFeed::~TofFeed() { loop_.forget(source_->fd()); }

// One frame, then whoever else waits in the loop: the lighthouse's cycles must not wait for two.
void TofFeed::on_readable() {
  if (DepthFramePtr frame = source_->take()) {
    line_.take(*frame);
    source_->recycle(std::move(frame));
  } else if (!finish_reported_ && source_->status().finished) {
    finish_reported_ = true;
    finished_();
  }
}

void TofFeed::attend(std::int64_t monotonic_ns) {
  state_log_.update(source_->device(), source_->status(), monotonic_ns);
}

}  // namespace pharos::host
