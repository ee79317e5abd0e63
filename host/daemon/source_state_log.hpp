// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/daemon/rate_limited_log.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// Logs changes of a source: every opening, every new error, every new state of PTP, and its remark once.
class SourceStateLog {
 public:
  /// `name`: of the source in the configuration.
  explicit SourceStateLog(const std::string& name) : log_(name) {}

  void update(const std::string& device, const SourceStatus& status, std::int64_t monotonic_ns) {
    if (status.session != last_logged_session_) {
      last_logged_session_ = status.session;
      log_.info("open", device + " is open: " + status.identity, monotonic_ns);
    }
    if (!status.remark.empty() && !remarked_) log_.info("remark", status.remark, monotonic_ns);
    remarked_ = remarked_ || !status.remark.empty();
    update_ptp(status, monotonic_ns);
    if (status.error == last_logged_) return;
    last_logged_ = status.error;
    if (!last_logged_.empty()) log_.warn("not open", last_logged_, monotonic_ns);
  }

 private:
  // A camera that is not open has no state: the last one is kept, so that opening it anew is no change.
  void update_ptp(const SourceStatus& status, std::int64_t monotonic_ns) {
    if (status.ptp.empty() || status.ptp == last_logged_ptp_) return;
    last_logged_ptp_ = status.ptp;
    if (status.ptp_fault) {
      log_.warn("ptp", status.ptp + ": times are estimated from arrivals", monotonic_ns);
    } else {
      log_.info("ptp", status.ptp, monotonic_ns);
    }
  }

  RateLimitedLog log_;
  std::string last_logged_;
  std::string last_logged_ptp_;
  std::uint32_t last_logged_session_ = 0;
  bool remarked_ = false;
};

}  // namespace pharos::host
