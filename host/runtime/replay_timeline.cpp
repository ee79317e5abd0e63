// SPDX-License-Identifier: Apache-2.0
#include "host/runtime/replay_timeline.hpp"

#include <algorithm>
#include <limits>

namespace pharos::host {

ReplayTimeline::Player ReplayTimeline::add(std::int64_t next_ns) {
  next_ns_.emplace_back(next_ns);
  return next_ns_.size() - 1;
}

std::int64_t ReplayTimeline::earliest_ns() const {
  std::int64_t earliest_ns = std::numeric_limits<std::int64_t>::max();
  for (const auto& next_ns : next_ns_) earliest_ns = std::min(earliest_ns, next_ns.value_or(earliest_ns));
  return earliest_ns;
}

std::int64_t ReplayTimeline::wait_ns(Player player) {
  const std::int64_t next_ns = *next_ns_[player], first_ns = earliest_ns();
  if (speed_ == ReplaySpeed::kFastest) return next_ns <= first_ns && held_ == 0 ? 0 : kNotYourTurn_ns;
  const std::int64_t now_ns = clock_.monotonic_ns();
  if (!shift_ns_) shift_ns_ = now_ns - first_ns;
  const std::int64_t silence_ns = first_ns + *shift_ns_ - now_ns;
  if (silence_ns > kLongestSilence_ns) {
    *shift_ns_ -= silence_ns - kLongestSilence_ns;
    ++silences_cut_;
  }
  return std::max<std::int64_t>(next_ns + *shift_ns_ - now_ns, 0);
}

void ReplayTimeline::played(std::int64_t monotonic_ns, std::int64_t utc_ns) {
  played_ns_ = std::max(played_ns_, monotonic_ns);
  utc_minus_monotonic_ns_ = utc_ns - monotonic_ns;
}

std::int64_t ReplayTimeline::monotonic_ns() const {
  if (speed_ == ReplaySpeed::kFastest || !shift_ns_) return played_ns_;
  return std::max(played_ns_, clock_.monotonic_ns() - *shift_ns_);
}

}  // namespace pharos::host
