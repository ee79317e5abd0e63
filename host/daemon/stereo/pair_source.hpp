// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/daemon/stereo/stereo_pair.hpp"
#include "host/device/frame_source.hpp"
#include "host/publish/health.hpp"

namespace pharos::host {

/// Of both cameras together.
struct PairSourceStatus : SourceStatus {
  NamedCounts counters;
  double clock_sigma_ns = 0.0;
  double clock_drift_ppm = 0.0;
};

/// Where pairs come from: two cameras on the network, or recorded ones. One thread, the loop's.
class PairSource {
 public:
  virtual ~PairSource() = default;
  /// Readable while there may be something to take.
  virtual std::vector<int> fds() const = 0;
  /// The next pair, or null.
  virtual StereoPairPtr take() = 0;
  /// A pair that nobody looks at any more: its buffers go round, and a recording at full speed goes on.
  virtual void recycle(StereoPairPtr pair) = 0;
  virtual PairSourceStatus status() const = 0;
  /// What it reads from, for people.
  virtual std::string device() const = 0;
  /// That this computer's clock was set a moment ago, for people; empty when it was not.
  virtual std::string clock_notice(std::int64_t monotonic_ns) const = 0;
};

}  // namespace pharos::host
