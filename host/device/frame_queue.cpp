// SPDX-License-Identifier: Apache-2.0
#include "host/device/frame_queue.hpp"

#include <utility>

namespace pharos::host {

DepthFramePtr FrameQueue::blank() {
  const std::lock_guard lock(mutex_);
  if (free_frames_.empty()) return std::make_unique<DepthFrame>();
  DepthFramePtr frame = std::move(free_frames_.back());
  free_frames_.pop_back();
  return frame;
}

bool FrameQueue::push(DepthFramePtr frame) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(std::move(frame));
  const bool dropped = waiting_.size() > kMaxWaiting;
  if (dropped) {
    free_frames_.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
  event_.set();
  return dropped;
}

DepthFramePtr FrameQueue::take() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return nullptr;
  DepthFramePtr frame = std::move(waiting_.front());
  waiting_.pop_front();
  if (waiting_.empty()) event_.clear();
  return frame;
}

void FrameQueue::recycle(DepthFramePtr frame) {
  const std::lock_guard lock(mutex_);
  if (frame) free_frames_.push_back(std::move(frame));
}

}  // namespace pharos::host
