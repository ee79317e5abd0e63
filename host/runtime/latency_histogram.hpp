// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos::host {

/// A histogram of durations with logarithmic bins: quantiles of any number of durations in 5 KiB.
///
/// Sixteen bins per octave from 1 us to 12.7 days. A quantile is its bin's upper edge: never too small, and at most 4.4
/// % too large. Longer durations are counted in the last bin.
class LatencyHistogram {
 public:
  void add(std::int64_t duration_ns);
  std::uint64_t count() const { return count_; }
  std::int64_t max_ns() const { return max_ns_; }
  /// Upper edge of the bin with quantile `q` (0..1), ns, at most max_ns(), which is also the last bin's edge; 0 while
  /// empty.
  std::int64_t quantile_ns(double q) const;
  void clear() { *this = LatencyHistogram(); }

 private:
  static constexpr int kBinsPerOctave = 16;
  static constexpr int kOctaves = 40;
  static constexpr std::int64_t kSmallest_ns = 1000;

  std::array<std::uint64_t, kBinsPerOctave * kOctaves + 1> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace pharos::host
