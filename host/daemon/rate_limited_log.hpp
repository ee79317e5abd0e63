// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "host/runtime/log_rate_limiter.hpp"

namespace pharos::host {

/// The log of one target's line or port: `NAME: text`, each kind of line a few times in ten seconds and no more, so
/// that neither a flapping plug nor a hostile target fills the disk. The next line of a kind tells how many were held
/// back.
class RateLimitedLog {
 public:
  explicit RateLimitedLog(std::string name) : name_(std::move(name)) {}

  // `now_ns`: of any clock that goes forwards; for a replay that of its recording.
  void info(const char* kind, const std::string& text, std::int64_t now_ns);
  void warn(const char* kind, const std::string& text, std::int64_t now_ns);
  void error(const char* kind, const std::string& text, std::int64_t now_ns);

  /// Lines held back so far.
  std::uint64_t suppressed() const { return limit_.suppressed(); }

 private:
  static constexpr std::int64_t kPeriod_ns = 10'000'000'000;
  /// A plug pulled, put in askew and put in again is told in full.
  static constexpr int kLinesInAPeriod = 4;

  std::string name_;
  LogRateLimiter limit_{kPeriod_ns, kLinesInAPeriod};
};

}  // namespace pharos::host
