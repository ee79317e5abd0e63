// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/delivery_monitor.hpp"

#include <algorithm>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/optical_timing.hpp"

namespace pharos::host {
DeliveryMonitor::Second& DeliveryMonitor::second_at(std::int64_t now_ns) {
  if (!first_ns_) first_ns_ = now_ns;
  const std::int64_t index = now_ns / kNsPerSecond;
  Second& second = seconds_[static_cast<std::size_t>(index % kWindow_s)];
  if (second.index != index) {
    second = {};
    second.index = index;
  }
  return second;
}

template <class Visitor>
void DeliveryMonitor::for_each_second(std::int64_t now_ns, Visitor&& visit) const {
  const std::int64_t index = now_ns / kNsPerSecond;
  for (const Second& second : seconds_) {
    if (second.index >= 0 && second.index > index - kWindow_s && second.index <= index) visit(second);
  }
}

void DeliveryMonitor::on_link(const wire::LinkCounters& link, std::int64_t now_ns) {
  const auto frames = static_cast<std::int64_t>(link.frames);
  const auto lost = static_cast<std::int64_t>(link.frames_lost);
  if (frames > link_frames_ || lost > link_lost_) {
    DeliveryCount& count = second_at(now_ns).frames;
    count.came += frames - link_frames_;
    count.expected += frames - link_frames_ + lost - link_lost_;
  }
  link_frames_ = frames;
  link_lost_ = lost;
}

void DeliveryMonitor::restart() {
  seconds_ = {};
  last_flash_ticks_ = {};
  first_ns_.reset();
}

void DeliveryMonitor::on_sweep(const lighthouse::Flash& flash, std::int64_t now_ns) {
  const std::size_t index = 2u * flash.station + static_cast<std::size_t>(flash.axis);
  if (index >= kStreams) return;
  const auto last_ticks = last_flash_ticks_[index];
  last_flash_ticks_[index] = flash.start_ticks;
  if (!last_ticks) return;
  const std::int64_t gap_ticks = flash.start_ticks - *last_ticks;
  if (gap_ticks <= 0 || ticks_to_nanoseconds(gap_ticks) > kOutOfSight_ns) return;
  const std::int64_t turns = (gap_ticks + lighthouse::kTurn_ticks / 2) / lighthouse::kTurn_ticks;
  if (turns == 0) return;
  Stream& stream = second_at(now_ns).streams[index];
  ++stream.sweeps;
  stream.turns += turns;
  stream.min_turns = stream.min_turns == 0 ? turns : std::min(stream.min_turns, turns);
}

void DeliveryMonitor::on_answer(bool pose, std::int64_t now_ns) {
  DeliveryCount& count = second_at(now_ns).answers;
  count.came += pose ? 1 : 0;
  ++count.expected;
}

DeliveryCount DeliveryMonitor::sweeps(std::int64_t now_ns) const {
  std::array<Stream, kStreams> sums;
  for_each_second(now_ns, [&](const Second& second) {
    for (std::size_t i = 0; i < kStreams; ++i) {
      const Stream& stream = second.streams[i];
      if (stream.sweeps == 0) continue;
      Stream& sum = sums[i];
      sum.min_turns = sum.sweeps == 0 ? stream.min_turns : std::min(sum.min_turns, stream.min_turns);
      sum.sweeps += stream.sweeps;
      sum.turns += stream.turns;
    }
  });
  DeliveryCount count;
  for (const Stream& sum : sums) {
    count.came += sum.sweeps;
    if (sum.sweeps > 0) count.expected += sum.turns / sum.min_turns;
  }
  return count;
}

DeliveryAssessment DeliveryMonitor::assess(std::int64_t now_ns) const {
  if (!first_ns_ || now_ns - *first_ns_ < kWindow_s * kNsPerSecond) return {};
  DeliveryCount frames, answers;
  for_each_second(now_ns, [&](const Second& second) {
    frames.came += second.frames.came;
    frames.expected += second.frames.expected;
    answers.came += second.answers.came;
    answers.expected += second.answers.expected;
  });
  return assess_delivery(
      {{"frames", "the serial line loses them: look at its cable, its baud rate and the load of this computer", frames},
       {"sweeps", "flashes or lasers are not seen: look for occlusion, range and strong light", sweeps(now_ns)},
       {"poses", "cycles are refused: the counters cycles_refused_... say why", answers}});
}

}  // namespace pharos::host
