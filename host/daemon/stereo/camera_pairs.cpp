// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/camera_pairs.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "host/daemon/camera_input.hpp"
#include "host/daemon/health_parts.hpp"

namespace pharos::host {
namespace {

constexpr std::array<const char*, 2> kSides{"left", "right"};

// Frames without a partner in a row that mean unsynchronised shutters: two seconds of two cameras at 4 frames/s, half a
// second at 16.
constexpr std::int64_t kManyAlone = 16;

// Severity of a state; later in the list is worse.
int rank(CameraState state) {
  constexpr std::array kWorse{CameraState::kOpen, CameraState::kSilent, CameraState::kGone, CameraState::kTaken,
                              CameraState::kWrong};
  return static_cast<int>(std::find(kWorse.begin(), kWorse.end(), state) - kWorse.begin());
}

void add(std::string& text, const char* side, const std::string& words) {
  if (words.empty()) return;
  text += (text.empty() ? "" : "; ") + std::string(side) + ": " + words;
}

std::int64_t middle(std::int64_t a, std::int64_t b) { return a + (b - a) / 2; }

}  // namespace

CameraPairs::CameraPairs(Cameras cameras, std::int64_t window_ns)
    : cameras_(std::move(cameras)), matcher_(window_ns, [this](std::size_t side, DepthFramePtr frame) {
        cameras_[side]->recycle(std::move(frame));
      }) {}

std::string CameraPairs::device() const { return cameras_[0]->device() + " and " + cameras_[1]->device(); }

std::string CameraPairs::storage_error() const {
  const std::string left = cameras_[0]->storage_error();
  return left.empty() ? cameras_[1]->storage_error() : left;
}

std::string CameraPairs::clock_notice(std::int64_t monotonic_ns) const {
  const std::string left = clock_steps_[0].notice(monotonic_ns);
  return left.empty() ? clock_steps_[1].notice(monotonic_ns) : left;
}

StereoPairPtr CameraPairs::take() {
  for (std::size_t side = 0; side < cameras_.size(); ++side) {
    while (DepthFramePtr frame = cameras_[side]->take()) {
      if (StereoPairPtr pair = paired(side, std::move(frame))) return pair;
    }
  }
  return nullptr;
}

StereoPairPtr CameraPairs::paired(std::size_t side, DepthFramePtr frame) {
  transport_[side].add(frame->complete_monotonic_ns - frame->arrival_monotonic_ns);
  const std::optional<MappedTime> time = clocks_[side].time_of(*frame);
  if (clock_steps_[side].update(clocks_[side].map(), frame->complete_monotonic_ns)) {
    matcher_.clear();  // the times of waiting frames are of the old clock
    last_utc_ns_ = 0;
  }
  if (!time) {
    ++frames_no_clock_;
    cameras_[side]->recycle(std::move(frame));
    return nullptr;
  }
  auto frames = matcher_.push(side, {std::move(frame), *time});
  return frames ? made(std::move(*frames)) : nullptr;
}

StereoPairPtr CameraPairs::made(std::array<TimedFrame, 2> frames) {
  auto pair = std::make_shared<StereoPair>();
  const MappedTime &left = frames[0].time, &right = frames[1].time;
  pair->time = {middle(left.utc_ns, right.utc_ns), middle(left.monotonic_ns, right.monotonic_ns),
                std::max(left.sigma_ns, right.sigma_ns)};
  pair->steady_ns = pair->time.monotonic_ns;
  pair->offset_ns = right.utc_ns - left.utc_ns;
  pair->complete_monotonic_ns =
      std::max(frames[0].frame->complete_monotonic_ns, frames[1].frame->complete_monotonic_ns);
  for (std::size_t side = 0; side < frames.size(); ++side) pair->frames[side] = std::move(frames[side].frame);
  if (pair->time.utc_ns <= last_utc_ns_ || pair->steady_ns <= last_steady_ns_) {
    ++pairs_time_back_;
    recycle(std::move(pair));
    return nullptr;
  }
  last_utc_ns_ = pair->time.utc_ns;
  last_steady_ns_ = pair->steady_ns;
  ++pairs_;
  unpaired_at_last_pair_ = matcher_.unpaired(0) + matcher_.unpaired(1);
  offsets_.add(std::abs(pair->offset_ns));
  return pair;
}

void CameraPairs::recycle(StereoPairPtr pair) {
  for (std::size_t side = 0; side < cameras_.size(); ++side) cameras_[side]->recycle(std::move(pair->frames[side]));
}

PairSourceStatus CameraPairs::status() const {
  const std::array<FrameSourceStatus, 2> cameras{cameras_[0]->status(), cameras_[1]->status()};
  PairSourceStatus status;
  status.pairs.came = pairs_;
  status.finished = cameras[0].finished && cameras[1].finished;
  status.state = rank(cameras[0].state) < rank(cameras[1].state) ? cameras[1].state : cameras[0].state;
  for (std::size_t side = 0; side < cameras.size(); ++side) {
    add(status.error, kSides[side], cameras[side].error);
    add(status.identity, kSides[side], cameras[side].identity);
    add(status.remark, kSides[side], cameras[side].remark);
    add(status.ptp, kSides[side], cameras[side].ptp);
    status.ptp_fault = status.ptp_fault || cameras[side].ptp_fault;
    // A frame lost on one side leaves one without a partner on the other: the worse side has lost the pairs.
    status.pairs.lost = std::max(status.pairs.lost, delivered(cameras[side].counters).lost + matcher_.unpaired(side));
    status.session += cameras[side].session;
    status.contests += cameras[side].counters.camera_contested;
    status.clock_sigma_ns = std::max(status.clock_sigma_ns, static_cast<double>(clocks_[side].sigma_ns()));
  }
  if (status.error.empty() && matcher_.unpaired(0) + matcher_.unpaired(1) - unpaired_at_last_pair_ >= kManyAlone) {
    status.error =
        "frames of both cameras come, and no two within pairing_window_ms: trigger the shutters together, "
        "let both cameras follow PTP, or widen it";
  }
  status.clock_drift_ppm = clocks_[0].map().drift_ppm();
  status.counters = named_counts(cameras);
  return status;
}

NamedCounts CameraPairs::named_counts(const std::array<FrameSourceStatus, 2>& cameras) const {
  NamedCounts counts{{"device.pairs", pairs_},
                     {"device.pairs_time_back", pairs_time_back_},
                     {"device.frames_no_clock", frames_no_clock_}};
  for (std::size_t side = 0; side < cameras.size(); ++side) {
    const std::string head = std::string(kSides[side]) + '.';
    counts.push_back({head + "frames_without_partner", matcher_.unpaired(side)});
    for_each_counter(cameras[side].counters, [&](const char* name, std::int64_t value) {
      counts.push_back({head + name, value});
    });
    add_recording(counts, head + "recording.", cameras[side]);
    add_times(counts, head + "transport", transport_[side]);
    counts.push_back({head + "clock.ptp_state", static_cast<std::int64_t>(cameras[side].ptp_state)});
    counts.push_back({head + "clock.by_ptp", clocks_[side].by_ptp() ? 1 : 0});
    counts.push_back({head + "clock.ptp_doubted", clocks_[side].ptp_doubted()});
  }
  add_times(counts, "pair_offset", offsets_);
  return counts;
}

}  // namespace pharos::host
