// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/simulated_run.hpp"

#include <utility>

#include "pharos/base/units.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "tools/evaluation/reproduce/lighthouse/paper_target.hpp"
#include "tools/sim/body_frame.hpp"

namespace pharos::tools {

SimulatedRun::SimulatedRun(sim::LighthouseScenario scenario, std::uint64_t seed)
    : simulator_(std::move(scenario), seed) {
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  lighthouse::CalibrationStore store;
  const auto take = [&] {
    while (const auto sweep = decoder->take_sweep()) sweeps_.push_back(*sweep);
    while (const auto payload = decoder->take_ootx()) store.push(*payload);
  };
  while (const std::optional<sim::SimulatedPulse> pulse = simulator_.next()) {
    lighthouse::RawPulse raw;
    raw.rise_ticks = pulse->rise_ticks;
    raw.fall_ticks = pulse->fall_ticks;
    raw.sensor = pulse->sensor;
    decoder->push(raw);
    take();
  }
  decoder->flush();
  take();
  if (const lighthouse::StationCalibration* in_use = store.in_use(0)) calibration_ = *in_use;
}

void SimulatedRun::track(
    const track::TrackOptions& options,
    const std::function<void(const track::EpochResult&, const LighthouseFromBody& truth)>& take) const {
  const auto tracker = std::make_unique<track::EpochTracker>(simulator_.nominal_target(), options);
  feed(*tracker, {simulator_.nominal_target(), calibration_, {}, {}}, take);
}

RunAssumptions SimulatedRun::as_announced() const {
  const Target& nominal = simulator_.nominal_target();
  return {nominal, calibration_, sim::body_frame_of(nominal, simulator_.true_target()), motion::kUncalibratedErrors};
}

RunAssumptions SimulatedRun::with_assumptions(const Target& target,
                                              const lighthouse::StationCalibration& station) const {
  return {target, station, sim::body_frame_of(target, simulator_.true_target()), motion::kCalibratedErrors};
}

sim::LighthouseScenario paper_scenario(double duration_s) {
  sim::LighthouseScenario scenario;
  scenario.duration_s = duration_s;
  scenario.target = paper_target();
  scenario.noise.sigma_arcsec = kPaperSigma_rad * kArcsecPerRad;
  scenario.noise.rho = kPaperRho;
  scenario.noise.narrow_sigma_arcsec = 0.0;  // the paper's noise does not depend on the pulse's width
  scenario.stations.emplace_back();
  return scenario;
}

}  // namespace pharos::tools
