// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include <cstdint>
#include <vector>

#include "host/gige/udp_sockets.hpp"

namespace pharos::host {

/// Heartbeat of the controlling program, frequent enough for a heartbeat timeout of one second.
///
/// A camera heeds a master that died until GevHeartbeatTimeout is over, 3 s as it comes; nobody else gets it meanwhile.
/// It is set to 1 s, and back where the camera is given back in order. Aravis' own heartbeat is as slow as that, and
/// waits up to 2.5 s for an answer: the control channel's register is asked for four times a second beside it, and
/// nobody waits. Aravis passes over the answers, since their number is none that it waits for.
class Heartbeat {
 public:
  /// `device` must outlive this; its control socket is one of those that this process has now. A camera that does not
  /// take the timeout keeps its own.
  Heartbeat(ArvDevice* device, std::uint32_t camera_address);

  /// Asks for the register where a quarter of a second has passed since the last time: one packet, sent at once.
  void beat_if_due();
  /// Sets the timeout back to what it was.
  void restore();

 private:
  ArvDevice* device_;
  std::uint32_t camera_address_;
  std::vector<UdpSocket> sockets_;
  std::uint32_t former_ms_ = 0;  // 0: was not changed
  std::int64_t last_beat_ns_ = 0;
};

}  // namespace pharos::host
