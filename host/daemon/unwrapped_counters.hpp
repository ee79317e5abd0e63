// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pharos::host {

/// Extends a target's 32-bit counters to counts that do not wrap (10,000 edges per second wrap after five days).
///
/// A value lower than the last one has wrapped if the increase modulo 2^32 is less than half of the range; otherwise it
/// was really lowered (a gauge, or a target that restarted) and is used as it is.
class UnwrappedCounters {
 public:
  /// Takes the received counters, once a second.
  template <class Counters>
  void take(const Counters& counters) {
    std::size_t at = 0;
    for_each_counter(counters, [&](const char*, std::uint32_t value, const char*) { take_one(at++, value); });
  }
  /// Calls visit(name, unwrapped value, what it counts) for every counter of the last take().
  template <class Counters, class Visitor>
  void visit(const Counters& names, Visitor&& visit) const {
    if (counts_.empty()) return;
    std::size_t at = 0;
    for_each_counter(names,
                     [&](const char* name, std::uint32_t, const char* text) { visit(name, counts_[at++], text); });
  }
  bool empty() const { return counts_.empty(); }
  /// The target restarted.
  void clear() { counts_.clear(); }

 private:
  void take_one(std::size_t at, std::uint32_t value) {
    if (at == counts_.size()) {
      counts_.push_back(value);
      return;
    }
    constexpr std::uint32_t kHalfRange = 1u << 31;
    const auto rise = value - static_cast<std::uint32_t>(counts_[at]);
    counts_[at] = rise < kHalfRange ? counts_[at] + rise : value;
  }

  std::vector<std::int64_t> counts_;
};

}  // namespace pharos::host
