// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "tools/sim/lh2/lh2_simulator.hpp"
#include "tools/sim/pulse_feed.hpp"
#include "tools/sim/truth_log.hpp"

namespace pharos::sim {

/// Gives the changes of a simulated target's receivers at their times.
class Lh2Feed final : public LightFeed {
 public:
  explicit Lh2Feed(Lh2Simulator& simulator) : simulator_(simulator), next_(simulator.next()) {}

  std::optional<std::int64_t> due_ticks() override;
  void give(SimulatedTarget& target) override;

 private:
  Lh2Simulator& simulator_;
  std::optional<LightChange> next_;
};

/// The counter of a scenario of generation 2 against the time since its start.
PlayClock clock_of(const Lh2Simulator& simulator);
/// Its truth, T_world_body under station 0, to be written to `file`: in the body frame of the nominal sensors.
PlayTruth lh2_truth_of(const Lh2Simulator& simulator, const std::string& file);

}  // namespace pharos::sim
