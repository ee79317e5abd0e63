// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/random_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pharos/base/units.hpp"
#include "tools/sim/tof/random_clutter.hpp"
#include "tools/sim/tof/scene.hpp"

namespace pharos::sim {
namespace {

// The nearest connector is nearer than the others by this: what is equal within it is ambiguous by right. Metres.
constexpr double kNearer_m = 0.02;
constexpr double kMinApart_m = 0.16;

double across_of(const Connector& box) { return box.across_m > 0.0 ? box.across_m : box.side_m; }

// A box on the face inside or outside of the ring, clear of nozzle, ring, rim and the other boxes. False where a few
// draws find no place.
bool place_box(const Satellite& satellite, double nearest_m, RandomStream& random, Connector& box) {
  const Ring& ring = *satellite.ring;
  const double reach = 0.5 * std::hypot(box.side_m, std::max(box.across_m, box.side_m)) + 0.02;
  for (int draw = 0; draw < 200; ++draw) {
    const double half_body = 0.5 * std::min(satellite.body_x_m, satellite.body_y_m);
    box.distance_m = random.uniform(nearest_m, 1.6 * ring.outer_radius_m);
    box.direction_deg = random.uniform(0.0, 360.0);
    const Vector2 place = place_of(box);
    const bool on_face = box.distance_m + reach < half_body;  // however all boxes are turned
    const bool off_ring = box.distance_m + reach < ring.inner_radius_m || box.distance_m - reach > ring.outer_radius_m;
    const bool off_nozzle = box.distance_m - reach > satellite.nozzle->exit_radius_m + 0.05;
    bool apart = true;
    for (const Connector& other : satellite.connectors) {
      apart = apart && (place - place_of(other)).norm() > kMinApart_m + 0.5 * std::max(box.side_m, other.side_m);
    }
    if (on_face && off_ring && off_nozzle && apart) return true;
  }
  return false;
}

Connector random_connector(RandomStream& random) {
  Connector box;
  box.side_m = random.uniform(0.065, 0.11);
  box.height_m = random.uniform(0.045, 0.08);
  box.albedo = random.uniform(0.15, 0.6);
  box.turn_deg = random.uniform(0.0, 90.0);
  return box;
}

// Turns all boxes so that the first one, the nearest, lies along X'.
void put_first_on_x(Satellite& satellite) {
  const double turn = satellite.connectors[0].direction_deg;
  for (Connector& box : satellite.connectors) box.direction_deg -= turn;
}

void add_boxes(RandomTofBody& body, RandomStream& random) {
  Satellite& satellite = body.scenario.satellite;
  satellite.connectors.clear();
  const Connector kind = random_connector(random);
  Connector nearest = kind;
  const double start = satellite.nozzle->exit_radius_m + 0.08;
  if (!place_box(satellite, start, random, nearest)) return;
  satellite.connectors.push_back(nearest);
  body.connectors = 1;
  if (random.uniform() < 0.75) {
    Connector second = kind;
    second.albedo = random.uniform(0.15, 0.6);
    if (place_box(satellite, nearest.distance_m + kNearer_m, random, second)) {
      satellite.connectors.push_back(second);
      body.connectors = 2;
    }
  }
  if (random.uniform() < 0.5) {  // a cover or rail, anywhere
    Connector cover = kind;
    cover.side_m = random.uniform(0.15, 0.3);
    cover.across_m = random.uniform(0.04, 0.07);
    if (place_box(satellite, start, random, cover)) satellite.connectors.push_back(cover);
  }
  put_first_on_x(satellite);
}

void draw_body(TofScenario& scenario, RandomStream& random) {
  const double diameter = random.uniform(0.6, 1.2);
  scenario.satellite = satellite_of_ring(diameter);
  Satellite& satellite = scenario.satellite;
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
}

void draw_camera(TofScenario& scenario, RandomStream& random) {
  if (random.uniform() < 0.5) scenario.lens.distortion = {};
  scenario.imaging.blur_px = random.uniform(0.3, 0.8);
  scenario.imaging.multipath = random.uniform(0.0, 0.2);
  scenario.sensor.noise_exponent = random.uniform(0.5, 1.0);
  if (random.uniform() < 0.5) scenario.sensor.max_spread_m = random.uniform(0.012, 0.03);
  if (random.uniform() < 0.3) scenario.sensor.stray_rate = random.uniform(0.0, 0.01);
}

// Bodies differ in their foil's height, colour and place; patterns are few.
const FoilTexture& foil_pattern(std::uint64_t seed) {
  constexpr std::uint64_t kPatterns = 16;
  static const std::vector<FoilTexture> kFoils = [] {
    std::vector<FoilTexture> foils;
    for (std::uint64_t k = 0; k < kPatterns; ++k) foils.emplace_back(1.0, RandomStream(k, "tof foil"));
    return foils;
  }();
  return kFoils[seed % kPatterns];
}

// Of the paper's lens, or of one without distortion.
std::shared_ptr<const PixelRays> rays_of(const Lens& lens) {
  static const auto kDistorted = std::make_shared<const PixelRays>(kPaperLens);
  static const auto kPlain = [] {
    Lens plain = kPaperLens;
    plain.distortion = {};
    return std::make_shared<const PixelRays>(plain);
  }();
  return has_distortion(lens) ? kDistorted : kPlain;
}

// How much of ring and connectors nothing hides, by rays to places on them.
void look(RandomTofBody& body) {
  const Satellite& satellite = body.scenario.satellite;
  const CameraFromTarget& pose = body.scenario.poses[0];
  const FoilTexture flat(foil_pattern(0), 0.0, 0.0, 0.0);
  const Scene scene(satellite, flat, pose);
  const auto meets = [&](const Vector3& place_T, int surface) {
    const Vector3 p = pose * place_T;
    return scene.trace(p.head<2>() / p.z()).surface == surface ? 1.0 : 0.0;
  };
  constexpr int kPlaces = 180, kAcross = 6;
  const double radius = 0.5 * (satellite.ring->outer_radius_m + satellite.ring->inner_radius_m);
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kPlaces;
    body.ring_seen +=
        meets({radius * std::cos(angle), radius * std::sin(angle), 0.0}, static_cast<int>(SurfaceKind::kRingFront)) /
        kPlaces;
  }
  body.connectors_seen = 1.0;
  body.connector_px = 1e9;
  for (int number = 0; number < body.connectors; ++number) {
    const Connector& box = satellite.connectors[static_cast<std::size_t>(number)];
    const Matrix3 turn =
        Eigen::AngleAxisd((box.direction_deg + box.turn_deg) * kRadPerDeg, Vector3::UnitZ()).toRotationMatrix();
    const Vector2 middle = place_of(box);
    const auto on_top = [&](double along, double across) {
      return Vector3(Vector3(middle.x(), middle.y(), satellite.face_z_m + box.height_m) +
                     turn * Vector3(along * box.side_m, across * across_of(box), 0.0));
    };
    double seen = 0.0;
    for (int i = 0; i < kAcross * kAcross; ++i) {
      const double along = (i % kAcross + 0.5) / kAcross - 0.5, across = (i / kAcross + 0.5) / kAcross - 0.5;
      seen +=
          meets(on_top(along, across), Scene::top_of_connector(static_cast<std::size_t>(number))) / (kAcross * kAcross);
    }
    body.connectors_seen = std::min(body.connectors_seen, seen);
    const auto pixel = [&](double along, double across) { return body.rays->project(pose * on_top(along, across)); };
    body.connector_px = std::min(
        {body.connector_px, (pixel(0.5, 0.0) - pixel(-0.5, 0.0)).norm(), (pixel(0.0, 0.5) - pixel(0.0, -0.5)).norm()});
  }
}

}  // namespace

