// SPDX-License-Identifier: Apache-2.0
#include "rtl/capture_model.hpp"

#include <algorithm>
#include <bit>

#include "firmware/rtl/capture_registers.h"

namespace pharos::rtl {

void CaptureModel::reset(std::uint32_t pins) {
  *this = CaptureModel(build_);
  levels_ = pins & input_mask();
  underway_.fill(levels_);
  input_enable_ = input_mask();
}

void CaptureModel::set_ticks(std::uint64_t ticks) { now_ = ticks; }

std::size_t CaptureModel::readable() const {
  std::size_t count = records_.size();
  while (count > 0 && records_[count - 1].age < PHAROS_CAPTURE_VISIBLE_AFTER_TICKS) --count;
  return count;
}

void CaptureModel::tick(std::uint32_t pins, const BusRequest& request) {
  for (auto record = records_.rbegin(); record != records_.rend() && record->age < PHAROS_CAPTURE_VISIBLE_AFTER_TICKS;
       ++record) {
    ++record->age;
  }
  const std::size_t count = readable();
  read_data_ = answer(request.offset);
  interrupt_ = threshold_ != 0 && count >= threshold_;

  const bool cleared = request.kind == BusRequest::Kind::kWrite && request.offset == PHAROS_CAPTURE_CONTROL_OFFSET &&
                       (request.data & PHAROS_CAPTURE_CONTROL_CLEAR_FIFO) != 0;
  const bool popped = request.kind == BusRequest::Kind::kRead && request.offset == PHAROS_CAPTURE_FIFO_LEVELS_OFFSET;
  if (request.kind == BusRequest::Kind::kRead && request.offset == PHAROS_CAPTURE_TIME_LOW_OFFSET) {
    high_latched_ = now_ >> 32;
  }
  const bool overflow_read = request.kind == BusRequest::Kind::kWrite &&
                             request.offset == PHAROS_CAPTURE_STATUS_OFFSET &&
                             (request.data & PHAROS_CAPTURE_STATUS_OVERFLOW) != 0;
  if (overflow_read) overflow_ = false;
  // An edge of the tick in which an entry is freed cannot use it yet.
  arrive(cleared);
  if (popped && count > 0) records_.pop_front();
  if (cleared) records_.clear();
  const bool breaks_off =
      cleared || !enabled_ ||
      (request.kind == BusRequest::Kind::kWrite && request.offset == PHAROS_CAPTURE_INPUT_ENABLE_OFFSET);
  if (breaks_off) gap_ = true;

  if (glitch_) glitches_ = std::min(glitches_ + 1, 0xFFFFu);
  filter(underway_[1]);
  underway_ = {pins & input_mask(), underway_[0]};
  if (request.kind == BusRequest::Kind::kWrite) write(request);
  ++now_;
}

std::uint32_t CaptureModel::answer(std::uint8_t offset) {
  const bool some = readable() > 0;
  switch (offset) {
    case PHAROS_CAPTURE_ID_OFFSET:
      return PHAROS_CAPTURE_ID;
    case PHAROS_CAPTURE_BUILD_OFFSET:
      return (PHAROS_CAPTURE_VERSION << PHAROS_CAPTURE_BUILD_VERSION_SHIFT) |
             (build_.filter_width << PHAROS_CAPTURE_BUILD_FILTER_WIDTH_SHIFT) |
             (static_cast<unsigned>(std::countr_zero(build_.depth)) << PHAROS_CAPTURE_BUILD_DEPTH_LOG2_SHIFT) |
             build_.inputs;
    case PHAROS_CAPTURE_CONTROL_OFFSET:
      return enabled_ ? PHAROS_CAPTURE_CONTROL_ENABLE : 0;
    case PHAROS_CAPTURE_THRESHOLD_OFFSET:
      return threshold_;
    case PHAROS_CAPTURE_STATUS_OFFSET:
      return static_cast<std::uint32_t>(readable()) | (some && records_.front().gap ? PHAROS_CAPTURE_STATUS_GAP : 0) |
             (overflow_ ? PHAROS_CAPTURE_STATUS_OVERFLOW : 0) | (gap_ ? PHAROS_CAPTURE_STATUS_GAP_NEXT : 0);
    case PHAROS_CAPTURE_FIFO_TIME_OFFSET:
      return some ? records_.front().stamp : 0;
    case PHAROS_CAPTURE_FIFO_CHANGED_OFFSET:
      return some ? records_.front().changed : 0;
    case PHAROS_CAPTURE_FIFO_LEVELS_OFFSET:
      return some ? records_.front().levels : 0;
    case PHAROS_CAPTURE_LOST_OFFSET:
      return static_cast<std::uint32_t>(std::min(lost_edges_, (std::uint64_t{1} << build_.lost_width) - 1));
    case PHAROS_CAPTURE_TIME_LOW_OFFSET:
      return static_cast<std::uint32_t>(now_);
    case PHAROS_CAPTURE_TIME_HIGH_OFFSET:
      return static_cast<std::uint32_t>(high_latched_);
    case PHAROS_CAPTURE_LEVELS_OFFSET:
      return levels_;
    case PHAROS_CAPTURE_INPUT_ENABLE_OFFSET:
      return input_enable_;
    case PHAROS_CAPTURE_FILTER_OFFSET:
      return filter_length_;
    case PHAROS_CAPTURE_GLITCHES_OFFSET:
      return glitches_;
    default:
      return 0;
  }
}

void CaptureModel::arrive(bool cleared) {
  if (arriving_ == 0) return;
  const auto edges = static_cast<std::uint64_t>(std::popcount(arriving_));
  if (records_.size() == build_.depth) {
    lost_edges_ += edges;
    overflow_ = true;
    gap_ = true;
    return;
  }
  if (!cleared) {
    records_.push_back({0, static_cast<std::uint32_t>(now_), arriving_, levels_, gap_});
    recorded_edges_ += edges;
  }
  gap_ = false;
}

void CaptureModel::filter(std::uint32_t seen) {
  arriving_ = 0;
  glitch_ = false;
  const std::uint32_t watched = enabled_ ? input_enable_ : 0;
  const std::uint32_t before = levels_;
  for (unsigned input = 0; input < build_.inputs; ++input) {
    const std::uint32_t bit = std::uint32_t{1} << input;
    if (((seen ^ before) & bit) == 0) {
      if (held_[input] > 0 && (watched & bit) != 0) glitch_ = true;
      held_[input] = 0;
      required_[input] = filter_length_;
    } else if (++held_[input] > required_[input]) {
      levels_ ^= bit;
      arriving_ |= bit & watched;
      held_[input] = 0;
      required_[input] = filter_length_;
    }
  }
}

void CaptureModel::write(const BusRequest& request) {
  switch (request.offset) {
    case PHAROS_CAPTURE_CONTROL_OFFSET:
      enabled_ = (request.data & PHAROS_CAPTURE_CONTROL_ENABLE) != 0;
      break;
    case PHAROS_CAPTURE_THRESHOLD_OFFSET:
      threshold_ = request.data & (2 * build_.depth - 1);
      break;
    case PHAROS_CAPTURE_INPUT_ENABLE_OFFSET:
      input_enable_ = request.data & input_mask();
      break;
    case PHAROS_CAPTURE_FILTER_OFFSET:
      filter_length_ = request.data & ((1u << build_.filter_width) - 1);
      break;
    default:
      break;
  }
}

}  // namespace pharos::rtl
