// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arv.h>

#include "host/device/ptp_state.hpp"

namespace pharos::host {

/// Names of a camera's PTP nodes.
struct PtpNodes {
  const char* enable;
  const char* status;
  const char* latch;  // command that copies the state to `status`
};

/// The camera's PTP: told to follow it once, then asked for its state. Nodes are those of GenICam's SFNC
/// (PtpEnable), or its deprecated ones (GevIEEE1588).
class CameraPtp {
 public:
  /// Tells the camera to follow PTP if it offers it. `device` must outlive this.
  explicit CameraPtp(ArvDevice* device);
  /// The state now. It queries the camera: two packets and their responses at most.
  PtpState read() const;

 private:
  bool enable(const PtpNodes& nodes) const;

  ArvDevice* device_;
  const PtpNodes* nodes_ = nullptr;  // in use
  bool latches_ = false;
  PtpState without_nodes_ = PtpState::kAbsent;
};

}  // namespace pharos::host
