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

/// Target and station parameters assumed by the tracker.
struct RunAssumptions {
  Target target;
  std::optional<lighthouse::StationCalibration> station;
  /// The body frame defined by these sensors in that of the true sensors, by least squares: the result of a hand-eye
  /// calibration with another measuring system.
  Pose<frame::Body, frame::Body> T_true_assumed;
  motion::SystematicErrors systematic = motion::kUncalibratedErrors;
};

/// One simulated recording of one station, decoded: light pulses through the whole decoder, calibration from OOTX.
class SimulatedRun {
 public:
  SimulatedRun(sim::LighthouseScenario scenario, std::uint64_t seed);

  /// Solves every cycle; calls `take` with each result and the true pose at its time.
  void track(const track::TrackOptions& options,
             const std::function<void(const track::EpochResult&, const LighthouseFromBody& truth)>& take) const;
  /// The same with a tracker of either kind and its assumed parameters; the truth is in the assumed body frame.
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
  /// Parameters of the target's table and OOTX.
  RunAssumptions as_announced() const;
  /// Parameters of a calibration.
  RunAssumptions with_assumptions(const Target& target, const lighthouse::StationCalibration& station) const;

  /// The calibration was received twice within the run.
  bool calibrated() const { return calibration_.has_value(); }
  const sim::LighthouseSimulator& simulator() const { return simulator_; }
  const std::vector<lighthouse::Sweep>& sweeps() const { return sweeps_; }

 private:
  sim::LighthouseSimulator simulator_;
  std::vector<lighthouse::Sweep> sweeps_;
  std::optional<lighthouse::StationCalibration> calibration_;
};

/// One ideal station and the paper's target, with only the noise that the paper measured: the basis of both
/// experiments.
sim::LighthouseScenario paper_scenario(double duration_s);

}  // namespace pharos::tools
