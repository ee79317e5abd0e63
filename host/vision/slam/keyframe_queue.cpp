// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/engine.hpp"

namespace pharos::slam {

void KeyframeQueue::push(KeyframeId id) {
  const std::lock_guard lock(mutex_);
  ids_.push_back(id);
  changed_.notify_all();
}

std::optional<KeyframeId> KeyframeQueue::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !ids_.empty(); });
  if (closed_) return std::nullopt;
  busy_ = true;
  const KeyframeId id = ids_.front();
  ids_.pop_front();
  return id;
}

void KeyframeQueue::done() {
  const std::lock_guard lock(mutex_);
  busy_ = false;
  changed_.notify_all();
}

bool KeyframeQueue::idle() const {
  const std::lock_guard lock(mutex_);
  return ids_.empty() && !busy_;
}

bool KeyframeQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return !ids_.empty();
}

void KeyframeQueue::wait_until_idle() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || (ids_.empty() && !busy_); });
}

void KeyframeQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

}  // namespace pharos::slam
