// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace pharos::host {

/// Keeps a fault that repeats a thousand times a second from filling the log: each kind of message passes `lines` times
/// in `period_ns`, and the next one that passes tells how many were held back.
class LogLimit {
 public:
  explicit LogLimit(std::int64_t period_ns, int lines = 1) : period_ns_(period_ns), lines_(lines) {}

  /// May a message of this kind be written now? If so: how many of its kind were held back since the last one. Kinds
  /// are the program's own words, never the input's: each takes memory.
  std::optional<std::uint64_t> pass(const std::string& kind, std::int64_t now_ns) {
    const auto entry = kinds_.try_emplace(kind, Kind{now_ns, 0, 0}).first;
    Kind& state = entry->second;
    if (now_ns - state.began_ns >= period_ns_) state = {now_ns, 0, state.held_back};
    if (state.passed >= lines_) {
      ++state.held_back;
      ++held_back_;
      return std::nullopt;
    }
    ++state.passed;
    const std::uint64_t held_back = state.held_back;
    state.held_back = 0;
    return held_back;
  }

  /// Of all kinds, so far.
  std::uint64_t held_back() const { return held_back_; }

 private:
  struct Kind {
    std::int64_t began_ns = 0;  // the period
    int passed = 0;             // in it
    std::uint64_t held_back = 0;
  };
  std::int64_t period_ns_;
  int lines_;
  std::map<std::string, Kind> kinds_;
  std::uint64_t held_back_ = 0;
};

/// What pass() returned, as the end of the line; empty for 0.
inline std::string held_back_note(std::uint64_t held_back) {
  return held_back == 0 ? "" : " (" + std::to_string(held_back) + " more lines like this were held back)";
}

}  // namespace pharos::host
