// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/recorded_pairs.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "host/images/grey_image.hpp"
#include "host/support/input_error.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {
RecordedPairs::RecordedPairs(const Clock& clock, const std::string& directory, const Options& options)
    : clock_(clock),
      path_(directory),
      options_(options),
      pairs_(pair_names_in(directory, options.rate_hz)),
      began_utc_ns_(clock.utc_ns()),
      due_monotonic_ns_(clock.monotonic_ns()) {
  timer_.start(std::chrono::nanoseconds(0));
}

std::int64_t RecordedPairs::time_ns(std::size_t index) const {
  const PairName& pair = pairs_[index];
  if (pair.stamp_ns) return *pair.stamp_ns;
  return began_utc_ns_ + std::llround((pair.time_s - pairs_.front().time_s) * static_cast<double>(kNsPerSecond));
}

// Sets the timer for the pair next_, or for the end after the last one.
void RecordedPairs::arm() {
  if (next_ < pairs_.size() && next_ > 0 && !options_.fastest) {
    due_monotonic_ns_ += std::min(time_ns(next_) - time_ns(next_ - 1), kLongestSilence_ns);
  }
  const std::int64_t wait_ns = options_.fastest ? 0 : due_monotonic_ns_ - clock_.monotonic_ns();
  timer_.start(std::chrono::nanoseconds(std::max<std::int64_t>(wait_ns, 0)));
}

bool RecordedPairs::read(const PairName& name, StereoPair& pair) {
  try {
    for (std::size_t side = 0; side < pair.frames.size(); ++side) {
      const std::string& file = side == 0 ? name.left : name.right;
      GreyImage image = read_grey_image(file);
      if (image.from_colour && remark_.empty()) remark_ = colour_remark(file);
      const auto& [width_px, height_px] = options_.sizes_px[side];
      if (image.width_px != width_px || image.height_px != height_px) {
        throw InputError(file + ": has " + std::to_string(image.width_px) + " x " + std::to_string(image.height_px) +
                         " pixels, the rig's camera " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                         "; is it of this rig?");
      }
      pair.frames[side] = std::make_unique<DepthFrame>();
      pair.frames[side]->width_px = width_px;
      pair.frames[side]->height_px = height_px;
      pair.frames[side]->intensity = std::move(image.pixels);
    }
  } catch (const InputError& error) {
    ++pairs_unreadable_;
    error_ = error.what();
    return false;
  }
  ++pairs_read_;
  error_.clear();
  return true;
}

StereoPairPtr RecordedPairs::take() {
  if (timer_.take_expiries() == 0) return nullptr;
  if (next_ == pairs_.size()) {
    timer_.stop();
    finished_ = true;
    return nullptr;
  }
  auto pair = std::make_shared<StereoPair>();
  const bool good = read(pairs_[next_], *pair);
  pair->time = {time_ns(next_), clock_.monotonic_ns(), 0};
  pair->steady_ns = pair->time.utc_ns;
  pair->complete_monotonic_ns = pair->time.monotonic_ns;
  ++next_;
  if (!good || !options_.fastest) arm();
  return good ? pair : nullptr;
}

void RecordedPairs::recycle(StereoPairPtr) {
  if (options_.fastest) arm();
}

PairSourceStatus RecordedPairs::status() const {
  PairSourceStatus status;
  status.state = finished_ ? CameraState::kSilent : CameraState::kOpen;
  status.error = finished_ ? "the recorded pairs have come to their end" : error_;
  status.remark = remark_;
  status.identity = std::to_string(pairs_.size()) + " recorded pairs";
  status.counters = {{"device.pairs_read", pairs_read_}, {"device.pairs_unreadable", pairs_unreadable_}};
  status.session = 1;
  status.finished = finished_;
  return status;
}

}  // namespace pharos::host
