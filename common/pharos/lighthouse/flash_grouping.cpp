// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/flash_grouping.hpp"

#include <algorithm>

namespace pharos::lighthouse {

FlashCandidate candidate_of(const FlashGroup& group) {
  const Pulse longest = group[group.longest()];
  return {longest.rise_ticks, longest.width_ticks, static_cast<std::uint32_t>(group.size())};
}

std::size_t FlashGroup::longest() const {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < size_; ++k) {
    if (width_ticks_[k] > width_ticks_[longest]) longest = k;
  }
  return longest;
}

bool FlashGrouping::open(const Pulse& pulse) {
  FlashGroup& group = groups_[1].empty() ? groups_[1] : groups_[0];
  if (!group.empty()) return false;
  group.push(pulse);
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
