// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "host/vision/slam/frame.hpp"

namespace pharos::slam {

/// A thread that works on keyframes, one at a time and in the order in which they came.
class KeyframeWorker {
 public:
  /// `work` is called in the thread. What it throws ends the thread, and check() hands it on; `name` says whose it is.
  KeyframeWorker(std::string name, std::function<void(KeyframeId)> work);
  /// Waits for the keyframe in work; those that wait are left.
  ~KeyframeWorker();
  KeyframeWorker(const KeyframeWorker&) = delete;
  KeyframeWorker& operator=(const KeyframeWorker&) = delete;

  /// Of a thread that has failed nothing comes any more.
  void push(KeyframeId id);
  /// None waits and none is in work.
  bool idle() const;
  std::size_t waiting() const;
  void wait_until_idle() const;
  /// Throws std::runtime_error where `work` has thrown, each time it is asked.
  void check() const;

 private:
  std::optional<KeyframeId> next();
  void done();
  void fail(std::exception_ptr fault);
  void run();

  std::string name_;
  std::function<void(KeyframeId)> work_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<KeyframeId> ids_;
  bool busy_ = false, closed_ = false;
  std::exception_ptr fault_;
  std::thread thread_;  // the last: it uses all the others
};

}  // namespace pharos::slam
