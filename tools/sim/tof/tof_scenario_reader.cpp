// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "host/toml/strict_toml.hpp"
#include "tools/sim/tof/tof_scenario.hpp"

namespace pharos::sim {
namespace {

using host::kFraction;
using host::Range;
using host::TomlTable;

constexpr Range kLength_m{1e-4, 20.0};
constexpr Range kPlace_m{-20.0, 20.0};
constexpr Range kReflectance{0.0, 100.0};
constexpr Range kTurn_deg{-360.0, 360.0};
constexpr std::int64_t kMaxFrames = 1'000'000;

Lens read_lens(const TomlTable& table) {
  Lens lens = kPaperLens;
  lens.width_px = static_cast<int>(table.integer_or("width_px", lens.width_px, 32, 4096));
  lens.height_px = static_cast<int>(table.integer_or("height_px", lens.height_px, 32, 4096));
  lens.fx_px = table.number_or("fx_px", lens.fx_px, {10.0, 1e5});
  lens.fy_px = table.number_or("fy_px", lens.fy_px, {10.0, 1e5});
  lens.cx_px = table.number_or("cx_px", lens.cx_px, {-1e4, 1e4});
  lens.cy_px = table.number_or("cy_px", lens.cy_px, {-1e4, 1e4});
  lens.distortion = table.vector_or<5>("distortion", lens.distortion, {-10.0, 10.0});
  return lens;
}

DepthScale read_depth(const TomlTable& table) {
  DepthScale depth;
  depth.scale_m = table.number_or("depth_scale_m", depth.scale_m, {1e-6, 0.1});
  depth.origin_z_m = table.number_or("depth_origin_z_m", depth.origin_z_m, {-1.0, 1.0});
  return depth;
}

ImagingModel read_imaging(const TomlTable& table) {
  ImagingModel imaging;
  imaging.nominal_counts = table.number_or("nominal_counts", imaging.nominal_counts, {1.0, 1e6});
  imaging.blur_px = table.number_or("blur_px", imaging.blur_px, {0.0, 10.0});
  imaging.multipath = table.number_or("multipath", imaging.multipath, kFraction);
  return imaging;
}

SensorModel read_sensor(const TomlTable& table) {
  SensorModel sensor;
  sensor.sigma_nominal_m = table.number_or("sigma_nominal_m", sensor.sigma_nominal_m, {0.0, 1.0});
  sensor.correlation_px = table.number_or("correlation_px", sensor.correlation_px, {0.0, 20.0});
  sensor.common_sigma_m = table.number_or("common_sigma_m", sensor.common_sigma_m, {0.0, 1.0});
  sensor.electrons_per_count = table.number_or("electrons_per_count", sensor.electrons_per_count, {1e-3, 1e6});
  sensor.read_noise_counts = table.number_or("read_noise_counts", sensor.read_noise_counts, {0.0, 1e4});
  sensor.min_counts = table.number_or("least_counts", sensor.min_counts, {1.0, 65535.0});
  sensor.full_counts = table.number_or("full_counts", sensor.full_counts, {1.0, 65535.0});
  sensor.range_limit_m = table.number_or("range_limit_m", sensor.range_limit_m, {0.5, 1e6});
  return sensor;
}

std::optional<Ring> read_ring(const TomlTable& table, Ring ring) {
  if (!table.boolean_or("ring", true)) return std::nullopt;
  ring.inner_radius_m = 0.5 * table.number_or("ring_inner_diameter_m", 2.0 * ring.inner_radius_m, kLength_m);
  if (ring.inner_radius_m >= ring.outer_radius_m) {
    table.fail("ring_inner_diameter_m", "must be below ring_outer_diameter_m");
  }
  ring.albedo = table.number_or("ring_albedo", ring.albedo, kReflectance);
  return ring;
}

std::optional<Nozzle> read_nozzle(const TomlTable& table, Nozzle nozzle) {
  if (!table.boolean_or("nozzle", true)) return std::nullopt;
  nozzle.exit_radius_m = 0.5 * table.number_or("nozzle_exit_diameter_m", 2.0 * nozzle.exit_radius_m, kLength_m);
  nozzle.exit_z_m = table.number_or("nozzle_exit_z_m", nozzle.exit_z_m, kPlace_m);
  nozzle.throat_radius_m = 0.5 * table.number_or("nozzle_throat_diameter_m", 2.0 * nozzle.throat_radius_m, kLength_m);
  nozzle.throat_z_m = table.number_or("nozzle_throat_z_m", nozzle.throat_z_m, kPlace_m);
  nozzle.albedo = table.number_or("nozzle_albedo", nozzle.albedo, kReflectance);
  if (nozzle.throat_radius_m >= nozzle.exit_radius_m) {
    table.fail("nozzle_throat_diameter_m", "must be below nozzle_exit_diameter_m");
  }
  if (nozzle.throat_z_m >= nozzle.exit_z_m) table.fail("nozzle_throat_z_m", "must be below nozzle_exit_z_m");
  return nozzle;
}

Foil read_foil(const TomlTable& table) {
  Foil foil;
  foil.height_m = table.number_or("foil_height_m", foil.height_m, {0.0, 0.1});
  foil.albedo = table.number_or("foil_albedo", foil.albedo, kReflectance);
  foil.gloss = table.number_or("foil_gloss", foil.gloss, kReflectance);
  foil.glint = table.number_or("foil_glint", foil.glint, kReflectance);
  return foil;
}

std::vector<Connector> read_connectors(const TomlTable& root, const TomlTable& table, std::vector<Connector> usual) {
  const std::vector<TomlTable> given = root.tables("connector");
  const auto count = table.integer_or("connectors", static_cast<std::int64_t>(usual.size()), 0, 2);
  const Connector like = usual.front();
  usual.resize(static_cast<std::size_t>(count));
  if (given.empty()) return usual;
  if (table.has("connectors")) table.fail("connectors", "and [[connector]] exclude each other");
  std::vector<Connector> connectors;
  for (const TomlTable& one : given) {
    Connector connector = like;
    connector.distance_m = one.number_or("distance_m", connector.distance_m, kLength_m);
    connector.direction_deg = one.number_or("direction_deg", 0.0, kTurn_deg);
    connector.side_m = one.number_or("side_m", connector.side_m, kLength_m);
    connector.height_m = one.number_or("height_m", connector.height_m, kLength_m);
    connector.albedo = one.number_or("albedo", connector.albedo, kReflectance);
    connectors.push_back(connector);
  }
  return connectors;
}

std::vector<PaintedCircle> read_circles(const TomlTable& root) {
  std::vector<PaintedCircle> circles;
  for (const TomlTable& one : root.tables("painted_circle")) {
    PaintedCircle circle;
    circle.x_m = one.number("x_m", kPlace_m);
    circle.y_m = one.number("y_m", kPlace_m);
    circle.radius_m = one.number("radius_m", kLength_m);
    circle.line_m = one.number_or("line_m", circle.line_m, kLength_m);
    circle.albedo = one.number_or("albedo", circle.albedo, kReflectance);
    circles.push_back(circle);
  }
  return circles;
}

std::optional<Occluder> read_occluder(const TomlTable& root, bool& wanders) {
  if (!root.has("occluder")) return std::nullopt;
  const TomlTable table = root.table("occluder");
  Occluder occluder;
  occluder.fraction = table.number_or("share", occluder.fraction, {0.0, 0.9});
  occluder.width_m = table.number_or("width_m", occluder.width_m, kLength_m);
  occluder.nearness = table.number_or("nearness", occluder.nearness, {0.1, 0.99});
  occluder.albedo = table.number_or("albedo", occluder.albedo, kReflectance);
  wanders = table.boolean_or("wanders", false);
  if (wanders && table.has("direction_deg")) table.fail("direction_deg", "and wanders exclude each other");
  occluder.direction_deg = table.number_or("direction_deg", occluder.direction_deg, kTurn_deg);
  return occluder;
}

Satellite read_satellite(const TomlTable& root, bool& occluder_wanders) {
  const TomlTable table = root.table_or_empty("satellite");
  Satellite satellite = satellite_of_ring(table.number_or("ring_outer_diameter_m", 1.1, {0.05, 10.0}));
  satellite.body_x_m = table.number_or("body_x_m", satellite.body_x_m, kLength_m);
  satellite.body_y_m = table.number_or("body_y_m", satellite.body_y_m, kLength_m);
  satellite.body_depth_m = table.number_or("body_depth_m", satellite.body_depth_m, kLength_m);
  satellite.face_z_m = table.number_or("face_z_m", satellite.face_z_m, {-10.0, 0.0});
  satellite.ring = read_ring(table, *satellite.ring);
  satellite.nozzle = read_nozzle(table, *satellite.nozzle);
  satellite.connectors = read_connectors(root, table, satellite.connectors);
  satellite.foil = read_foil(table);
  satellite.circles = read_circles(root);
  satellite.occluder = read_occluder(root, occluder_wanders);
  if (satellite.occluder && !satellite.ring) root.fail("occluder", "hides part of a ring: satellite.ring is false");
  return satellite;
}

CameraFromTarget pose_of(const std::vector<double>& row) {
  return {attitude_of({row[3], row[4], row[5]}), {row[0], row[1], row[2]}};
}

void check_ahead(const TomlTable& table, const char* key, const CameraFromTarget& pose) {
  if (pose.t.z() < 0.1) table.fail(key, "the ring must stand at least 0.1 m ahead of the camera (third number)");
}

std::vector<CameraFromTarget> read_still(const TomlTable& table) {
  const auto frames = static_cast<std::size_t>(table.integer_or("frames_per_pose", 1, 1, kMaxFrames));
  std::vector<CameraFromTarget> poses;
  for (const std::vector<double>& row : table.rows("poses", 6, {-360.0, 360.0})) {
    check_ahead(table, "poses", pose_of(row));
    poses.insert(poses.end(), frames, pose_of(row));
  }
  if (poses.empty()) table.fail("poses", "give at least one row tx_m, ty_m, tz_m, alpha_deg, beta_deg, gamma_deg");
  return poses;
}

std::vector<CameraFromTarget> read_random(const TomlTable& table, const TofScenario& scenario, std::uint64_t seed) {
  RandomPoses limits;
  limits.count = static_cast<int>(table.integer("count", 1, kMaxFrames));
  limits.min_range_m = table.number_or("min_range_m", limits.min_range_m, {0.1, 100.0});
  limits.max_range_m = table.number_or("max_range_m", limits.max_range_m, {limits.min_range_m, 100.0});
  limits.max_tilt_deg = table.number_or("max_tilt_deg", limits.max_tilt_deg, {0.0, 89.0});
  limits.margin_px = table.number_or("margin_px", limits.margin_px, {-1e4, 1e4});
  return random_poses(limits, scenario.satellite, PixelRays(scenario.lens), RandomStream(seed, "tof poses"));
}

std::vector<CameraFromTarget> read_approach(const TomlTable& table, double frames_per_s) {
  const auto end = [&table](const char* key) {
    const auto row = table.vector<6>(key, {-360.0, 360.0});
    const CameraFromTarget pose = pose_of({row.begin(), row.end()});
    check_ahead(table, key, pose);
    return pose;
  };
  Approach approach{end("from"), end("to")};
  approach.duration_s = table.number("duration_s", {0.01, 1e5});
  approach.spin_deg_s = table.number_or("spin_deg_s", 0.0, {-720.0, 720.0});
  approach.nod_deg = table.number_or("nod_deg", 0.0, {-80.0, 80.0});
  approach.nod_period_s = table.number_or("nod_period_s", approach.nod_period_s, {0.01, 1e5});
  std::vector<CameraFromTarget> poses;
  const auto last = static_cast<int>(std::floor(approach.duration_s * frames_per_s));
  for (int frame = 0; frame <= last; ++frame) poses.push_back(approach.at(frame / frames_per_s));
  return poses;
}

std::vector<CameraFromTarget> read_poses(const TomlTable& table, const TofScenario& scenario, std::uint64_t seed) {
  const std::string kind = table.choice("kind", {"still", "random", "approach"});
  if (kind == "still") return read_still(table);
  if (kind == "random") return read_random(table, scenario, seed);
  return read_approach(table, scenario.frames_per_s);
}

}  // namespace

TofScenario read_tof_scenario(const std::filesystem::path& path, std::uint64_t seed) {
  const TomlTable root = TomlTable::parse_file(path);
  TofScenario scenario;
  scenario.frames_per_s = root.number_or("frames_per_s", scenario.frames_per_s, {0.01, 1000.0});
  scenario.write_abcy16 = root.boolean_or("write_abcy16", false);
  scenario.stale_half_every = static_cast<int>(root.integer_or("stale_half_every", 0, 0, kMaxFrames));
  const TomlTable camera = root.table_or_empty("camera");
  scenario.lens = read_lens(camera);
  scenario.depth = read_depth(camera);
  const TomlTable sensor = root.table_or_empty("sensor");
  scenario.imaging = read_imaging(sensor);
  scenario.sensor = read_sensor(sensor);
  scenario.satellite = read_satellite(root, scenario.occluder_wanders);
  scenario.poses = read_poses(root.table("trajectory"), scenario, seed);
  root.reject_unknown();
  return scenario;
}

}  // namespace pharos::sim
