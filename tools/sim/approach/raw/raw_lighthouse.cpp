// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "host/table/target_file.hpp"
#include "tools/sim/approach/raw/raw_source.hpp"
#include "tools/sim/body_frame.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/sim/recording_tables.hpp"
#include "tools/sim/recording_writer.hpp"
#include "tools/sim/target_clock.hpp"

namespace pharos::sim {
namespace {

// The source's view of the target: the room is the station's frame, time the source's since its first light.
class SourceTrajectory final : public Trajectory {
 public:
  // T_feature_body: where the true sensors' frame is on the feature's, the frame that a calibration finds.
  SourceTrajectory(const ApproachSimulator& simulator, std::size_t source, double from_s,
                   const Pose<frame::Feature, frame::Body>& T_feature_body)
      : truth_(simulator.truth()),
        T_sensor_vehicle_(simulator.true_mounting().sources[source].vehicle_from_sensor().inverse()),
        T_target_body_(*simulator.true_mounting().sources[source].target_from_feature() * T_feature_body),
        start_s_(from_s + simulator.scenario().sources[source].time_offset_s) {}

  RoomFromBody at(double time_s) const override {
    const auto pose = T_sensor_vehicle_ * truth_.at(start_s_ + time_s) * T_target_body_;
    return {pose.R, pose.t};
  }

 private:
  const ApproachTruth& truth_;
  Pose<frame::Sensor, frame::Vehicle> T_sensor_vehicle_;
  Pose<frame::CommonTarget, frame::Body> T_target_body_;
  double start_s_;
};

LighthouseScenario light_of(const ApproachScenario& scenario, const RawOutput& output) {
  const ApproachSource& source = scenario.sources[output.source];
  const double from_s = std::max(0.0, scenario.from_s), to_s = std::min(scenario.motion.duration_s, scenario.to_s);
  LighthouseScenario light;
  light.duration_s = to_s - from_s;
  light.target = host::read_target(output.target_file).target;
  light.errors = ErrorScenario::workshop();
  light.noise.narrow_sigma_arcsec = light.noise.sigma_arcsec;
  light.light.max_range_m = source.max_range_m;
  light.light.half_field_deg = source.half_field_deg;
  light.clock.start_ticks = std::llround((kRawStart_s + from_s) * TargetClock::kTicksPerTrueSecond);
  light.stations.resize(1);
  light.stations[0].calibration.reset();
  return light;
}

Target moved(Target target, const Pose<frame::Body, frame::Body>& T) {
  for (SensorPlacement& sensor : target) {
    sensor.position_m = T * sensor.position_m;
    sensor.normal = T.R * sensor.normal;
  }
  return target;
}

}  // namespace

void write_raw_lighthouse(const RawOutput& output) {
  const ApproachScenario& scenario = output.simulator.scenario();
  const double from_s = std::max(0.0, scenario.from_s);
  LighthouseScenario light = light_of(scenario, output);
  light.trajectory = std::make_shared<StationaryTrajectory>(std::vector<RoomFromBody>{RoomFromBody{}}, 1.0, 0.0);
  // Where the true sensors are depends on the seed alone.
  const Target built = LighthouseSimulator(light, output.seed).true_target();
  const Pose<frame::Body, frame::Body> T_feature_body = body_frame_of(light.target, built).inverse();
  light.trajectory = std::make_shared<SourceTrajectory>(
      output.simulator, output.source, from_s, Pose<frame::Feature, frame::Body>{T_feature_body.R, T_feature_body.t});
  write_recording(light, output.seed, output.folder);
  write_target(output.folder / "target_surveyed.csv", moved(built, T_feature_body));
}

}  // namespace pharos::sim
