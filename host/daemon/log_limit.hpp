// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace pharos::host {

/// Keeps a fault that repeats a thousand times a second from filling the log: each kind of message passes once in
/// `period_ns`, and the next one that passes tells how many were held back.
class LogLimit {
 public:
  explicit LogLimit(std::int64_t period_ns) : period_ns_(period_ns) {}

  /// May a message of this kind be written now? If so: how many of its kind were held back since the last one.
  std::optional<std::uint64_t> pass(const std::string& kind, std::int64_t now_ns) {
    const auto [entry, first] = kinds_.try_emplace(kind, Kind{now_ns, 0});
    Kind& state = entry->second;
    if (!first && now_ns - state.last_ns < period_ns_) {
      ++state.held_back;
      return std::nullopt;
    }
    const std::uint64_t held_back = state.held_back;
    state = {now_ns, 0};
    return held_back;
  }

 private:
  struct Kind {
    std::int64_t last_ns = 0;
    std::uint64_t held_back = 0;
  };
  std::int64_t period_ns_;
  std::map<std::string, Kind> kinds_;
};

}  // namespace pharos::host
