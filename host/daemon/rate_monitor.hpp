// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/publish/health.hpp"
#include "host/support/time_units.hpp"

namespace pharos::host {

/// Times and rates of a pipeline's data and poses, for the health of every pipeline. Times are monotonic.
class RateMonitor {
 public:
  void on_data(std::int64_t now_ns) { last_data_ns_ = now_ns; }
  void on_pose(std::int64_t now_ns) {
    last_pose_ns_ = now_ns;
    ++poses_;
  }

  bool any_data() const { return last_data_ns_ >= 0; }
  bool any_pose() const { return last_pose_ns_ >= 0; }
  bool data_within(std::int64_t span_ns, std::int64_t now_ns) const {
    return any_data() && now_ns - last_data_ns_ < span_ns;
  }
  bool pose_within(std::int64_t span_ns, std::int64_t now_ns) const {
    return any_pose() && now_ns - last_pose_ns_ < span_ns;
  }

  /// Sets both ages, and the poses per second since the last call.
  void report(SourceHealth& health, std::int64_t now_ns) {
    health.data_age_ns = any_data() ? now_ns - last_data_ns_ : -1;
    health.pose_age_ns = any_pose() ? now_ns - last_pose_ns_ : -1;
    if (last_report_ns_ >= 0 && now_ns > last_report_ns_) {
      health.pose_rate_hz = static_cast<double>(poses_ - poses_reported_) * static_cast<double>(kNsPerSecond) /
                            static_cast<double>(now_ns - last_report_ns_);
    }
    poses_reported_ = poses_;
    last_report_ns_ = now_ns;
  }

 private:
  std::int64_t last_data_ns_ = -1;
  std::int64_t last_pose_ns_ = -1;
  std::int64_t poses_ = 0;
  std::int64_t poses_reported_ = 0;
  std::int64_t last_report_ns_ = -1;
};

}  // namespace pharos::host
