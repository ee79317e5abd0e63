// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/limited_log.hpp"

#include <spdlog/spdlog.h>

namespace pharos::host {

void LimitedLog::info(const char* kind, const std::string& text, std::int64_t now_ns) {
  if (const auto held_back = limit_.pass(kind, now_ns))
    spdlog::info("{}: {}{}", name_, text, held_back_note(*held_back));
}

void LimitedLog::warn(const char* kind, const std::string& text, std::int64_t now_ns) {
  if (const auto held_back = limit_.pass(kind, now_ns))
    spdlog::warn("{}: {}{}", name_, text, held_back_note(*held_back));
}

void LimitedLog::error(const char* kind, const std::string& text, std::int64_t now_ns) {
  if (const auto held_back = limit_.pass(kind, now_ns)) {
    spdlog::error("{}: {}{}", name_, text, held_back_note(*held_back));
  }
}

}  // namespace pharos::host
