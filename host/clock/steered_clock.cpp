// SPDX-License-Identifier: Apache-2.0
#include "host/clock/steered_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pharos::host {
namespace {

/// Time constant with which an error is slewed to zero: within seconds, yet slowly enough to smooth the estimate.
constexpr double kSteering_ns = 0.5e9;
constexpr double kLargestRateChange = 0.5;
/// A larger error is not slewed but corrected at once (without a reset only forwards).
constexpr std::int64_t kJump_ns = 1'000'000'000;
constexpr std::int64_t kMinKnotDistance_ns = 20'000'000;

}  // namespace

std::int64_t SteeredClock::Knot::at(std::int64_t when_ns) const {
  const std::int64_t elapsed_ns = when_ns - time_ns;
  // Only the small difference is computed in floating point: UTC in ns has more digits than a double.
  return shown_ns + elapsed_ns + std::llround((rate - 1.0) * static_cast<double>(elapsed_ns));
}

void SteeredClock::steer(std::int64_t time_ns, std::int64_t wanted_ns, double rate) {
  if (knots_.empty()) {
    const std::int64_t start_ns = std::max(wanted_ns, latest_shown_ns_);
    knots_.push_back({time_ns, start_ns, rate});
    remaining_ns_ = wanted_ns - start_ns;
    return;
  }
  const Knot& last = knots_.back();
  const std::int64_t shown_ns = last.at(time_ns);
  remaining_ns_ = wanted_ns - shown_ns;
  if (time_ns - last.time_ns < kMinKnotDistance_ns) return;
  Knot next{time_ns, shown_ns, rate};
  if (remaining_ns_ > kJump_ns) {
    next.shown_ns = wanted_ns;
    remaining_ns_ = 0;
  } else {
    const double change = static_cast<double>(remaining_ns_) / kSteering_ns;
    next.rate *= 1.0 + std::clamp(change, -kLargestRateChange, kLargestRateChange);
  }
  knots_.push_back(next);
  while (knots_.size() > 1 && knots_[1].time_ns < time_ns - kMemory_ns) knots_.pop_front();
}

const SteeredClock::Knot& SteeredClock::knot_for(std::int64_t time_ns) const {
  for (auto knot = knots_.rbegin(); knot != knots_.rend(); ++knot) {
    if (knot->time_ns <= time_ns) return *knot;
  }
  return knots_.front();
}

std::optional<std::int64_t> SteeredClock::read(std::int64_t time_ns) {
  if (knots_.empty() || std::abs(time_ns - knots_.back().time_ns) > kMemory_ns) return std::nullopt;
  std::int64_t shown_ns = knot_for(time_ns).at(time_ns);
  if (time_ns >= latest_read_time_ns_) {
    shown_ns = std::max(shown_ns, latest_shown_ns_);
    latest_read_time_ns_ = time_ns;
    latest_shown_ns_ = shown_ns;
  }
  return shown_ns;
}

bool SteeredClock::would_jump(std::int64_t change_ns) const { return std::abs(remaining_ns_ + change_ns) > kJump_ns; }

void SteeredClock::reset() {
  restart();
  latest_shown_ns_ = std::numeric_limits<std::int64_t>::min();
  remaining_ns_ = 0;
}

void SteeredClock::restart() {
  knots_.clear();
  latest_read_time_ns_ = std::numeric_limits<std::int64_t>::min();
}

}  // namespace pharos::host
