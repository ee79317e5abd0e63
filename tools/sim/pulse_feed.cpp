// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/pulse_feed.hpp"

#include <algorithm>
#include <cstdlib>

#include "tools/sim/simulated_target.hpp"

namespace pharos::sim {
namespace {

constexpr std::size_t kFollowers = 32;
constexpr std::int64_t kCompany_ticks = 100'000'000;  // 2 s

}  // namespace

PulseFeed::PulseFeed(Source source) : source_(std::move(source)) {}

void PulseFeed::fill() {
  while (ahead_.size() <= kFollowers) {
    const std::optional<lighthouse::RawPulse> pulse = source_();
    if (!pulse) return;
    ahead_.push_back(*pulse);
  }
}

bool PulseFeed::has_simultaneous(std::size_t index) const {
  const std::size_t end = std::min(ahead_.size(), index + 1 + kFollowers);
  std::size_t near = 0;
  for (std::size_t i = index + 1; i < end; ++i) {
    if (std::abs(ahead_[i].fall_ticks - ahead_[index].fall_ticks) < kCompany_ticks) ++near;
  }
  return 2 * near >= end - index - 1;
}

std::optional<std::int64_t> PulseFeed::first_ticks() {
  fill();
  for (std::size_t i = 0; i < ahead_.size(); ++i) {
    if (has_simultaneous(i)) return ahead_[i].fall_ticks;
  }
  return std::nullopt;
}

const PulseFeed::Due* PulseFeed::peek() {
  if (next_) return &*next_;
  if (!now_ticks_) now_ticks_ = first_ticks();
  fill();
  if (ahead_.empty()) return nullptr;
  const lighthouse::RawPulse& pulse = ahead_.front();
  if (has_simultaneous(0)) now_ticks_ = std::max(*now_ticks_, pulse.fall_ticks);
  next_ = Due{pulse, now_ticks_.value_or(pulse.fall_ticks)};
  return &*next_;
}

std::optional<std::int64_t> PulseFeed::due_ticks() {
  const Due* due = peek();
  if (due == nullptr) return std::nullopt;
  return due->due_ticks;
}

void PulseFeed::give(SimulatedTarget& target) {
  target.push(peek()->pulse);
  pop();
}

void PulseFeed::pop() {
  ahead_.pop_front();
  next_.reset();
}

}  // namespace pharos::sim
