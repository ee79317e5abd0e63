// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/tof_kind.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/cameras/tof_target.hpp"
#include "host/support/flag_text.hpp"
#include "pharos/base/units.hpp"
#include "pharos/tof/tof_pose.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"
#include "tools/sim/tof/random_body.hpp"
#include "tools/sim/tof/random_clutter.hpp"
#include "tools/sim/tof/tof_writer.hpp"

namespace pharos::tools {
namespace {

constexpr double kTolerance_deg = 1.0;
constexpr double kTolerance_mm = 10.0;
// The rule of availability.
constexpr double kMinSeen = 0.97;
constexpr double kMinConnector_px = 8.0;
constexpr double kMaxRange_m = 5.0;
// What a description states is off by this (1 sigma), metres.
constexpr double kDescribedSigma_m = 0.001;

// Of every other body the estimator is given a description; of the others how many connectors there are.
bool is_described(std::uint64_t seed) { return seed % 2 == 0; }

bool is_answerable(const sim::RandomTofBody& body, bool described) {
  if (!described && (body.has_twin || body.has_look_alike)) return false;
  return body.ring_seen > kMinSeen && body.connectors_seen > kMinSeen && body.connector_px > kMinConnector_px &&
         body.range_m < kMaxRange_m;
}

host::StatedLength stated(double value_m, sim::RandomStream& random) {
  return {value_m + kDescribedSigma_m * random.normal(), kDescribedSigma_m};
}

tof::TofSettings settings_of(const sim::RandomTofBody& body, std::uint64_t seed) {
  tof::TofSettings settings;
  settings.connector.expected = body.connectors;
  if (!is_described(seed)) return settings;
  sim::RandomStream random(seed, "tof description");
  const sim::Satellite& satellite = body.scenario.satellite;
  host::DockingTarget target;
  target.outer_radius = stated(satellite.ring->outer_radius_m, random);
  target.inner_radius = stated(satellite.ring->inner_radius_m, random);
  for (std::size_t k = 0; k < static_cast<std::size_t>(body.connectors); ++k) {
    const sim::Connector& box = satellite.connectors[k];
    const Vector2 place = sim::place_of(box);
    target.connectors.push_back({stated(place.x(), random),
                                 stated(place.y(), random),
                                 stated(satellite.face_z_m + box.height_m, random),
                                 {box.side_m, box.side_m}});
  }
  host::apply_target(target, "description", settings);
  return settings;
}

IntegrityTrial trial_of(std::uint64_t seed) {
  const sim::RandomTofBody body = sim::random_tof_body(seed);
  IntegrityTrial trial;
  const sim::CameraFromTarget& truth = body.scenario.poses[0];
  trial.answerable = is_answerable(body, is_described(seed));
  sim::TofSimulator simulator = sim::simulator_of(body, seed);
  const sim::TofPixels pixels = simulator.pixels(0);
  // One for each thread: it keeps the rays of the last lens. Frames of other bodies are never the last one's.
  thread_local const auto workspace = std::make_unique<tof::TofWorkspace>();
  const auto pose = tof::measure_tof_pose(frame_of(pixels), depth_camera_of(simulator.scenario()),
                                          settings_of(body, seed), *workspace);
  if (!pose) {
    trial.status = std::string("refused_") + tof::name_of(pose.error());
    return trial;
  }
  const Vector6 error = pose_difference(truth, pose->target.pose);
  const Matrix6& covariance = pose->target.covariance;
  trial.status = pose->ambiguous()  ? "ambiguous"
                 : pose->has_turn() ? "ok"
                                    : "refused_" + host::joined_flags(pose->flags, tof::kTofFlagWords);
  if (!trial.ok()) return trial;
  trial.deviations.push_back({"attitude, deg", error.head<3>().norm() * kDegPerRad,
                              std::sqrt(covariance.topLeftCorner<3, 3>().trace()) * kDegPerRad, kTolerance_deg});
  trial.deviations.push_back({"position, mm", error.tail<3>().norm() * kMmPerM,
                              std::sqrt(covariance.bottomRightCorner<3, 3>().trace()) * kMmPerM, kTolerance_mm});
  return trial;
}

}  // namespace

IntegrityKind tof_kind() {
  return {
      "tof",
      "ring and connectors are seen whole, every connector's sides longer than 8 px, nearer than 5 m, and the target "
      "is described (every other seed), or there is no second docking ring, square cover, thruster or small ring",
      trial_of, [](std::uint64_t seed, const std::filesystem::path& folder, double) {
        sim::TofSimulator simulator = sim::simulator_of(sim::random_tof_body(seed), seed);
        sim::write_tof_frames(simulator, folder, [] {});
      }};
}

}  // namespace pharos::tools
