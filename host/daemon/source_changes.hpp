// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/daemon/delivery_assessment.hpp"
#include "host/daemon/rate_limited_log.hpp"
#include "host/daemon/rate_monitor.hpp"

namespace pharos::host {

/// What nobody should wait a second for: poses that stop (LOST) or come (FOUND), and what part of the expected comes.
/// The log tells each change once.
class SourceChanges {
 public:
  /// `first_wait_ns`: poses that stay away longer have stopped, while it is not known how often they come.
  explicit SourceChanges(std::int64_t first_wait_ns) : first_wait_ns_(first_wait_ns) {}

  /// Poses come now.
  bool in_sight(const RateMonitor& rate, std::int64_t now_ns) const {
    return rate.pose_within(rate.absent_after_ns(first_wait_ns_), now_ns);
  }
  /// True where something changed since the last call. `refusal`: why the last picture or cycle has no pose, or empty.
  bool update(const RateMonitor& rate, const DeliveryAssessment& delivery, const std::string& refusal,
              RateLimitedLog& log, std::int64_t now_ns);

 private:
  bool sight_changed(const RateMonitor& rate, const std::string& refusal, RateLimitedLog& log, std::int64_t now_ns);
  bool delivery_changed(const DeliveryAssessment& delivery, RateLimitedLog& log, std::int64_t now_ns);

  std::int64_t first_wait_ns_;
  bool in_sight_ = false;
  SourceState last_logged_ = SourceState::kOk;
};

}  // namespace pharos::host
