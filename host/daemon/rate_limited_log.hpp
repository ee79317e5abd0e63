// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "host/runtime/log_rate_limiter.hpp"

namespace pharos::host {

/// The log of one target's pipeline or port: `NAME: text`, each kind of line at most a few times in ten seconds, so
/// that neither a loose connector nor a hostile target fills the disk. The next line of a kind says how many were
/// suppressed.
class RateLimitedLog {
 public:
  explicit RateLimitedLog(std::string name) : name_(std::move(name)) {}

  // `now_ns`: of any monotonic clock; in a replay that of the recording.
  void info(const char* kind, const std::string& text, std::int64_t now_ns);
  void warn(const char* kind, const std::string& text, std::int64_t now_ns);
  void error(const char* kind, const std::string& text, std::int64_t now_ns);

  /// Number of suppressed lines.
  std::uint64_t suppressed() const { return limit_.suppressed(); }

 private:
  static constexpr std::int64_t kPeriod_ns = 10'000'000'000;
  /// A connector that is removed, inserted badly and inserted again is logged completely.
  static constexpr int kLinesInAPeriod = 4;

  std::string name_;
  LogRateLimiter limit_{kPeriod_ns, kLinesInAPeriod};
};

}  // namespace pharos::host
