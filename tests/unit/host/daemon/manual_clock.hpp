// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/runtime/clock.hpp"

namespace pharos::host::test {

/// A clock that only the test advances, so that ages do not depend on the load of the machine.
class ManualClock final : public Clock {
 public:
  std::int64_t utc_ns() const override { return utc_minus_monotonic_ns_ + monotonic_ns(); }
  std::int64_t monotonic_ns() const override { return monotonic_ns_ += step_ns_; }

  void advance(std::int64_t ns) { monotonic_ns_ += ns; }
  /// Every reading advances the clock by this: a simulated duration of the work between two readings.
  void step_at_readings(std::int64_t ns) { step_ns_ = ns; }

 private:
  mutable std::int64_t monotonic_ns_ = 40'000'000'000;
  std::int64_t utc_minus_monotonic_ns_ = 1'700'000'000'000'000'000;
  std::int64_t step_ns_ = 0;
};

}  // namespace pharos::host::test
