// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/keyframe_worker.hpp"

#include <stdexcept>
#include <utility>

namespace pharos::slam {

KeyframeWorker::KeyframeWorker(std::string name, std::function<void(KeyframeId)> work)
    : name_(std::move(name)), work_(std::move(work)), thread_([this] { run(); }) {}

KeyframeWorker::~KeyframeWorker() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void KeyframeWorker::push(KeyframeId id) {
  const std::lock_guard lock(mutex_);
  if (fault_) return;
  ids_.push_back(id);
  changed_.notify_all();
}

bool KeyframeWorker::idle() const {
  const std::lock_guard lock(mutex_);
  return ids_.empty() && !busy_;
}

std::size_t KeyframeWorker::waiting() const {
  const std::lock_guard lock(mutex_);
  return ids_.size();
}

void KeyframeWorker::wait_until_idle() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ids_.empty() && !busy_; });
}

void KeyframeWorker::check() const {
  std::exception_ptr fault;
  {
    const std::lock_guard lock(mutex_);
    fault = fault_;
  }
  if (!fault) return;
  try {
    std::rethrow_exception(fault);
  } catch (const std::exception& error) {
    throw std::runtime_error(name_ + ": " + error.what());
  } catch (...) {
    throw std::runtime_error(name_ + ": an exception that is none of the standard library's");
  }
}

std::optional<KeyframeId> KeyframeWorker::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !ids_.empty(); });
  if (closed_) return std::nullopt;
  busy_ = true;
  const KeyframeId id = ids_.front();
  ids_.pop_front();
  return id;
}

void KeyframeWorker::done() {
  const std::lock_guard lock(mutex_);
  busy_ = false;
  changed_.notify_all();
}

void KeyframeWorker::fail(std::exception_ptr fault) {
  const std::lock_guard lock(mutex_);
  fault_ = std::move(fault);
  ids_.clear();
  busy_ = false;
  changed_.notify_all();
}

void KeyframeWorker::run() {
  try {
    while (const auto id = next()) {
      work_(*id);
      done();
    }
  } catch (...) {
    fail(std::current_exception());
  }
}

}  // namespace pharos::slam
