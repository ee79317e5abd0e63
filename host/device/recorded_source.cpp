// SPDX-License-Identifier: Apache-2.0
#include "host/device/recorded_source.hpp"

#include <chrono>
#include <utility>

#include "host/images/grey_image.hpp"
#include "host/runtime/now.hpp"
#include "host/support/input_error.hpp"

namespace pharos::host {

RecordedSource::RecordedSource(const std::string& directory, std::int32_t width_px, std::int32_t height_px,
                               double frame_rate_hz)
    : path_(directory),
      directory_(directory),
      width_px_(width_px),
      height_px_(height_px),
      frame_rate_hz_(frame_rate_hz) {
  status_.state = CameraState::kOpen;
  status_.session = 1;
  status_.identity = std::to_string(directory_.frames()) + " recorded frames";
  arm();
}

// A periodic timer if there is a frame rate; otherwise the next frame follows at once.
void RecordedSource::arm() {
  using std::chrono::nanoseconds;
  if (frame_rate_hz_ <= 0.0) {
    timer_.start(nanoseconds(0));
  } else if (next_ == 0) {
    timer_.start(nanoseconds(0),
                 std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(1.0 / frame_rate_hz_)));
  }
}

DepthFramePtr RecordedSource::take() {
  if (timer_.take_expiries() == 0) return nullptr;
  if (next_ == directory_.frames()) {
    timer_.stop();
    status_.finished = true;
    status_.state = CameraState::kSilent;
    status_.error = "the recorded frames have come to their end";
    return nullptr;
  }
  DepthFramePtr frame = blank_ ? std::exchange(blank_, nullptr) : std::make_unique<DepthFrame>();
  try {
    const std::string colour = directory_.read(next_, width_px_, height_px_, *frame);
    if (!colour.empty() && status_.remark.empty()) status_.remark = colour_remark(colour);
    ++status_.counters.frames_received;
  } catch (const InputError& error) {
    ++status_.counters.frames_wrong_size;
    status_.error = error.what();
    recycle(std::exchange(frame, nullptr));
  }
  ++next_;
  arm();
  if (!frame) return nullptr;
  frame->session = status_.session;
  frame->clock = CameraClock::kHost;
  frame->camera_ns = frame->arrival_utc_ns = utc_now_ns();
  frame->arrival_monotonic_ns = frame->complete_monotonic_ns = monotonic_now_ns();
  return frame;
}

}  // namespace pharos::host
