// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <cstdint>
#include <string>

namespace pharos::host {

/// The camera's clock as the camera itself tells it over the control channel: what its frames' times are held against.
class CameraTime {
 public:
  /// A frame may be told of this long after or before the clock was read: what a frame may need until it is whole, and
  /// a camera's clock that PTP leads may have been set.
  static constexpr std::int64_t kTolerance_ns = 1'000'000'000;

  /// `device` must outlive this.
  explicit CameraTime(ArvDevice* device);
  /// Reads the clock: three packets and their answers. Nothing where the camera has no such nodes.
  void read();
  /// Whether a frame that arrived then can have that time. True where the clock is not known, and from the
  /// kForeignFrames-th frame on where none had a time of this clock: that camera's frames are stamped by another.
  bool agrees(std::int64_t camera_ns, std::int64_t arrival_monotonic_ns);
  static constexpr int kForeignFrames = 3;

 private:
  ArvDevice* device_;
  const char* latch_ = nullptr;  // names of the nodes; none: not there
  const char* value_ = nullptr;
  double ns_per_tick_ = 1.0;
  bool known_ = false;
  bool agreed_ = false;  // once in this session
  int foreign_ = 0;
  std::int64_t camera_ns_ = 0;
  std::int64_t read_ns_ = 0;
};

}  // namespace pharos::host
