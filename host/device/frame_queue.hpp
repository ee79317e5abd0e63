// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "host/device/depth_frame.hpp"
#include "host/support/ready_event.hpp"

namespace pharos::host {

using DepthFramePtr = std::unique_ptr<DepthFrame>;

/// Frames from a camera's thread to the poll loop: bounded, in order, the oldest gives way to the newest.
///
/// The loop sees a descriptor that is readable while frames wait. Frames are made once and go round: nothing is
/// allocated per frame.
class FrameQueue {
 public:
  /// Frames that may wait: one is worked on while the next comes, and a hiccup of the loop as long as a frame costs
  /// none.
  static constexpr std::size_t kMaxWaiting = 2;

  /// Of the camera's thread: a frame to fill, with the buffers of one that went before.
  DepthFramePtr blank();
  /// Puts it in the queue. True where the oldest that waited was dropped for it.
  bool push(DepthFramePtr frame);

  /// Of the poll loop: readable while a frame waits.
  int fd() const { return event_.fd(); }
  /// The oldest that waits, or null.
  DepthFramePtr take();
  /// A frame that was worked on, or a blank that is not needed (any thread).
  void recycle(DepthFramePtr frame);

 private:
  std::mutex mutex_;
  std::deque<DepthFramePtr> waiting_;
  std::vector<DepthFramePtr> free_frames_;
  ReadyEvent event_;
};

}  // namespace pharos::host
