// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "host/toml/strict_toml.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/pointing/pointing_scenario.hpp"
#include "tools/sim/pointing/pointing_views.hpp"
#include "tools/sim/pointing/sky_frames.hpp"

namespace pharos::sim {
namespace {

using host::kFraction;
using host::Range;
using host::TomlTable;

constexpr Range kLength_m{1e-3, 100.0};
constexpr Range kRange_m{5.0, 1e8};
constexpr Range kComponent{-1e3, 1e3};
constexpr std::int64_t kMaxImages = 100'000;

// Asks in degrees, gives rad.
double angle_or(const TomlTable& table, const char* key, double fallback_rad, Range range_deg) {
  return table.number_or(key, fallback_rad * kDegPerRad, range_deg) * kRadPerDeg;
}

Lens read_camera(const TomlTable& table) {
  const auto width_px = static_cast<std::int32_t>(table.integer_or("width_px", 1024, 64, 8192));
  const auto height_px = static_cast<std::int32_t>(table.integer_or("height_px", 1024, 64, 8192));
  return centred_lens(width_px, height_px, table.number_or("focal_px", kLineFocal_px, {100.0, 1e10}));
}

PointingSatellite read_satellite(const TomlTable& table) {
  PointingSatellite satellite;
  satellite.panels = static_cast<int>(table.integer_or("panels", satellite.panels, 1, 2));
  satellite.panel_length_m = table.number_or("panel_length_m", satellite.panel_length_m, kLength_m);
  satellite.panel_width_m = table.number_or("panel_width_m", satellite.panel_width_m, kLength_m);
  satellite.panel_thickness_m = table.number_or("panel_thickness_m", satellite.panel_thickness_m, {1e-4, 1.0});
  satellite.truss_m = table.number_or("truss_m", satellite.truss_m, kLength_m);
  const auto body =
      table.vector_or<3>("body_m", {satellite.body_m.x(), satellite.body_m.y(), satellite.body_m.z()}, kLength_m);
  satellite.body_m = {body[0], body[1], body[2]};
  return satellite;
}

PointingImaging read_imaging(const TomlTable& table) {
  PointingImaging imaging;
  imaging.seeing_px = table.number_or("seeing_px", imaging.seeing_px, {0.0, 20.0});
  imaging.tracking_px = table.number_or("tracking_px", imaging.tracking_px, {0.0, 1000.0});
  imaging.stars = static_cast<int>(table.integer_or("stars", imaging.stars, 0, 100'000));
  imaging.star_light = table.number_or("star_light", imaging.star_light, {0.0, 1e3});
  imaging.sky_light = table.number_or("sky_light", imaging.sky_light, kFraction);
  imaging.peak = table.number_or("peak", imaging.peak, {0.0, 100.0});
  imaging.antialias_threshold = table.number_or("antialias_threshold", imaging.antialias_threshold, kFraction);
  imaging.rays_per_side = static_cast<int>(table.integer_or("rays_per_side", imaging.rays_per_side, 1, 9));
  imaging.sensor.full_well_e = table.number_or("full_well_e", imaging.sensor.full_well_e, {1.0, 1e7});
  imaging.sensor.read_noise_e = table.number_or("read_noise_e", imaging.sensor.read_noise_e, {0.0, 1e5});
  imaging.sensor.bits = table.integer_or("bits", imaging.sensor.bits, 8, 16) == 8 ? 8 : 16;
  return imaging;
}

PointingStation read_station(const TomlTable& table) {
  PointingStation station;  // the paper's own by default
  station.latitude_rad = table.number_or("latitude_deg", 34.27, {-90.0, 90.0}) * kRadPerDeg;
  station.longitude_rad = table.number_or("longitude_deg", 108.95, {-180.0, 360.0}) * kRadPerDeg;
  station.height_m = table.number_or("height_m", 0.0, {-500.0, 9000.0});
  return station;
}

// Rows azimuth_deg, elevation_deg, range_m, pitch_deg, yaw_deg, roll_deg.
std::vector<PointingView> read_still(const TomlTable& table, RandomStream random) {
  std::vector<PointingView> views;
  for (const std::vector<double>& row : table.rows("attitudes", 6, {-1e8, 1e8})) {
    PointingView view;
    view.time_s = static_cast<double>(views.size());
    view.azimuth_rad = row[0] * kRadPerDeg;
    view.elevation_rad = row[1] * kRadPerDeg;
    view.range_m = row[2];
    if (row[2] < kRange_m.low) table.fail("attitudes", "the range (third number) must be 5 m or more");
    if (std::abs(row[1]) > 90.0) table.fail("attitudes", "the elevation (second number) must be within 90 deg");
    const Vector3 sight = station_from_camera(view.azimuth_rad, view.elevation_rad).col(2);
    const Vector3 axis = direction_of(row[3] * kRadPerDeg, row[4] * kRadPerDeg);
    if (axis.cross(sight).norm() < 1e-3) table.fail("attitudes", "the axis must not lie along the line of sight");
    view.R_station_body = station_from_body(axis, sight, row[5] * kRadPerDeg);
    view.to_sun_station = sun_for(view, random);
    views.push_back(view);
  }
  if (views.empty()) {
    table.fail("attitudes", "give at least one row azimuth_deg, elevation_deg, range_m, pitch_deg, yaw_deg, roll_deg");
  }
  return views;
}

RandomPointingViews read_random(const TomlTable& table) {
  RandomPointingViews limits;
  limits.count = static_cast<int>(table.integer_or("count", limits.count, 1, kMaxImages));
  limits.range_m = table.number_or("range_m", limits.range_m, kRange_m);
  limits.min_elevation_rad = angle_or(table, "least_elevation_deg", limits.min_elevation_rad, {0.0, 90.0});
  limits.max_elevation_rad = angle_or(table, "most_elevation_deg", limits.max_elevation_rad, {0.0, 90.0});
  limits.min_from_sight_rad = angle_or(table, "least_from_sight_deg", limits.min_from_sight_rad, {1.0, 89.0});
  limits.max_roll_rad = angle_or(table, "most_roll_deg", limits.max_roll_rad, {0.0, 89.0});
  return limits;
}

Vector3 read_direction(const TomlTable& table, const char* key, const Vector3& fallback) {
  const auto given = table.vector_or<3>(key, {fallback.x(), fallback.y(), fallback.z()}, kComponent);
  const Vector3 direction(given[0], given[1], given[2]);
  if (direction.norm() < 1e-6) table.fail(key, "must be a direction: three numbers that are not all 0");
  return direction.normalized();
}

PointingPass read_pass(const TomlTable& table) {
  PointingPass pass;
  pass.altitude_m = table.number_or("altitude_m", pass.altitude_m, {100e3, 60e6});
  pass.side_rad = angle_or(table, "side_deg", pass.side_rad, {-60.0, 60.0});
  pass.heading_rad = angle_or(table, "heading_deg", pass.heading_rad, {-360.0, 360.0});
  pass.images = static_cast<int>(table.integer_or("images", pass.images, 1, kMaxImages));
  pass.spacing_s = table.number_or("spacing_s", pass.spacing_s, {1e-3, 1e4});
  pass.start_s = table.number_or("start_s", pass.start_s, {0.0, 1e11});
  const std::string law = table.choice_or("law", "inertial", {"inertial", "nadir", "spin"});
  if (law == "nadir") pass.law = PointingPass::Law::kNadir;
  if (law == "spin") pass.law = PointingPass::Law::kSpin;
  pass.axis = read_direction(table, "axis", pass.axis);
  if (pass.law == PointingPass::Law::kSpin) {
    pass.spin = read_direction(table, "spin_axis", pass.spin);
    pass.spin_rate_rad_s = table.number("spin_rate_deg_s", {-180.0, 180.0}) * kRadPerDeg;
  }
  return pass;
}

}  // namespace

PointingScenario read_pointing_scenario(const std::filesystem::path& path, std::uint64_t seed) {
  const TomlTable root = TomlTable::parse_file(path);
  PointingScenario scenario;
  scenario.camera = read_camera(root.table_or_empty("camera"));
  scenario.satellite = read_satellite(root.table_or_empty("satellite"));
  scenario.imaging = read_imaging(root.table_or_empty("imaging"));
  scenario.station = read_station(root.table_or_empty("station"));
  const TomlTable trajectory = root.table("trajectory");
  scenario.write_range = trajectory.boolean_or("track_ranges", true);
  const std::string kind = trajectory.choice("kind", {"still", "random", "pass"});
  RandomStream random(seed, "line views");
  if (kind == "still") scenario.views = read_still(trajectory, random);
  if (kind == "random") scenario.views = random_views(read_random(trajectory), random);
  if (kind == "pass") {
    scenario.views = pass_views(read_pass(trajectory), scenario.station, random);
    for (const PointingView& view : scenario.views) {
      if (view.elevation_rad < 0.0)
        trajectory.fail("images", "the pass goes below the horizon; fewer images, or closer ones");
    }
  }
  root.reject_unknown();
  return scenario;
}

}  // namespace pharos::sim
