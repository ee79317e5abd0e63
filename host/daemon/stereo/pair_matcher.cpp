// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/pair_matcher.hpp"

#include <algorithm>
#include <cstdlib>

namespace pharos::host {

void PairMatcher::drop_oldest(std::size_t side) {
  on_unpaired_(side, std::move(waiting_[side].front().frame));
  waiting_[side].pop_front();
  ++unpaired_[side];
}

void PairMatcher::clear() {
  for (std::size_t side = 0; side < waiting_.size(); ++side) {
    while (!waiting_[side].empty()) drop_oldest(side);
  }
}

std::optional<std::array<TimedFrame, 2>> PairMatcher::push(std::size_t side, TimedFrame frame) {
  std::deque<TimedFrame>& own = waiting_[side];
  std::deque<TimedFrame>& others = waiting_[1 - side];
  const std::int64_t utc_ns = frame.time.utc_ns;
  // Later frames of this side have later times, so that these frames cannot get a partner.
  while (!others.empty() && others.front().time.utc_ns < utc_ns - window_ns_) drop_oldest(1 - side);
  const auto gap_ns = [utc_ns](const TimedFrame& other) { return std::abs(other.time.utc_ns - utc_ns); };
  const auto nearest = std::min_element(others.begin(), others.end(),
                                        [&](const auto& a, const auto& b) { return gap_ns(a) < gap_ns(b); });
  if (nearest == others.end() || gap_ns(*nearest) > window_ns_) {
    own.push_back(std::move(frame));
    if (own.size() > kMaxWaiting) drop_oldest(side);
    return std::nullopt;
  }
  // Pairs are in the order of time on both sides: older frames on either side cannot get a partner any more.
  for (auto older = nearest - others.begin(); older > 0; --older) drop_oldest(1 - side);
  while (!own.empty()) drop_oldest(side);
  std::array<TimedFrame, 2> pair;
  pair[side] = std::move(frame);
  pair[1 - side] = std::move(others.front());
  others.pop_front();
  return pair;
}

}  // namespace pharos::host
