// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/daemon/stereo/stereo_pair.hpp"
#include "host/device/frame_source.hpp"
#include "host/publish/health.hpp"

namespace pharos::host {

/// Status of both cameras together.
struct PairSourceStatus : SourceStatus {
  NamedCounts counters;
  DeliveredFrames pairs;
  std::int64_t contests = 0;  // times frames of two senders came to one of the cameras
  double clock_sigma_ns = 0.0;
  double clock_drift_ppm = 0.0;
};

/// A source of pairs: two cameras on the network, or recorded pairs. To be used from the event loop's thread.
class PairSource {
 public:
  virtual ~PairSource() = default;
  /// Readable while there may be a pair to take.
  virtual std::vector<int> fds() const = 0;
  /// The next pair, or null.
  virtual StereoPairPtr take() = 0;
  /// Returns a pair that is no longer used: its buffers are reused, and a recording at full speed continues.
  virtual void recycle(StereoPairPtr pair) = 0;
  virtual PairSourceStatus status() const = 0;
  /// Readable name of its device.
  virtual std::string device() const = 0;
  /// Readable notice that this computer's clock was recently set; empty otherwise.
  virtual std::string clock_notice(std::int64_t monotonic_ns) const = 0;
  /// Why a camera is not recorded, though it should be; empty otherwise.
  virtual std::string storage_error() const { return {}; }
};

}  // namespace pharos::host
