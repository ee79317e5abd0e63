// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "host/publish/health.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {

/// A source without data for so long is silent.
inline constexpr std::int64_t kSilence_ns = 2'000'000'000;

/// When a pipeline's data and poses came, and how fast: what the health of every pipeline begins with. Times are
/// monotonic.
class RateMonitor {
 public:
  void on_data(std::int64_t now_ns) { data_.add(now_ns); }
  void on_pose(std::int64_t now_ns) {
    pose_.add(now_ns);
    ++poses_;
  }

  bool any_data() const { return data_.last_ns >= 0; }
  bool any_pose() const { return pose_.last_ns >= 0; }
  bool data_within(std::int64_t span_ns, std::int64_t now_ns) const {
    return any_data() && now_ns - data_.last_ns < span_ns;
  }
  bool pose_within(std::int64_t span_ns, std::int64_t now_ns) const {
    return any_pose() && now_ns - pose_.last_ns < span_ns;
  }
  /// Poses that stay away for longer have stopped: two and a half of the intervals at which they come, at least 0.3 s.
  /// `otherwise_ns` while no interval is known.
  std::int64_t absent_after_ns(std::int64_t otherwise_ns) const { return pose_.absent_after_ns(otherwise_ns); }
  /// Data came, and for so long none has come any more; the same rule.
  bool data_stopped(std::int64_t now_ns) const {
    return any_data() && !data_within(data_.absent_after_ns(kSilence_ns), now_ns);
  }

  /// Sets both ages, and the poses per second since the last call.
  void report(SourceHealth& health, std::int64_t now_ns) {
    health.data_age_ns = any_data() ? now_ns - data_.last_ns : -1;
    health.pose_age_ns = any_pose() ? now_ns - pose_.last_ns : -1;
    if (last_report_ns_ >= 0 && now_ns > last_report_ns_) {
      health.pose_rate_hz = static_cast<double>(poses_ - poses_reported_) * static_cast<double>(kNsPerSecond) /
                            static_cast<double>(now_ns - last_report_ns_);
    }
    poses_reported_ = poses_;
    last_report_ns_ = now_ns;
  }

 private:
  // Events at intervals.
  struct Series {
    std::int64_t last_ns = -1;
    std::int64_t interval_ns = 0;  // mean of the last ones; 0: not known

    void add(std::int64_t now_ns) {
      constexpr std::int64_t kMaxGrowth = 4, kAveraged = 8;
      if (const std::int64_t gap_ns = now_ns - last_ns; last_ns >= 0 && interval_ns == 0) {
        interval_ns = gap_ns;
      } else if (last_ns >= 0) {  // a pause is no interval, unless they go on coming so late
        interval_ns += (std::min(gap_ns, kMaxGrowth * interval_ns) - interval_ns) / kAveraged;
      }
      last_ns = now_ns;
    }
    std::int64_t absent_after_ns(std::int64_t otherwise_ns) const {
      constexpr std::int64_t kMinAbsence_ns = 300'000'000;
      return interval_ns == 0 ? otherwise_ns : std::max(kMinAbsence_ns, interval_ns * 5 / 2);
    }
  };

  Series data_, pose_;
  std::int64_t poses_ = 0;
  std::int64_t poses_reported_ = 0;
  std::int64_t last_report_ns_ = -1;
};

}  // namespace pharos::host
