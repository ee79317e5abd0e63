// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <cstdint>
#include <string>

namespace pharos::host {

/// The camera's clock, read over the control channel, with which the times of its frames are compared.
class CameraTime {
 public:
  /// Maximum difference: covers the time until a frame is complete, and steps of a clock that PTP disciplines.
  static constexpr std::int64_t kTolerance_ns = 1'000'000'000;

  /// `device` must outlive this.
  explicit CameraTime(ArvDevice* device);
  /// Reads the clock: three packets and their responses. Does nothing if the camera has no such nodes.
  void read();
  /// Reads the clock if that was not done within kMinReading_ns; whether it was. For a frame that disagrees, where the
  /// clock may have been set since.
  bool read_again(std::int64_t now_ns);
  /// Whether a frame that arrived at that time can have that time stamp. True if the clock is unknown, and from the
  /// kForeignFrames-th frame on if no frame agreed before: then the camera stamps its frames by another clock.
  bool agrees(std::int64_t camera_ns, std::int64_t arrival_monotonic_ns);
  static constexpr int kForeignFrames = 3;
  /// Another sender's frames cause no more queries than this.
  static constexpr std::int64_t kMinReading_ns = 100'000'000;

 private:
  ArvDevice* device_;
  const char* latch_ = nullptr;  // node names; null if the camera has none
  const char* value_ = nullptr;
  double ns_per_tick_ = 1.0;
  bool known_ = false;
  bool agreed_ = false;  // a frame has agreed in this session
  int foreign_ = 0;
  std::int64_t camera_ns_ = 0;
  std::int64_t read_ns_ = 0;
};

}  // namespace pharos::host
