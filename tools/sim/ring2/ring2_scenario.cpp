// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/ring2/ring2_scenario.hpp"

#include <cmath>

#include "host/toml/strict_toml.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {
namespace {

using host::Range;
using host::TomlTable;

constexpr Range kLength_m{1e-3, 20.0};
constexpr Range kPlace_m{-100.0, 100.0};
constexpr Range kTilt_deg{-80.0, 80.0};
constexpr std::int64_t kMaxPoses = 100'000;

StereoRig read_rig(const TomlTable& table) {
  const double baseline_m = table.number_or("baseline_m", 1.8, {0.01, 100.0});
  const double toe_in_deg = table.number_or("toe_in_deg", 20.0, {-60.0, 60.0});
  const double focal_px = table.number_or("focal_px", 1000.0, {10.0, 1e5});
  const auto width = static_cast<std::int32_t>(table.integer_or("width_px", 1280, 32, 8192));
  const auto height = static_cast<std::int32_t>(table.integer_or("height_px", 1024, 32, 8192));
  StereoRig rig = symmetric_rig(baseline_m, toe_in_deg * kRadPerDeg, focal_px, width, height);
  for (StereoCamera& camera : rig) {
    camera.distortion = table.vector_or<5>("distortion", camera.distortion, {-10.0, 10.0});
  }
  return rig;
}

RingAndNozzle read_target(const TomlTable& table) {
  RingAndNozzle target;
  target.ring_radius_m = 0.5 * table.number_or("ring_diameter_m", 2.0 * target.ring_radius_m, kLength_m);
  target.nozzle_radius_m = 0.5 * table.number_or("nozzle_diameter_m", 2.0 * target.nozzle_radius_m, kLength_m);
  target.distance_m = table.number_or("distance_m", target.distance_m, {0.01, 20.0});
  if (target.nozzle_radius_m >= target.ring_radius_m) table.fail("nozzle_diameter_m", "must be below ring_diameter_m");
  return target;
}

std::vector<Ring2Pose> read_poses(const TomlTable& root, std::uint64_t seed) {
  std::vector<Ring2Pose> poses;
  for (const std::vector<double>& row : root.rows("poses", 5, kPlace_m)) {
    poses.push_back({{row[0], row[1], row[2]}, row[3], row[4]});
    if (row[2] <= 0.0) root.fail("poses", "z_m must be ahead of the rig: above 0");
    if (std::abs(row[3]) > kTilt_deg.high || std::abs(row[4]) > kTilt_deg.high) {
      root.fail("poses", "theta_deg and gamma_deg must be within 80 deg: beyond, the ring's back is seen");
    }
  }
  const TomlTable random = root.table_or_empty("random");
  const auto count = random.integer_or("count", 0, 0, kMaxPoses);
  const double angle_deg = random.number_or("max_angle_deg", 25.0, {0.0, 80.0});
  const double near_m = random.number_or("min_range_m", 2.6, {0.1, 100.0});
  const double far_m = random.number_or("max_range_m", 3.4, {0.1, 100.0});
  const double aside_m = random.number_or("max_aside_m", 0.1, {0.0, 100.0});
  if (far_m < near_m) random.fail("max_range_m", "must not be below min_range_m");
  for (std::int64_t k = 0; k < count; ++k) {
    RandomStream stream(seed, "pose " + std::to_string(k));
    Ring2Pose pose;
    pose.theta_deg = stream.uniform(-angle_deg, angle_deg);
    pose.gamma_deg = stream.uniform(-angle_deg, angle_deg);
    pose.ring_centre_m.z() = stream.uniform(near_m, far_m);
    pose.ring_centre_m.x() = stream.uniform(-aside_m, aside_m);
    pose.ring_centre_m.y() = stream.uniform(-aside_m, aside_m);
    poses.push_back(pose);
  }
  return poses;
}

Ring2Scenario read(const TomlTable& root, std::uint64_t seed) {
  Ring2Scenario scenario;
  scenario.rig = read_rig(root.table_or_empty("rig"));
  scenario.target = read_target(root.table_or_empty("target"));
  scenario.poses = read_poses(root, seed);
  scenario.render = root.boolean_or("render", scenario.render);
  scenario.edge_sigma_px = root.number_or("edge_sigma_px", 0.0, {0.0, 10.0});
  const TomlTable light = root.table_or_empty("light");
  const auto sun = light.vector_or<3>("sun_direction", {0.35, -0.5, -0.8}, {-1.0, 1.0});
  scenario.sun_direction = Vector3(sun[0], sun[1], sun[2]);
  if (!(scenario.sun_direction.norm() > 0.1)) light.fail("sun_direction", "must be a direction, not 0");
  scenario.sun_direction.normalize();
  scenario.fill_light = light.number_or("fill", scenario.fill_light, {0.0, 1.0});
  scenario.blur_px = root.number_or("blur_px", scenario.blur_px, {0.0, 10.0});
  scenario.bits = root.choice_or("bits", "8", {"8", "16"}) == "8" ? 8 : 16;
  root.reject_unknown();
  if (scenario.poses.empty())
    root.fail("poses", "is missing: give rows x_m, y_m, z_m, theta_deg, gamma_deg or [random] count");
  if (scenario.render && has_distortion(scenario.rig[0])) {
    root.fail("render", "images are rendered without lens distortion; set render = false for ellipses with it");
  }
  return scenario;
}

}  // namespace

RingAndNozzle Ring2Scenario::target_at(std::size_t pair) const {
  RingAndNozzle placed = target;
  placed.ring_centre_m = poses[pair].ring_centre_m;
  placed.normal = facing_normal(poses[pair].theta_deg * kRadPerDeg, poses[pair].gamma_deg * kRadPerDeg);
  return placed;
}

Ring2Scenario read_ring2_scenario(const std::string& path, std::uint64_t seed) {
  return read(TomlTable::parse_file(path), seed);
}

Ring2Scenario parse_ring2_scenario(const std::string& text, const std::string& name, std::uint64_t seed) {
  return read(TomlTable::parse_text(text, name), seed);
}

}  // namespace pharos::sim
