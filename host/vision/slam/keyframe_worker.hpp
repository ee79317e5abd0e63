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

/// A thread that processes keyframes, one at a time, first in, first out.
class KeyframeWorker {
 public:
  /// `work` is called in the thread. An exception from it ends the thread, and check() throws it; `name` is for its
  /// message.
  KeyframeWorker(std::string name, std::function<void(KeyframeId)> work);
  /// Waits for the keyframe being processed; drops the waiting ones.
  ~KeyframeWorker();
  KeyframeWorker(const KeyframeWorker&) = delete;
  KeyframeWorker& operator=(const KeyframeWorker&) = delete;

  /// A thread that has failed processes nothing any more.
  void push(KeyframeId id);
  /// No keyframe is waiting or being processed.
  bool idle() const;
  std::size_t waiting() const;
  void wait_until_idle() const;
  /// Throws std::runtime_error at each call once `work` has thrown.
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
  std::thread thread_;  // last member: it uses all the others
};

}  // namespace pharos::slam
