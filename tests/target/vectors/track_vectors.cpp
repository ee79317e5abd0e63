// SPDX-License-Identifier: Apache-2.0
// Sweeps of a moving target -> one result a cycle, with the station's calibration, as on the target.
#include "pharos/lighthouse/station_model.hpp"
#include "pharos/report/reporter.hpp"
#include "pharos/track/epoch_tracker.hpp"
#include "tests/target/vectors/problem.hpp"
#include "tests/target/vectors/result_line.hpp"
#include "tests/target/vectors/vectors.hpp"

namespace pharos::test {
namespace {

using lighthouse::StationCalibration;
using lighthouse::Sweep;

constexpr std::int64_t kHalfTurn = 416'667;
constexpr double kTurn = 833'334.0;

Sweep sweep_of(const Target& target, const LighthouseFromBody& pose, const StationCalibration& station, Axis axis,
               std::int64_t start_ticks, Draw& draw) {
  Sweep sweep;
  sweep.flash = {.start_ticks = start_ticks + draw.integer(-6, 6), .length_ticks = 3'140, .axis = axis, .sensors = 8};
  sweep.period_sixteenth_ticks = static_cast<std::uint32_t>(kTurn * 16);
  const auto seen = pose::visible_sensors(target, pose);
  for (const SensorPlacement& s : target) {
    if (!seen.test(s.sensor)) continue;
    const double theta = lighthouse::raw_theta(station, lighthouse::ModelForm::kForm1, axis, pose * s.position_m);
    const auto centre = static_cast<std::int32_t>(std::llround(2.0 * theta / kTwoPi * kTurn));
    sweep.hits.push_back({s.sensor, 200, centre + static_cast<std::int32_t>(draw.integer(-10, 10))});
  }
  return sweep;
}

void print_sweep(const Sweep& sweep) {
  ResultLine line("track_input");
  line << sweep.flash.start_ticks;
  for (const auto& hit : sweep.hits) line << hit.sensor << hit.centre_half_ticks;
}

}  // namespace

void track_vectors() {
  const Target target = frustum_target();
  StationCalibration station;
  station.id = 0xBEC08E38;
  station.rotor[0] = {0.0156, 0.0003, -0.0018, -0.327, 0.00425};
  station.rotor[1] = {0.0382, 0.0022, -0.0017, -1.508, -0.00576};
  track::TrackOptions options;
  options.warm_start = true;
  track::EpochTracker tracker(target, options);
  tracker.set_calibration(0, station);
  Draw draw(6);
  LighthouseFromBody pose = draw_view(target, draw);
  for (int cycle = 0; cycle < 40; ++cycle) {
    pose.t += Vector3(0.002, -0.001, 0.003);
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const Sweep sweep = sweep_of(target, pose, station, axis, (2 * cycle + index_of(axis)) * kHalfTurn, draw);
      print_sweep(sweep);
      const auto result = tracker.push(sweep);
      if (!result) continue;
      ResultLine("cycle") << result->station << result->flags << result->time_ticks << result->observations;
      print_result(result->pose);
    }
  }
}

}  // namespace pharos::test
