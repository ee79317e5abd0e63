// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace pharos::host {

/// Keeps a fault that repeats a thousand times a second from filling the log: each kind of message passes `lines` times
/// in `period_ns`, and the next one that passes tells how many were held back.
class LogRateLimiter {
 public:
  explicit LogRateLimiter(std::int64_t period_ns, int lines = 1) : period_ns_(period_ns), lines_(lines) {}

  /// May a message of this kind be written now? If so: how many of its kind were held back since the last one. Kinds
  /// are the program's own words, never the input's: each takes memory.
  std::optional<std::uint64_t> pass(const std::string& kind, std::int64_t now_ns) {
    const auto entry = kinds_.try_emplace(kind, Kind{now_ns, 0, 0}).first;
    Kind& state = entry->second;
    if (now_ns - state.began_ns >= period_ns_) state = {now_ns, 0, state.suppressed};
    if (state.passed >= lines_) {
      ++state.suppressed;
      ++suppressed_;
      return std::nullopt;
    }
    ++state.passed;
    const std::uint64_t suppressed = state.suppressed;
    state.suppressed = 0;
    return suppressed;
  }

  /// Of all kinds, so far.
  std::uint64_t suppressed() const { return suppressed_; }

 private:
  struct Kind {
    std::int64_t began_ns = 0;  // the period
    int passed = 0;             // in it
    std::uint64_t suppressed = 0;
  };
  std::int64_t period_ns_;
  int lines_;
  std::map<std::string, Kind> kinds_;
  std::uint64_t suppressed_ = 0;
};

/// What pass() returned, as the end of the line; empty for 0.
inline std::string suppressed_note(std::uint64_t suppressed) {
  return suppressed == 0 ? "" : " (" + std::to_string(suppressed) + " more lines like this were held back)";
}

}  // namespace pharos::host
