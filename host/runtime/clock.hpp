// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/runtime/now.hpp"

namespace pharos::host {

/// The two clocks of this computer, handed to whatever judges ages and time-outs: a test hands in one that it moves.
/// Read by the loop's thread alone. Time that work takes (histograms of stages) is measured on the computer's own.
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
