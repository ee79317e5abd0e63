// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pharos::host {

/// What a message tells of a camera's measurement beside its pose, in this computer's time.
struct CameraReport {
  std::int64_t utc_ns = 0;        // of the measurement
  std::int64_t utc_sigma_ns = 0;  // as the clock mapping states it
  std::int64_t latency_ns = 0;    // from the (last) frame to now
  std::int64_t sequence = 0;
  std::string source;
  std::string camera;
  std::string target;
  std::string flags;  // words joined by '|'
  int observations = 0;
  /// Where there is no pose: why, as the `<reason>` of refused_<reason>; empty where there is one.
  std::string refusal;
};

}  // namespace pharos::host
