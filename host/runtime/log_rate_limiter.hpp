// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace pharos::host {

/// Keeps a fault that repeats a thousand times a second from filling the log: each kind of message is written at most
/// `lines` times in `period_ns`, and the next one written says how many were suppressed.
class LogRateLimiter {
 public:
  explicit LogRateLimiter(std::int64_t period_ns, int lines = 1) : period_ns_(period_ns), lines_(lines) {}

  /// Whether a message of this kind may be written now; if so, the number suppressed since the last one. Each kind uses
  /// memory, so kinds must be constants of the program and never text from input.
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

  /// Suppressed messages of all kinds so far.
  std::uint64_t suppressed() const { return suppressed_; }

 private:
  struct Kind {
    std::int64_t began_ns = 0;  // begin of the period
    int passed = 0;             // written in the period
    std::uint64_t suppressed = 0;
  };
  std::int64_t period_ns_;
  int lines_;
  std::map<std::string, Kind> kinds_;
  std::uint64_t suppressed_ = 0;
};

/// The number that pass() returned, as text for the end of the line; empty for 0.
inline std::string suppressed_note(std::uint64_t suppressed) {
  return suppressed == 0 ? "" : " (" + std::to_string(suppressed) + " more lines like this were held back)";
}

}  // namespace pharos::host
