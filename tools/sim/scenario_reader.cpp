// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "host/table/target_file.hpp"
#include "host/toml/strict_toml.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/scenario.hpp"

namespace pharos::sim {
namespace {

namespace fs = std::filesystem;
using host::kFraction;
using host::kNotNegative;
using host::Range;
using host::TomlTable;

constexpr Range kSeconds{0.0, 1e6};
constexpr Range kPerSecond{0.0, 1e4};
constexpr Range kMetres{-1e3, 1e3};

Vector3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

fs::path beside(const TomlTable& table, const std::string& name) {
  const fs::path path(name);
  return path.is_absolute() ? path : fs::path(table.file()).parent_path() / path;
}

Matrix3 read_attitude(const TomlTable& table, const char* key, const std::array<double, 4>& fallback) {
  const std::array<double, 4> q = table.vector_or<4>(key, fallback, {-1.01, 1.01});
  const Eigen::Vector4d xyzw(q[1], q[2], q[3], q[0]);
  if (std::abs(xyzw.norm() - 1.0) > 0.01) table.fail(key, "must be a unit quaternion w, x, y, z");
  return Quaternion(xyzw).normalized().toRotationMatrix();
}

SheetErrors read_rotor(const TomlTable& table) {
  SheetErrors errors;
  errors.phase_rad = table.number_or("phase_rad", 0.0, {-0.5, 0.5});
  errors.tilt_rad = table.number_or("tilt_rad", 0.0, {-0.1, 0.1});
  errors.curve_rad = table.number_or("curve_rad", 0.0, {-0.1, 0.1});
  errors.gibbous_phase_rad = table.number_or("gibbous_phase_rad", 0.0, {-7.0, 7.0});
  errors.gibbous_magnitude_rad = table.number_or("gibbous_magnitude_rad", 0.0, {-0.1, 0.1});
  return errors;
}

std::uint32_t read_id(const TomlTable& table, std::size_t number) {
  const std::string text = table.text_or("id", number == 0 ? "BEC08E38" : "C33B4DE1");
  const bool hex = text.size() == 8 && std::all_of(text.begin(), text.end(), [](char c) {
                     return std::isxdigit(static_cast<unsigned char>(c)) != 0;
                   });
  if (!hex) table.fail("id", "must be eight hexadecimal digits");
  return static_cast<std::uint32_t>(std::strtoul(text.c_str(), nullptr, 16));
}

StationScenario read_station(const TomlTable& table, std::size_t number, std::size_t count) {
  StationScenario station;
  station.id = read_id(table, number);
  const std::string mode = table.choice_or("mode", count == 1 ? "A" : number == 0 ? "B" : "C", {"A", "B", "C"});
  station.mode = mode == "A" ? StationMode::kA : mode == "B" ? StationMode::kB : StationMode::kC;
  station.pose.R = read_attitude(table, "orientation_wxyz", {1.0, 0.0, 0.0, 0.0});
  station.pose.t = to_vector(table.vector_or<3>("position_m", {0.0, 0.0, 0.0}, kMetres));
  const std::string calibration = table.choice_or("calibration", "typical", {"ideal", "typical", "given"});
  if (calibration == "typical") station.calibration.reset();
  if (calibration == "given") {
    station.calibration = {read_rotor(table.table("rotor_x")), read_rotor(table.table("rotor_y"))};
  }
  return station;
}

std::vector<StationScenario> read_stations(const TomlTable& root) {
  const std::vector<TomlTable> tables = root.tables("station");
  if (tables.size() > 2) root.fail("station", "one or two stations, not " + std::to_string(tables.size()));
  if (tables.empty()) return {read_station(root.table_or_empty("station"), 0, 1)};
  std::vector<StationScenario> stations;
  stations.reserve(tables.size());
  for (const TomlTable& table : tables) stations.push_back(read_station(table, stations.size(), tables.size()));
  if (stations.size() == 2) {
    if (stations[0].mode != StationMode::kB) tables[0].fail("mode", "the first of two stations must be in mode B");
    if (stations[1].mode == StationMode::kB) tables[1].fail("mode", "the second station must be in mode A or C");
    if (stations[0].id == stations[1].id) tables[1].fail("id", "must differ from the first station's");
  }
  return stations;
}

// Stations of Lighthouse 2.0: known by their channels.
std::vector<StationScenario> read_lh2_stations(const TomlTable& root) {
  std::vector<StationScenario> stations;
  for (const TomlTable& table : root.tables("station")) {
    StationScenario station;
    station.id = read_id(table, stations.size());
    station.channel = static_cast<int>(table.integer("channel", 0, 15));
    station.pose.R = read_attitude(table, "orientation_wxyz", {1.0, 0.0, 0.0, 0.0});
    station.pose.t = to_vector(table.vector_or<3>("position_m", {0.0, 0.0, 0.0}, kMetres));
    if (table.choice_or("calibration", "typical", {"ideal", "typical"}) == "typical") station.calibration.reset();
    for (const StationScenario& other : stations) {
      if (other.channel == station.channel) table.fail("channel", "another station has it");
      if (other.id == station.id) table.fail("id", "must differ from the other stations'");
    }
    stations.push_back(station);
  }
  if (stations.empty()) root.fail("station", "generation 2 needs at least one [[station]] with its channel");
  return stations;
}

// Faults that Lighthouse 2.0 cannot have: it has no flashes, and no pulses to come late or twice.
void refuse_faults_of_pulses(const TomlTable& root) {
  const TomlTable table = root.table_or_empty("faults");
  for (const char* key : {"missed_flash_rate", "missed_flash_pulse_rate", "stretched_flash_rate", "merged_flash_rate",
                          "stale_pulses", "reorder_rate", "doubled_rate", "endless_per_s", "restart"}) {
    if (table.has(key)) table.fail(key, "is a fault of generation 1; leave it out");
  }
}

ClockScenario read_clock(const TomlTable& table) {
  ClockScenario clock;
  clock.start_ticks = table.integer_or("start_ticks", clock.start_ticks, 0, std::int64_t{1} << 50);
  clock.offset_ppm = table.number_or("offset_ppm", clock.offset_ppm, {-1000.0, 1000.0});
  clock.drift_ppm_per_s = table.number_or("drift_ppm_per_s", clock.drift_ppm_per_s, {-1.0, 1.0});
  clock.wrap32 = table.boolean_or("wrap32", clock.wrap32);
  return clock;
}

RotorScenario read_rotors(const TomlTable& table) {
  RotorScenario rotor;
  rotor.rate_hz = table.number_or("rate_hz", rotor.rate_hz, {50.0, 70.0});
  rotor.offset_ppm = table.number_or("offset_ppm", rotor.offset_ppm, {-1000.0, 1000.0});
  rotor.wander_ticks = table.number_or("wander_ticks", rotor.wander_ticks, {0.0, 2000.0});
  rotor.turn_jitter_ticks = table.number_or("turn_jitter_ticks", rotor.turn_jitter_ticks, {0.0, 200.0});
  rotor.second_delay_ticks = table.number_or("second_delay_ticks", rotor.second_delay_ticks, {10'000.0, 40'000.0});
  rotor.second_wander_ticks = table.number_or("second_wander_ticks", rotor.second_wander_ticks, {0.0, 1000.0});
  return rotor;
}

NoiseScenario read_noise(const TomlTable& table) {
  NoiseScenario noise;
  noise.sigma_arcsec = table.number_or("sigma_arcsec", noise.sigma_arcsec, {0.0, 1000.0});
  noise.rho = table.number_or("rho", noise.rho, kFraction);
  noise.flash_fraction = table.number_or("flash_share", noise.flash_fraction, kFraction);
  noise.narrow_sigma_arcsec = table.number_or("narrow_sigma_arcsec", noise.narrow_sigma_arcsec, {0.0, 1000.0});
  noise.flash_rise_ticks = table.number_or("flash_rise_ticks", noise.flash_rise_ticks, {0.0, 100.0});
  noise.bit_jitter_ns = table.number_or("bit_jitter_ns", noise.bit_jitter_ns, {0.0, 100.0});
  noise.width_ticks = table.number_or("width_ticks", noise.width_ticks, {0.0, 100.0});
  return noise;
}

LightScenario read_light(const TomlTable& table) {
  LightScenario light;
  light.max_incidence_deg = table.number_or("max_incidence_deg", light.max_incidence_deg, {1.0, 90.0});
  light.max_range_m = table.number_or("max_range_m", light.max_range_m, {0.1, 100.0});
  light.half_field_deg = table.number_or("half_field_deg", light.half_field_deg, {1.0, 80.0});
  light.lateness_low = table.number_or("lateness_low", light.lateness_low, kFraction);
  light.lateness_high = table.number_or("lateness_high", light.lateness_high, kFraction);
  if (light.lateness_high < light.lateness_low) table.fail("lateness_high", "must not be below lateness_low");
  return light;
}

ErrorScenario read_errors(const TomlTable& root) {
  if (root.has("errors") && root.choice("errors", {"none", "workshop"}) == "workshop") return ErrorScenario::workshop();
  return {};
}

int read_station_number(const TomlTable& table, std::size_t stations) {
  return static_cast<int>(table.integer_or("station", 0, 0, static_cast<std::int64_t>(stations) - 1));
}

ReflectionScenario read_reflection(const TomlTable& table, const LighthouseScenario& scenario) {
  ReflectionScenario reflection;
  reflection.station = read_station_number(table, scenario.stations.size());
  const bool second = scenario.generation == 2;  // its planes are a and b
  const std::string rotor =
      second ? table.choice_or("rotor", "a", {"a", "b"}) : table.choice_or("rotor", "x", {"x", "y"});
  reflection.rotor = rotor == "x" || rotor == "a" ? Rotor::kX : Rotor::kY;
  for (const std::int64_t sensor : table.integers("sensors", 0, 31)) {
    if (find_sensor(scenario.target, static_cast<std::uint8_t>(sensor)) == nullptr) {
      table.fail("sensors", "the target has no sensor " + std::to_string(sensor));
    }
    reflection.sensors.push_back(static_cast<int>(sensor));
  }
  if (reflection.sensors.empty()) table.fail("sensors", "must name at least one sensor");
  reflection.from_s = table.number_or("from_s", reflection.from_s, kSeconds);
  reflection.to_s = table.number_or("to_s", reflection.to_s, kNotNegative);
  reflection.delay_ticks = table.number_or("delay_ticks", reflection.delay_ticks, {-20'000.0, 20'000.0});
  reflection.width_ratio = table.number_or("width_ratio", reflection.width_ratio, {0.01, 10.0});
  return reflection;
}

FaultScenario read_faults(const TomlTable& table, const LighthouseScenario& scenario) {
  FaultScenario f;
  f.missed_flash_rate = table.number_or("missed_flash_rate", 0.0, kFraction);
  f.missed_flash_burst = table.number_or("missed_flash_burst", f.missed_flash_burst, {1.0, 1e5});
  f.missed_flash_pulse_rate = table.number_or("missed_flash_pulse_rate", 0.0, kFraction);
  f.missed_hit_rate = table.number_or("missed_hit_rate", 0.0, kFraction);
  f.stretched_flash_rate = table.number_or("stretched_flash_rate", 0.0, kFraction);
  f.merged_flash_rate = table.number_or("merged_flash_rate", 0.0, kFraction);
  f.hands_per_s = table.number_or("hands_per_s", 0.0, {0.0, 100.0});
  f.hand_s = table.number_or("hand_s", f.hand_s, kSeconds);
  f.hand_fraction = table.number_or("hand_share", f.hand_fraction, kFraction);
  f.stale_pulses = static_cast<int>(table.integer_or("stale_pulses", 0, 0, 1000));
  f.stale_s = table.number_or("stale_s", f.stale_s, {-42.0, 42.0});
  const double first_s = static_cast<double>(scenario.clock.start_ticks) * 20e-9;
  if (f.stale_pulses > 0 && !scenario.clock.wrap32 && first_s + f.stale_s < 0.0) {
    table.fail("stale_s", "would put stamps below zero; raise clock.start_ticks or set clock.wrap32");
  }
  f.reorder_rate = table.number_or("reorder_rate", 0.0, kFraction);
  f.reorder_us = table.number_or("reorder_us", f.reorder_us, {0.0, 1e6});
  f.doubled_rate = table.number_or("doubled_rate", 0.0, kFraction);
  f.lost_edge_rate = table.number_or("lost_edge_rate", 0.0, kFraction);
  f.cut_burst_rate = table.number_or("cut_burst_rate", 0.0, kFraction);
  f.glitches_per_s = table.number_or("glitches_per_s", 0.0, kPerSecond);
  f.endless_per_s = table.number_or("endless_per_s", 0.0, kPerSecond);
  f.ootx_corrupt_rate = table.number_or("ootx_corrupt_rate", 0.0, kFraction);
  for (const TomlTable& reflection : table.tables("reflection")) {
    f.reflections.push_back(read_reflection(reflection, scenario));
  }
  for (const TomlTable& restart : table.tables("restart")) {
    f.restarts.push_back({read_station_number(restart, scenario.stations.size()), restart.number("at_s", kSeconds),
                          restart.number_or("off_s", 3.0, kSeconds)});
  }
  for (const TomlTable& blackout : table.tables("blackout")) {
    const Interval interval{blackout.number("from_s", kSeconds), blackout.number("to_s", kSeconds)};
    if (interval.to_s <= interval.from_s) blackout.fail("to_s", "must be later than from_s");
    f.blackouts.push_back(interval);
  }
  return f;
}

RoomFromBody pose_of_row(const std::vector<double>& row, std::size_t first) {
  const Eigen::Vector4d xyzw(row[first + 1], row[first + 2], row[first + 3], row[first]);
  return {Quaternion(xyzw).normalized().toRotationMatrix(), {row[first + 4], row[first + 5], row[first + 6]}};
}

void check_quaternion(const TomlTable& table, const std::vector<double>& row, std::size_t first) {
  const double norm = std::sqrt(row[first] * row[first] + row[first + 1] * row[first + 1] +
                                row[first + 2] * row[first + 2] + row[first + 3] * row[first + 3]);
  if (std::abs(norm - 1.0) > 0.01) table.fail("poses", "every row must hold a unit quaternion w, x, y, z");
}

std::shared_ptr<const Trajectory> read_rest(const TomlTable& table, const LighthouseScenario& scenario,
                                            std::uint64_t seed) {
  std::vector<RoomFromBody> poses;
  for (const std::vector<double>& row : table.rows("poses", 7, kMetres)) {
    check_quaternion(table, row, 0);
    poses.push_back(pose_of_row(row, 0));
  }
  RandomStationaryPoses random;
  random.count = static_cast<int>(table.integer_or("random_poses", 0, 0, 100'000));
  random.min_range_m = table.number_or("min_range_m", random.min_range_m, {0.1, 100.0});
  random.max_range_m = table.number_or("max_range_m", random.max_range_m, {random.min_range_m, 100.0});
  random.max_angle_deg = table.number_or("max_angle_deg", random.max_angle_deg, {0.0, 80.0});
  random.min_lit = static_cast<int>(table.integer_or("min_lit", random.min_lit, 0, 32));
  for (const RoomFromBody& pose : random_stationary_poses(random, scenario.target, scenario.light.max_incidence_deg,
                                                          RandomStream(seed, "rest poses"))) {
    poses.push_back(pose);
  }
  if (poses.empty()) table.fail("poses", "give poses, or random_poses above 0");
  const double hold = table.number_or("hold_s", scenario.duration_s / static_cast<double>(poses.size()), {0.01, 1e6});
  const double gap = table.number_or("gap_s", 0.0, {0.0, hold});
  const double move = table.number_or("move_s", 0.0, {0.0, hold});
  if (move == 0.0) return std::make_shared<StationaryTrajectory>(std::move(poses), hold, gap);
  if (gap > 0.0)
    table.fail("move_s", "and gap_s exclude each other: the target is carried in the light or in the dark");
  return std::make_shared<CarriedTrajectory>(std::move(poses), hold, move);
}

std::shared_ptr<const Trajectory> read_waypoints(const TomlTable& table) {
  std::vector<Waypoint> waypoints;
  for (const std::vector<double>& row : table.rows("poses", 8, {-1e6, 1e6})) {
    check_quaternion(table, row, 1);
    if (!waypoints.empty() && row[0] <= waypoints.back().time_s) table.fail("poses", "times must rise from row to row");
    waypoints.push_back({row[0], pose_of_row(row, 1)});
  }
  if (waypoints.size() < 2) table.fail("poses", "at least two rows of time_s, qw, qx, qy, qz, x_m, y_m, z_m");
  return std::make_shared<WaypointTrajectory>(waypoints);
}

std::array<Sine, 3> read_sines(const TomlTable& table, const std::string& name, const std::string& unit, double scale) {
  const auto amplitude = table.vector_or<3>(name + "_amplitude_" + unit, {0.0, 0.0, 0.0}, {-1e3, 1e3});
  const auto frequency = table.vector_or<3>(name + "_frequency_hz", {0.1, 0.1, 0.1}, {0.0, 100.0});
  const auto phase = table.vector_or<3>(name + "_phase_deg", {0.0, 0.0, 0.0}, {-360.0, 360.0});
  std::array<Sine, 3> sines;
  for (std::size_t i = 0; i < 3; ++i) sines[i] = {amplitude[i] * scale, frequency[i], phase[i] * kRadPerDeg};
  return sines;
}

std::shared_ptr<const Trajectory> read_sine(const TomlTable& table) {
  RoomFromBody centre;
  centre.R = read_attitude(table, "orientation_wxyz", {0.0, 1.0, 0.0, 0.0});
  centre.t = to_vector(table.vector_or<3>("centre_m", {0.0, 0.0, 2.0}, kMetres));
  const double spin = table.number_or("spin_deg_s", 0.0, {-3600.0, 3600.0}) * kRadPerDeg;
  return std::make_shared<SineTrajectory>(centre, read_sines(table, "position", "m", 1.0),
                                          read_sines(table, "rotation", "deg", kRadPerDeg), spin);
}

std::shared_ptr<const Trajectory> read_manoeuvre(const TomlTable& table, double duration_s, std::uint64_t seed) {
  ManoeuvreLimits limits;
  limits.low_m = to_vector(table.vector_or<3>("low_m", {-2.0, -1.0, 1.0}, kMetres));
  limits.high_m = to_vector(table.vector_or<3>("high_m", {2.0, 1.0, 5.0}, kMetres));
  if ((limits.high_m.array() < limits.low_m.array()).any() || limits.low_m.z() <= 0.0) {
    table.fail("high_m", "the volume must lie ahead of the origin (z above 0) and high_m above low_m");
  }
  limits.half_field_deg = table.number_or("half_field_deg", limits.half_field_deg, {1.0, 80.0});
  limits.speed_m_s = table.number_or("speed_m_s", limits.speed_m_s, {0.001, 50.0});
  limits.rate_deg_s = table.number_or("rate_deg_s", limits.rate_deg_s, {0.0, 3600.0});
  limits.tilt_deg = table.number_or("tilt_deg", limits.tilt_deg, {0.0, 180.0});
  return make_random_manoeuvre(limits, duration_s, RandomStream(seed, "manoeuvre"));
}

std::shared_ptr<const Trajectory> read_trajectory(const TomlTable& table, const LighthouseScenario& scenario,
                                                  std::uint64_t seed) {
  const std::string kind = table.choice("kind", {"rest", "sine", "waypoints", "manoeuvre"});
  if (kind == "rest") return read_rest(table, scenario, seed);
  if (kind == "sine") return read_sine(table);
  if (kind == "waypoints") return read_waypoints(table);
  return read_manoeuvre(table, scenario.duration_s, seed);
}

std::vector<BodyFace> read_body(const TomlTable& table) {
  std::vector<BodyFace> faces;
  for (const std::vector<double>& row : table.rows("faces", 4, kMetres)) {
    BodyFace face{{row[0], row[1], row[2]}, row[3]};
    const double length = face.normal.norm();
    if (length < 1e-6) table.fail("faces", "a face's normal must not be zero");
    face.normal /= length;
    face.offset_m /= length;
    faces.push_back(face);
  }
  return faces;
}

}  // namespace

LighthouseScenario read_scenario(const fs::path& path, std::uint64_t seed) {
  const TomlTable root = TomlTable::parse_file(path);
  LighthouseScenario scenario;
  scenario.generation = static_cast<int>(root.integer_or("generation", 1, 1, 2));
  scenario.duration_s = root.number("duration_s", {0.05, 1e5});
  scenario.target = host::read_target(beside(root, root.text("target")).string()).target;
  scenario.form = root.integer_or("model_form", 1, 1, 2) == 1 ? SheetForm::kForm1 : SheetForm::kForm2;
  scenario.errors = read_errors(root);
  scenario.body = read_body(root.table_or_empty("body"));
  scenario.clock = read_clock(root.table_or_empty("clock"));
  scenario.rotor = read_rotors(root.table_or_empty("rotor"));
  scenario.noise = read_noise(root.table_or_empty("noise"));
  scenario.light = read_light(root.table_or_empty("light"));
  const bool second = scenario.generation == 2;
  scenario.stations = second ? read_lh2_stations(root) : read_stations(root);
  if (second) refuse_faults_of_pulses(root);
  scenario.faults = read_faults(root.table_or_empty("faults"), scenario);
  scenario.trajectory = read_trajectory(root.table("trajectory"), scenario, seed);
  root.reject_unknown();
  return scenario;
}

}  // namespace pharos::sim
