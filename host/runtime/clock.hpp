// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/runtime/now.hpp"

namespace pharos::host {

/// The two clocks of this computer, passed to everything that depends on ages and time-outs; tests pass one that they
/// advance. Read only by the event loop's thread. Durations of work (histograms of stages) use the computer's own
/// clock.
class Clock {
 public:
  virtual ~Clock() = default;
  /// As utc_now_ns().
  virtual std::int64_t utc_ns() const = 0;
  /// As monotonic_now_ns().
  virtual std::int64_t monotonic_ns() const = 0;
};

class SystemClock final : public Clock {
 public:
  std::int64_t utc_ns() const override { return utc_now_ns(); }
  std::int64_t monotonic_ns() const override { return monotonic_now_ns(); }
};

}  // namespace pharos::host
