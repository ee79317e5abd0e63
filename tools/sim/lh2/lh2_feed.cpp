// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/lh2/lh2_feed.hpp"

#include "tools/sim/body_frame.hpp"
#include "tools/sim/simulated_target.hpp"

namespace pharos::sim {

std::optional<std::int64_t> Lh2Feed::due_ticks() {
  if (!next_) return std::nullopt;
  return next_->time_ticks;
}

void Lh2Feed::give(SimulatedTarget& target) {
  target.push(lighthouse::Lh2Edge{next_->time_ticks, next_->sensor, next_->data, !next_->envelope});
  next_ = simulator_.next();
}

PlayClock clock_of(const Lh2Simulator& simulator) {
  const TargetClock clock = simulator.clock();
  return {[clock](std::int64_t ticks) { return clock.true_time(static_cast<double>(ticks) * 20e-9); },
          [clock](double time_s) { return clock.stamp(time_s); }};
}

PlayTruth lh2_truth_of(const Lh2Simulator& simulator, const std::string& file) {
  const auto T_built_nominal = body_frame_of(simulator.nominal_target(), simulator.true_target());
  const auto at = [&simulator, T_built_nominal](std::size_t, double time_s) {
    const RoomFromBody T = simulator.truth(simulator.clock().counter_time(time_s)) * T_built_nominal;
    return LighthouseFromBody{T.R, T.t};
  };
  return {at, 1, simulator.scenario().duration_s, file};
}

}  // namespace pharos::sim
