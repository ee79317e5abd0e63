// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "host/device/camera_settings.hpp"
#include "host/device/frame_queue.hpp"
#include "host/device/frame_source.hpp"
#include "host/device/gige_camera.hpp"

namespace pharos::host {

/// A GigE Vision camera that may be missing, taken or lost at any time and is tried again until it comes.
///
/// A thread of its own opens it (which waits for the network), takes its frames and unpacks them: the poll loop sees
/// whole frames only, through a descriptor.
class GigeSource : public FrameSource {
 public:
  explicit GigeSource(const CameraSettings& settings);
  /// Waits for the thread: up to 3.5 s while it looks for a camera that does not answer.
  ~GigeSource() override;

  int fd() const override { return queue_.fd(); }
  DepthFramePtr take() override { return queue_.take(); }
  void recycle(DepthFramePtr frame) override { queue_.recycle(std::move(frame)); }
  FrameSourceStatus status() const override;
  std::string device() const override;

 private:
  void run();
  void look_for_camera();
  void stream(GigeCamera& camera);
  void count(FrameOutcome outcome, std::int64_t missing);
  void hand_over(DepthFramePtr frame, const GigeCamera& camera);
  void set_state(CameraState state, const std::string& error);
  bool pause(std::chrono::milliseconds duration);

  CameraSettings settings_;
  FrameQueue queue_;
  std::string last_address_;  // where a camera known by its serial number was last
  std::int64_t ptp_asked_ns_ = 0;
  bool follows_ptp_ = false;

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable stopping_;
  bool stop_ = false;
  FrameSourceStatus status_;
  std::thread thread_;  // last: begins when all else is there
};

}  // namespace pharos::host
