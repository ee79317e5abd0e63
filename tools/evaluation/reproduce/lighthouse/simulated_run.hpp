// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/calibration_store.hpp"
#include "pharos/lighthouse/sweep.hpp"
#include "pharos/motion/hypothesis.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "tools/sim/lighthouse_simulator.hpp"

namespace pharos::tools {

/// What whoever tracks a simulated target believes of target and station.
struct RunAssumptions {
  Target target;
  std::optional<lighthouse::StationCalibration> station;
  /// The body frame that these sensors mean in that of the sensors as built, by least squares: what a hand-eye
  /// calibration against another measuring system finds.
  Pose<frame::Body, frame::Body> T_true_assumed;
  motion::SystematicErrors systematic = motion::kUncalibratedErrors;
};

/// One simulated recording of one station, decoded: light pulses through the whole decoder, calibration as the station
/// sent it over OOTX.
class SimulatedRun {
 public:
  SimulatedRun(sim::LighthouseScenario scenario, std::uint64_t seed);

  /// Solves every cycle; `take` gets each answer with the pose that was true at its time.
  void track(const track::TrackOptions& options,
             const std::function<void(const track::EpochResult&, const LighthouseFromBody& truth)>& take) const;
  /// The same with a tracker of either kind and what it is told; the truth is that of the body frame believed in.
  template <class Tracker>
  void feed(Tracker& tracker, const RunAssumptions& assumptions,
            const std::function<void(const track::EpochResult&, const LighthouseFromBody& truth)>& take) const {
    if (assumptions.station) tracker.set_calibration(0, *assumptions.station);
    const auto give = [&](const track::EpochResult& result) {
      take(result, simulator_.truth(0, ticks_to_seconds(result.time_ticks)) * assumptions.T_true_assumed);
    };
    for (const lighthouse::Sweep& sweep : sweeps_) {
      if (const auto result = tracker.push(sweep)) give(*result);
    }
    while (const auto result = tracker.flush()) give(*result);
  }
  /// The target's table and what the station sends.
  RunAssumptions as_announced() const;
  /// What a calibration says.
  RunAssumptions with_assumptions(const Target& target, const lighthouse::StationCalibration& station) const;

  /// The calibration came twice within the run.
  bool calibrated() const { return calibration_.has_value(); }
  const sim::LighthouseSimulator& simulator() const { return simulator_; }
  const std::vector<lighthouse::Sweep>& sweeps() const { return sweeps_; }

 private:
  sim::LighthouseSimulator simulator_;
  std::vector<lighthouse::Sweep> sweeps_;
  std::optional<lighthouse::StationCalibration> calibration_;
};

/// One ideal station before the paper's target, with the noise that the paper measured and nothing else: the start of
/// both experiments.
sim::LighthouseScenario paper_scenario(double duration_s);

}  // namespace pharos::tools
