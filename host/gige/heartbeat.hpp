// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <cstdint>

namespace pharos::host {

/// Heartbeat of the controlling program, frequent enough for a heartbeat timeout of one second.
///
/// A camera accepts no other controller until GevHeartbeatTimeout (by default 3 s) after the last heartbeat of one that
/// died. The timeout is set to 1 s, and restored when the camera is released in order. Aravis' own heartbeat has a
/// period of 1 s, so the control privilege register is read four times a second in addition.
class Heartbeat {
 public:
  /// `device` must outlive this. A camera that refuses the timeout keeps its own.
  explicit Heartbeat(ArvDevice* device);

  /// Reads the register if a quarter of a second has passed since the last time: one packet and its response.
  void beat_if_due();
  /// Sets the timeout back to what it was.
  void restore();

 private:
  ArvDevice* device_;
  std::uint32_t former_ms_ = 0;  // 0: not changed
  std::int64_t last_beat_ns_ = 0;
};

}  // namespace pharos::host
