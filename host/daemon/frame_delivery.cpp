// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/frame_delivery.hpp"

namespace pharos::host {
namespace {

DeliveryCount told(const RollingCount& counts, std::int64_t now_ns) {
  const DeliveryCount sum = counts.sum(now_ns);
  return counts.full(now_ns) && sum.expected >= FrameDelivery::kMinExpected ? sum : DeliveryCount{};
}

}  // namespace

void FrameDelivery::on_frames(const DeliveredFrames& total, std::int64_t now_ns) {
  const std::int64_t came = total.came - last_.came, lost = total.lost - last_.lost;
  last_ = total;
  if (came > 0 || lost > 0) frames_.add({came, came + lost}, now_ns);
}

DeliveryAssessment FrameDelivery::assess(std::int64_t now_ns) const {
  return assess_delivery(
      {{frames_word_, lost_where_, told(frames_, now_ns)},
       {"poses", "the others are refused: the counters refused... say why", told(answers_, now_ns)}});
}

}  // namespace pharos::host
