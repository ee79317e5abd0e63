// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <cstdint>

namespace pharos::host {

/// Tells a camera that its master lives, often enough for it to forget a dead one within a second.
///
/// A camera heeds a master that died until GevHeartbeatTimeout is over, 3 s as it comes; nobody else gets it meanwhile.
/// It is set to 1 s, and back where the camera is given back in order. Aravis' own heartbeat is as slow as that: the
/// control channel's register is read four times a second beside it.
class Heartbeat {
 public:
  /// `device` must outlive this. A camera that does not take the timeout keeps its own.
  explicit Heartbeat(ArvDevice* device);

  /// Reads the register where a quarter of a second has passed since the last time: one packet, and its answer.
  void beat_if_due();
  /// Sets the timeout back to what it was.
  void restore();

 private:
  ArvDevice* device_;
  std::uint32_t former_ms_ = 0;  // 0: was not changed
  std::int64_t last_beat_ns_ = 0;
};

}  // namespace pharos::host
