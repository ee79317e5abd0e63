// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "host/daemon/limited_log.hpp"
#include "host/device/frame_source.hpp"

namespace pharos::host {

/// The log of what changes at a source: every opening, and every trouble when it begins.
class SourceNews {
 public:
  /// `name`: of the line in the configuration.
  explicit SourceNews(const std::string& name) : log_(name) {}

  void tell(const std::string& device, const SourceStatus& status, std::int64_t monotonic_ns) {
    if (status.session != session_told_) {
      session_told_ = status.session;
      log_.info("open", device + " is open: " + status.identity, monotonic_ns);
    }
    if (status.trouble == told_) return;
    told_ = status.trouble;
    if (!told_.empty()) log_.warn("not open", told_, monotonic_ns);
  }

 private:
  LimitedLog log_;
  std::string told_;
  std::uint32_t session_told_ = 0;
};

}  // namespace pharos::host
