// SPDX-License-Identifier: Apache-2.0
#include "host/device/gige_source.hpp"

#include <exception>
#include <utility>

#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRetry{500};
constexpr milliseconds kWait{100};
// A wait that ends much sooner without a frame (the camera's socket is gone) must not turn the thread into a spinner.
constexpr milliseconds kBreath{20};
// Frames come every 33 ms, in turns every 0.3 s: as long without any is a camera that was lost.
constexpr std::int64_t kSilence_ns = 1'000'000'000;
// PTP's state changes within seconds; asking costs the camera a packet.
constexpr std::int64_t kAskPtp_ns = 1'000'000'000;

}  // namespace

GigeSource::GigeSource(const CameraSettings& settings) : settings_(settings) {
  status_.error = "not opened yet";
  thread_ = std::thread([this] { run(); });
}

GigeSource::~GigeSource() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  stopping_.notify_all();
  thread_.join();
}

std::string GigeSource::device() const {
  return settings_.address.empty() ? "camera " + settings_.serial : "camera at " + settings_.address;
}

FrameSourceStatus GigeSource::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void GigeSource::set_state(CameraState state, const std::string& error) {
  const std::lock_guard lock(mutex_);
  status_.state = state;
  status_.error = error;
}

/// True unless the source is to end.
bool GigeSource::pause(milliseconds duration) {
  std::unique_lock lock(mutex_);
  stopping_.wait_for(lock, duration, [this] { return stop_; });
  return !stop_;
}

void GigeSource::run() {
  while (pause(milliseconds(0))) {
    look_for_camera();
    pause(kRetry);
  }
}

void GigeSource::look_for_camera() {
  CameraSettings settings = settings_;
  // A camera comes back where it was, and is found there without asking the whole network; if not, the network is
  // asked.
  if (settings.address.empty()) settings.address = std::exchange(last_address_, "");
  try {
    GigeCamera camera(settings);
    last_address_ = camera.address();
    {
      const std::lock_guard lock(mutex_);
      ++status_.session;
      ++status_.counters.camera_opened;
      status_.identity = camera.identity();
      status_.state = CameraState::kOpen;
      status_.error.clear();
    }
    stream(camera);
  } catch (const CameraError& error) {
    set_state(error.state(), error.what());
  } catch (const std::exception& error) {  // a fault of ours: tried again, and not the end of the daemon
    set_state(CameraState::kWrong, std::string("internal error: ") + error.what());
  }
}

void GigeSource::stream(GigeCamera& camera) {
  std::int64_t last_ns = monotonic_now_ns();
  ptp_asked_ns_ = 0;
  while (pause(milliseconds(0))) {
    const std::int64_t began_ns = monotonic_now_ns();
    DepthFramePtr frame = queue_.blank();
    std::int64_t missing = 0;
    const FrameOutcome outcome = camera.next(*frame, kWait, missing);
    const std::int64_t now_ns = monotonic_now_ns();
    count(outcome, missing);
    if (outcome == FrameOutcome::kFrame) {
      hand_over(std::move(frame), camera);
    } else {
      queue_.recycle(std::move(frame));
    }
    if (outcome != FrameOutcome::kNone) last_ns = now_ns;
    if (now_ns - last_ns > kSilence_ns) break;
    if (outcome == FrameOutcome::kNone && now_ns - began_ns < std::chrono::nanoseconds(kBreath).count()) pause(kBreath);
  }
  const bool lost = !camera.is_controller();
  const std::lock_guard lock(mutex_);
  ++(lost ? status_.counters.camera_lost : status_.counters.camera_silences);
  status_.state = lost ? CameraState::kGone : CameraState::kSilent;
  status_.error = lost ? "the camera was lost; looking for it" : "no frame comes from the camera; opening it anew";
}

void GigeSource::count(FrameOutcome outcome, std::int64_t missing) {
  const std::lock_guard lock(mutex_);
  FrameSourceCounters& counters = status_.counters;
  counters.frames_missing += missing;
  counters.frames_received += outcome == FrameOutcome::kFrame ? 1 : 0;
  counters.frames_incomplete += outcome == FrameOutcome::kIncomplete ? 1 : 0;
  counters.frames_wrong_size += outcome == FrameOutcome::kWrongSize ? 1 : 0;
  counters.frames_unpaired += outcome == FrameOutcome::kUnpaired ? 1 : 0;
}

void GigeSource::hand_over(DepthFramePtr frame, const GigeCamera& camera) {
  if (frame->complete_monotonic_ns - ptp_asked_ns_ > kAskPtp_ns) {
    follows_ptp_ = camera.follows_ptp();
    ptp_asked_ns_ = frame->complete_monotonic_ns;
  }
  frame->clock = follows_ptp_ ? CameraClock::kPtp : CameraClock::kOwn;
  {
    const std::lock_guard lock(mutex_);
    frame->session = status_.session;
  }
  const bool dropped = queue_.push(std::move(frame));
  const std::lock_guard lock(mutex_);
  status_.counters.frames_dropped += dropped ? 1 : 0;
}

}  // namespace pharos::host
