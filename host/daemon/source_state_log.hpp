// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/daemon/rate_limited_log.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// The log of what changes at a source: every opening, and every trouble when it begins.
class SourceNews {
 public:
  /// `name`: of the line in the configuration.
  explicit SourceNews(const std::string& name) : log_(name) {}

  void tell(const std::string& device, const SourceStatus& status, std::int64_t monotonic_ns) {
    if (status.session != logged_session_) {
      logged_session_ = status.session;
      log_.info("open", device + " is open: " + status.identity, monotonic_ns);
    }
    if (status.error == told_) return;
    told_ = status.error;
    if (!told_.empty()) log_.warn("not open", told_, monotonic_ns);
  }

 private:
  RateLimitedLog log_;
  std::string told_;
  std::uint32_t logged_session_ = 0;
};

}  // namespace pharos::host
