// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/flash_grouping.hpp"

#include <algorithm>

namespace pharos::lighthouse {

FlashCandidate candidate_of(const FlashGroup& group) {
  FlashCandidate candidate;
  for (std::size_t k = 0; k < group.size(); ++k) {
    const Pulse pulse = group[k];
    if (pulse.width_ticks > candidate.length_ticks) {
      candidate.length_ticks = pulse.width_ticks;
      candidate.start_ticks = pulse.rise_ticks;
    }
  }
  candidate.sensors = static_cast<std::uint8_t>(group.size());
  return candidate;
}

bool FlashGrouping::push(const Pulse& pulse) {
  FlashGroup* free = nullptr;
  for (FlashGroup& group : groups_) {
    if (group.empty()) {
      free = &group;
      continue;
    }
    if (group.rises_with(pulse) && group.push(pulse)) return true;
  }
  if (free == nullptr) return false;
  free->push(pulse);
  refresh_deadline();
  return true;
}

FlashGroup& FlashGrouping::first_to_close() {
  return groups_[1].empty() || (!groups_[0].empty() && groups_[0].deadline_ticks() <= groups_[1].deadline_ticks())
             ? groups_[0]
             : groups_[1];
}

void FlashGrouping::close(FlashGroup& group) {
  group.clear();
  refresh_deadline();
}

void FlashGrouping::refresh_deadline() {
  deadline_ = INT64_MAX;
  for (const FlashGroup& group : groups_) {
    if (!group.empty()) deadline_ = std::min(deadline_, group.deadline_ticks());
  }
}

}  // namespace pharos::lighthouse