RandomTofBody random_tof_body(std::uint64_t seed) {
  RandomStream random(seed, "tof body");
  RandomTofBody body;
  TofScenario& scenario = body.scenario;
  while (body.connectors == 0) {
    draw_body(scenario, random);
    add_boxes(body, random);
  }
  Satellite& satellite = scenario.satellite;
  if (random.uniform() < 0.3) {
    satellite.occluder = Occluder{};
    satellite.occluder->fraction = random.uniform(0.1, 0.33);
    satellite.occluder->direction_deg = random.uniform(0.0, 360.0);
  }
  draw_camera(scenario, random);
  add_clutter(body, RandomStream(seed, "tof clutter"));
  RandomPoses limits;
  limits.min_range_m = 2.0 * std::max(1.0, 2.0 * satellite.ring->outer_radius_m);
  limits.max_range_m = 6.0;
  body.rays = rays_of(scenario.lens);
  scenario.poses = random_poses(limits, satellite, *body.rays, RandomStream(seed, "tof pose"));
  body.range_m = scenario.poses[0].t.norm();
  look(body);
  return body;
}

TofSimulator simulator_of(const RandomTofBody& body, std::uint64_t seed) {
  RandomStream random(seed, "tof foil");
  const double x_m = random.uniform(0.0, FoilTexture::kSide_m), y_m = random.uniform(0.0, FoilTexture::kSide_m);
  const FoilTexture foil(foil_pattern(seed), body.scenario.satellite.foil.height_m, x_m, y_m);
  return {body.scenario, seed, body.rays, foil};
}

}  // namespace pharos::sim
