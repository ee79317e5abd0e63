// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "host/support/time_units.hpp"

namespace pharos::host {

/// So much of something came, of so much that should have.
struct DeliveryCount {
  std::int64_t came = 0;
  std::int64_t expected = 0;

  double fraction() const { return expected > 0 ? static_cast<double>(came) / static_cast<double>(expected) : 1.0; }
};

/// What came of the last ten seconds, in steps of one second. Times are monotonic.
class RollingCount {
 public:
  static constexpr std::int64_t kWindow_s = 10;

  void add(const DeliveryCount& count, std::int64_t now_ns) {
    if (!first_ns_) first_ns_ = now_ns;
    const std::int64_t index = now_ns / kNsPerSecond;
    Second& second = seconds_[static_cast<std::size_t>(index % kWindow_s)];
    if (second.index != index) second = {index, {}};
    second.count.came += count.came;
    second.count.expected += count.expected;
  }
  DeliveryCount sum(std::int64_t now_ns) const {
    const std::int64_t index = now_ns / kNsPerSecond;
    DeliveryCount sum;
    for (const Second& second : seconds_) {
      if (second.index < 0 || second.index <= index - kWindow_s || second.index > index) continue;
      sum.came += second.count.came;
      sum.expected += second.count.expected;
    }
    return sum;
  }
  /// The whole window has been seen since the first count.
  bool full(std::int64_t now_ns) const { return first_ns_ && now_ns - *first_ns_ >= kWindow_s * kNsPerSecond; }

 private:
  struct Second {
    std::int64_t index = -1;
    DeliveryCount count;
  };
  std::array<Second, kWindow_s> seconds_;
  std::optional<std::int64_t> first_ns_;
};

}  // namespace pharos::host
