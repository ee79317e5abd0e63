// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/raw/raw_source.hpp"

#include <cmath>

namespace pharos::sim {
namespace {

// Towards the sun in the vehicle's frame: behind the vehicle and aside, so that the ring's face is lit and the nozzle
// throws a shadow.
const Vector3 kToSun_vehicle = Vector3(0.35, -0.5, -0.8).normalized();

}  // namespace

host::TargetFromFeature docking_ring(const ApproachScenario& scenario) {
  for (const host::SourceKind kind : {host::SourceKind::kTof, host::SourceKind::kRing2}) {
    for (const ApproachSource& source : scenario.sources) {
      if (source.kind == kind) return source.T_target_feature;
    }
  }
  return usual_source(host::SourceKind::kTof).T_target_feature;
}

Pose<frame::Target, frame::Body> lighthouse_target(const ApproachScenario& scenario) {
  host::TargetFromFeature T_target_body;  // the target's own frame, unless a lighthouse says otherwise
  for (const ApproachSource& source : scenario.sources) {
    if (source.kind == host::SourceKind::kLighthouse) T_target_body = source.T_target_feature;
  }
  const Pose<frame::Feature, frame::Feature> T_ring_body = docking_ring(scenario).inverse() * T_target_body;
  return {T_ring_body.R, T_ring_body.t};
}

std::vector<RawFrame> raw_frames(const ApproachSimulator& simulator, std::size_t source,
                                 const host::TargetFromFeature& T_target_ring) {
  const auto T_sensor_vehicle = simulator.true_mounting().sources[source].vehicle_from_sensor().inverse();
  std::vector<RawFrame> frames;
  for (const ApproachSight& at : simulator.sights(source)) {
    if (at.sight != Sight::kSeen) continue;
    const auto T_vehicle_ring = simulator.truth().at(at.true_time_s) * T_target_ring;
    const auto T_sensor_ring = T_sensor_vehicle * T_vehicle_ring;
    RawFrame frame;
    frame.name = std::to_string(std::llround((kRawStart_s + at.time_s) * 1e9));
    frame.T_sensor_ring = {T_sensor_ring.R, T_sensor_ring.t};
    frame.to_sun_ring = T_vehicle_ring.R.transpose() * kToSun_vehicle;
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace pharos::sim
