// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/clock_step_monitor.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace pharos::host {
namespace {

constexpr std::int64_t kNotice_ns = 60'000'000'000;

}  // namespace

bool ClockStepMonitor::update(const ClockMap& map, std::int64_t monotonic_ns) {
  if (map.counters().host_jumps == seen_) return false;
  seen_ = map.counters().host_jumps;
  at_ns_ = monotonic_ns;
  by_ns_ = map.last_jump_ns();
  return true;
}

std::string ClockStepMonitor::notice(std::int64_t monotonic_ns) const {
  if (at_ns_ < 0 || monotonic_ns - at_ns_ >= kNotice_ns) return "";
  const double jump_s = static_cast<double>(by_ns_) * 1e-9;
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      "this computer's clock was set %s by %.1f s; utime of poses went with it, they carry the flag clock_set",
      jump_s < 0.0 ? "back" : "forward", std::abs(jump_s));
  return text.data();
}

}  // namespace pharos::host
