// SPDX-License-Identifier: Apache-2.0
#include "host/device/frame_queue.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

namespace pharos::host {

FrameQueue::FrameQueue() : event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!event_.valid()) throw std::system_error(errno, std::generic_category(), "eventfd");
}

DepthFramePtr FrameQueue::blank() {
  const std::lock_guard lock(mutex_);
  if (blanks_.empty()) return std::make_unique<DepthFrame>();
  DepthFramePtr frame = std::move(blanks_.back());
  blanks_.pop_back();
  return frame;
}

bool FrameQueue::push(DepthFramePtr frame) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(std::move(frame));
  const bool dropped = waiting_.size() > kMostWaiting;
  if (dropped) {
    blanks_.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
  const std::uint64_t one = 1;
  // Cannot fail: the counter is emptied with the queue.
  if (waiting_.size() == 1) static_cast<void>(!::write(event_.get(), &one, sizeof one));
  return dropped;
}

DepthFramePtr FrameQueue::take() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return nullptr;
  DepthFramePtr frame = std::move(waiting_.front());
  waiting_.pop_front();
  std::uint64_t count = 0;
  if (waiting_.empty()) static_cast<void>(!::read(event_.get(), &count, sizeof count));
  return frame;
}

void FrameQueue::give_back(DepthFramePtr frame) {
  const std::lock_guard lock(mutex_);
  if (frame) blanks_.push_back(std::move(frame));
}

}  // namespace pharos::host
