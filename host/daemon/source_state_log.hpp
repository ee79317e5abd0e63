// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/daemon/rate_limited_log.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// Logs changes of a source: every opening, every new error, and its remark once.
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
    if (status.error == last_logged_) return;
    last_logged_ = status.error;
    if (!last_logged_.empty()) log_.warn("not open", last_logged_, monotonic_ns);
  }

 private:
  RateLimitedLog log_;
  std::string last_logged_;
  std::uint32_t last_logged_session_ = 0;
  bool remarked_ = false;
};

}  // namespace pharos::host
