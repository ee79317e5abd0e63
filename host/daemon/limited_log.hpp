// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "host/daemon/log_limit.hpp"

namespace pharos::host {

/// The log of one target's line or port: `NAME: text`, each kind of line a few times in ten seconds and no more, so
/// that neither a flapping plug nor a hostile target fills the disk. The next line of a kind tells how many were held
/// back.
class LimitedLog {
 public:
  explicit LimitedLog(std::string name) : name_(std::move(name)) {}

  // `now_ns`: of any clock that goes forwards; for a replay that of its recording.
  void info(const char* kind, const std::string& text, std::int64_t now_ns);
  void warn(const char* kind, const std::string& text, std::int64_t now_ns);
  void error(const char* kind, const std::string& text, std::int64_t now_ns);

  /// Lines held back so far.
  std::uint64_t held_back() const { return limit_.held_back(); }

 private:
  static constexpr std::int64_t kPeriodNs = 10'000'000'000;
  /// A plug pulled, put in askew and put in again is told in full.
  static constexpr int kLinesInAPeriod = 4;

  std::string name_;
  LogLimit limit_{kPeriodNs, kLinesInAPeriod};
};

}  // namespace pharos::host
