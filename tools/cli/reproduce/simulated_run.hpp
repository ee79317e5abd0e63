// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pharos/lighthouse/calibration_store.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "tools/sim/lighthouse_simulator.hpp"

namespace pharos::tools {

/// One simulated recording of one station, decoded: light pulses through the whole decoder, calibration as the station
/// sent it over OOTX.
class SimulatedRun {
 public:
  SimulatedRun(sim::LighthouseScenario scenario, std::uint64_t seed);

  /// Solves every cycle; `take` gets each answer with the pose that was true at its time.
  void track(const track::TrackOptions& options,
             const std::function<void(const track::EpochResult&, const LighthouseFromBody& truth)>& take) const;
  /// The calibration came twice within the run.
  bool calibrated() const { return calibration_.has_value(); }

 private:
  sim::LighthouseSimulator simulator_;
  std::vector<lighthouse::Sweep> sweeps_;
  std::optional<lighthouse::StationCalibration> calibration_;
};

/// One ideal station before the paper's target, with the noise that the paper measured and nothing else: the start of
/// both experiments.
sim::LighthouseScenario paper_scenario(double duration_s);

}  // namespace pharos::tools
