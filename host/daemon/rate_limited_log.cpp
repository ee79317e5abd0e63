// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/rate_limited_log.hpp"

#include <spdlog/spdlog.h>

namespace pharos::host {

void RateLimitedLog::info(const char* kind, const std::string& text, std::int64_t now_ns) {
  if (const auto suppressed = limit_.pass(kind, now_ns))
    spdlog::info("{}: {}{}", name_, text, suppressed_note(*suppressed));
}

void RateLimitedLog::warn(const char* kind, const std::string& text, std::int64_t now_ns) {
  if (const auto suppressed = limit_.pass(kind, now_ns))
    spdlog::warn("{}: {}{}", name_, text, suppressed_note(*suppressed));
}

void RateLimitedLog::error(const char* kind, const std::string& text, std::int64_t now_ns) {
  if (const auto suppressed = limit_.pass(kind, now_ns)) {
    spdlog::error("{}: {}{}", name_, text, suppressed_note(*suppressed));
  }
}

}  // namespace pharos::host
