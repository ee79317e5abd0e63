// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/integrity/tof_kind.hpp"

#include <cmath>
#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/tof/tof_pose.hpp"
#include "tools/evaluation/reproduce/tof/depth_camera_of.hpp"
#include "tools/sim/tof/tof_simulator.hpp"
#include "tools/sim/tof/tof_writer.hpp"

namespace pharos::tools {
namespace {

constexpr double kTolerance_deg = 1.0;
constexpr double kTolerance_mm = 10.0;
// The nearest connector is nearer than the others by this, m; connectors equal within it are rightly ambiguous.
constexpr double kNearer_m = 0.02;
constexpr double kMinApart_m = 0.16;

struct Body {
  sim::TofScenario scenario;
  int connectors = 2;  // given to the estimator
};

// Place of a box' centre in T.
Vector2 place_of(const sim::Connector& box) {
  const double angle = box.direction_deg * kRadPerDeg;
  return box.distance_m * Vector2(std::cos(angle), std::sin(angle));
}

// A box on the face inside or outside of the ring, clear of nozzle, ring, rim and the other boxes. False where a few
// draws find no place.
bool place_box(const sim::Satellite& satellite, double nearest_m, sim::RandomStream& random, sim::Connector& box) {
  const sim::Ring& ring = *satellite.ring;
  const double reach = 0.5 * std::hypot(box.side_m, std::max(box.across_m, box.side_m)) + 0.02;
  for (int draw = 0; draw < 200; ++draw) {
    const double half_body = 0.5 * std::min(satellite.body_x_m, satellite.body_y_m);
    box.distance_m = random.uniform(nearest_m, 1.6 * ring.outer_radius_m);
    box.direction_deg = random.uniform(0.0, 360.0);
    const Vector2 place = place_of(box);
    const bool on_face = place.cwiseAbs().maxCoeff() + reach < half_body;
    const bool off_ring = box.distance_m + reach < ring.inner_radius_m || box.distance_m - reach > ring.outer_radius_m;
    const bool off_nozzle = box.distance_m - reach > satellite.nozzle->exit_radius_m + 0.05;
    bool apart = true;
    for (const sim::Connector& other : satellite.connectors) {
      apart = apart && (place - place_of(other)).norm() > kMinApart_m + 0.5 * std::max(box.side_m, other.side_m);
    }
    if (on_face && off_ring && off_nozzle && apart) return true;
  }
  return false;
}

sim::Connector random_connector(sim::RandomStream& random) {
  sim::Connector box;
  box.side_m = random.uniform(0.065, 0.11);
  box.height_m = random.uniform(0.045, 0.08);
  box.albedo = random.uniform(0.15, 0.6);
  box.turn_deg = random.uniform(0.0, 90.0);
  return box;
}

// Turns all boxes so that the first one, the nearest, lies along X'.
void put_first_on_x(sim::Satellite& satellite) {
  const double turn = satellite.connectors[0].direction_deg;
  for (sim::Connector& box : satellite.connectors) box.direction_deg -= turn;
}

void add_boxes(Body& body, sim::RandomStream& random) {
  sim::Satellite& satellite = body.scenario.satellite;
  satellite.connectors.clear();
  const sim::Connector kind = random_connector(random);
  sim::Connector nearest = kind;
  const double start = satellite.nozzle->exit_radius_m + 0.08;
  if (!place_box(satellite, start, random, nearest)) return;
  satellite.connectors.push_back(nearest);
  body.connectors = 1;
  if (random.uniform() < 0.75) {
    sim::Connector second = kind;
    second.albedo = random.uniform(0.15, 0.6);
    if (place_box(satellite, nearest.distance_m + kNearer_m, random, second)) {
      satellite.connectors.push_back(second);
      body.connectors = 2;
    }
  }
  if (random.uniform() < 0.5) {  // a cover or rail, anywhere
    sim::Connector cover = kind;
    cover.side_m = random.uniform(0.15, 0.3);
    cover.across_m = random.uniform(0.04, 0.07);
    if (place_box(satellite, start, random, cover)) satellite.connectors.push_back(cover);
  }
  put_first_on_x(satellite);
}

// A body, its foil and ring, the camera and one pose.
Body body_of(std::uint64_t seed) {
  sim::RandomStream random(seed, "tof body");
  Body body;
  sim::TofScenario& scenario = body.scenario;
  const double diameter = random.uniform(0.6, 1.2);
  scenario.satellite = sim::satellite_of_ring(diameter);
  sim::Satellite& satellite = scenario.satellite;
  satellite.body_x_m = satellite.body_y_m = std::max(1.05, random.uniform(1.1, 1.8) * diameter);
  satellite.ring->inner_radius_m = satellite.ring->outer_radius_m - random.uniform(0.028, 0.06);
  satellite.ring->albedo = random.uniform(0.35, 0.6);
  satellite.face_z_m = -random.uniform(0.05, 0.1);
  satellite.nozzle->exit_radius_m = random.uniform(0.1, 0.17) * diameter;
  satellite.nozzle->throat_radius_m = 0.4 * satellite.nozzle->exit_radius_m;
  satellite.nozzle->exit_z_m = random.uniform(-0.02, 0.08) * diameter;
  satellite.foil.height_m = random.uniform(0.0, 0.005);
  satellite.foil.albedo = random.uniform(0.1, 0.4);
  satellite.foil.gloss = random.uniform(0.0, 0.3);
  satellite.foil.glint = random.uniform(0.0, 3.0);
  add_boxes(body, random);
  if (random.uniform() < 0.3) {
    satellite.occluder = sim::Occluder{};
    satellite.occluder->fraction = random.uniform(0.1, 0.33);
    satellite.occluder->direction_deg = random.uniform(0.0, 360.0);
  }
  if (random.uniform() < 0.5) scenario.lens.distortion = {};
  scenario.imaging.blur_px = random.uniform(0.3, 0.8);
  scenario.imaging.multipath = random.uniform(0.0, 0.2);
  scenario.sensor.noise_exponent = random.uniform(0.5, 1.0);
  if (random.uniform() < 0.5) scenario.sensor.max_spread_m = random.uniform(0.012, 0.03);
  if (random.uniform() < 0.3) scenario.sensor.stray_rate = random.uniform(0.0, 0.01);
  sim::RandomPoses limits;
  limits.min_range_m = 2.0 * std::max(1.0, diameter);
  limits.max_range_m = 6.0;
  scenario.poses =
      sim::random_poses(limits, satellite, sim::PixelRays(scenario.lens), sim::RandomStream(seed, "tof pose"));
  return body;
}

IntegrityTrial trial_of(std::uint64_t seed) {
  const Body body = body_of(seed);
  IntegrityTrial trial;
  const sim::Satellite& satellite = body.scenario.satellite;
  const sim::CameraFromTarget& truth = body.scenario.poses[0];
  trial.answerable = !satellite.connectors.empty() && !satellite.occluder && truth.t.norm() < 5.0;
  sim::TofSimulator simulator(body.scenario, seed);
  const sim::TofPixels pixels = simulator.pixels(0);
  const auto workspace = std::make_unique<tof::TofWorkspace>();
  tof::TofSettings settings;
  settings.connector.expected = body.connectors;
  const auto pose =
      tof::measure_tof_pose(frame_of(pixels), depth_camera_of(simulator.scenario()), settings, *workspace);
  if (!pose) {
    trial.status = std::string("refused_") + tof::name_of(pose.error());
    return trial;
  }
  const Vector6 error = pose_difference(truth, pose->target.pose);
  const Matrix6& covariance = pose->target.covariance;
  trial.status = pose->ambiguous() ? "ambiguous" : pose->has_turn() ? "ok" : "refused_turn";
  if (!trial.ok()) return trial;
  trial.deviations.push_back({"attitude, deg", error.head<3>().norm() * kDegPerRad,
                              std::sqrt(covariance.topLeftCorner<3, 3>().trace()) * kDegPerRad, kTolerance_deg});
  trial.deviations.push_back({"position, mm", error.tail<3>().norm() * kMmPerM,
                              std::sqrt(covariance.bottomRightCorner<3, 3>().trace()) * kMmPerM, kTolerance_mm});
  return trial;
}

}  // namespace

IntegrityKind tof_kind() {
  return {"tof", "six degrees of freedom; a connector on the face, nothing before it, nearer than 5 m", trial_of,
          [](std::uint64_t seed, const std::filesystem::path& folder) {
            sim::TofSimulator simulator(body_of(seed).scenario, seed);
            sim::write_tof_frames(simulator, folder, [] {});
          }};
}

}  // namespace pharos::tools
