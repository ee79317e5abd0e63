// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/target_input.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include "firmware/bench/input.hpp"
#include "host/support/input_error.hpp"
#include "host/table/edges_reader.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/lighthouse/pulse.hpp"
#include "tools/sim/capture_feed.hpp"
#include "tools/sim/lighthouse_simulator.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

constexpr std::uint64_t kInputSeed = 1;
constexpr double kDomeRadius_m = 0.06;
constexpr double kSimulated_s = 10.0;
constexpr double kInputPriorRotation_rad = 5e-3, kInputPriorPosition_m = 5e-3;  // a cycle's motion, 1 sigma an axis
// Stamps that step back by more start another time segment (a device's stale first pulses).
constexpr std::int64_t kStretch_ticks = 2'500'000;

template <class Row>
void append(std::vector<char>& bytes, const Row& row) {
  const auto* begin = reinterpret_cast<const char*>(&row);
  bytes.insert(bytes.end(), begin, begin + sizeof(Row));
}

void append_target(std::vector<char>& bytes, const Target& target) {
  for (const SensorPlacement& s : target) {
    append(bytes, bench::SensorRow{s.sensor, {s.position_m.x(), s.position_m.y(), s.position_m.z()}});
  }
}

// Both edges of every pulse, in order within each time segment, those of one tick by sensor: as from the capture block.
std::vector<lighthouse::Edge> edges_of(const std::vector<lighthouse::RawPulse>& pulses) {
  std::vector<lighthouse::Edge> edges;
  std::size_t stretch = 0;
  const auto sort_stretch = [&] {
    std::stable_sort(edges.begin() + static_cast<std::ptrdiff_t>(stretch), edges.end(),
                     [](const auto& a, const auto& b) {
                       return std::pair(a.stamp_ticks, a.sensor) < std::pair(b.stamp_ticks, b.sensor);
                     });
    stretch = edges.size();
  };
  for (const lighthouse::RawPulse& pulse : pulses) {
    if (!edges.empty() && pulse.rise_ticks < edges.back().stamp_ticks - kStretch_ticks) sort_stretch();
    edges.push_back({pulse.rise_ticks, pulse.sensor, true});
    edges.push_back({pulse.fall_ticks, pulse.sensor, false});
  }
  sort_stretch();
  return edges;
}

void append_edges(std::vector<char>& bytes, const std::vector<lighthouse::Edge>& edges) {
  for (const lighthouse::Edge& edge : edges) {
    const auto stamp = static_cast<std::uint64_t>(edge.stamp_ticks);
    append(bytes,
           bench::EdgeRow{static_cast<std::uint32_t>(stamp), static_cast<std::uint32_t>(stamp >> 32U << 8U) |
                                                                 (edge.rising ? 0x80U : 0U) | (edge.sensor & 0x7FU)});
  }
}

bench::LightHeader light_header(std::size_t sensors, std::size_t stations, std::size_t edges) {
  bench::LightHeader header;
  header.sensors = static_cast<std::uint32_t>(sensors);
  header.stations = static_cast<std::uint32_t>(stations);
  header.edges = static_cast<std::uint32_t>(edges);
  header.sigma_rad = kPaperSigma_rad;
  return header;
}

sim::StationScenario station_at(double x_m, double turn_deg, sim::StationMode mode) {
  sim::StationScenario station;
  station.id += static_cast<std::uint32_t>(mode);
  station.mode = mode;
  station.pose.t = Vector3(x_m, 0.0, 0.0);
  station.pose.R = rotation_exp(Vector3(0.0, turn_deg * kRadPerDeg, 0.0));
  station.calibration.reset();
  return station;
}

// The scene with the full rate: every sensor of a dome hit in every sweep of two stations.
sim::LighthouseScenario full_rate(int sensors) {
  sim::LighthouseScenario scenario;
  scenario.duration_s = kSimulated_s;
  scenario.target = dome_target(sensors);
  scenario.stations = {station_at(-1.0, 25.0, sim::StationMode::kB), station_at(1.0, -25.0, sim::StationMode::kC)};
  const Matrix3 facing = Vector3(1.0, -1.0, -1.0).asDiagonal();
  scenario.trajectory = std::make_shared<sim::StationaryTrajectory>(
      std::vector<sim::RoomFromBody>{{facing, {0.1, -0.1, 2.2}}}, scenario.duration_s, 0.0);
  return scenario;
}

std::vector<lighthouse::RawPulse> pulses_of(sim::LighthouseSimulator& simulator) {
  std::vector<lighthouse::RawPulse> pulses;
  while (const auto pulse = simulator.next()) pulses.push_back({pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
  return pulses;
}

template <class Parent, class Child>
bench::PoseRow row_of(const Pose<Parent, Child>& pose) {
  bench::PoseRow row;
  for (int i = 0; i < 9; ++i) row.rotation[static_cast<std::size_t>(i)] = pose.R(i / 3, i % 3);
  for (int i = 0; i < 3; ++i) row.position_m[static_cast<std::size_t>(i)] = pose.t[i];
  return row;
}

struct Posed {
  test::PnpProblem problem;
  LighthouseFromBody prior;
};

void append_problem(std::vector<char>& bytes, const Posed& posed, const LighthousePoseEstimate& host) {
  bench::ProblemHeader header;
  header.observations = posed.problem.observations.size();
  header.prior = row_of(posed.prior);
  header.host = row_of(host.pose);
  const Matrix6 information = host.covariance.inverse();
  std::memcpy(header.host_information.data(), information.data(), sizeof header.host_information);
  header.host_ambiguous = host.ambiguous() ? 1 : 0;
  append(bytes, header);
  for (const pose::Observation& o : posed.problem.observations) {
    append(bytes, bench::ObservationRow{2U * o.sensor + static_cast<std::uint64_t>(index_of(o.axis)), o.theta_rad});
  }
}

}  // namespace

Target dome_target(int sensors) {
  constexpr double kGoldenAngle_rad = 2.399963229728653;
  Target target;
  for (int k = 0; k < sensors; ++k) {
    const double height = (k + 0.5) / sensors, radius = std::sqrt(1.0 - height * height);
    const double angle_rad = kGoldenAngle_rad * k;
    target.push_back({static_cast<std::uint8_t>(k),
                      kDomeRadius_m * Vector3(radius * std::cos(angle_rad), radius * std::sin(angle_rad), height),
                      Vector3::Zero()});
  }
  return target;
}

std::vector<char> recorded_light(const std::string& edges) {
  host::EdgesReader reader{host::ByteSource(edges)};
  std::vector<lighthouse::RawPulse> pulses;
  while (const auto pulse = reader.next()) pulses.push_back(*pulse);
  if (pulses.empty()) throw host::InputError(edges + ": holds no pulses to decode; give a longer recording");
  const std::vector<lighthouse::Edge> sorted = edges_of(pulses);
  std::vector<char> bytes;
  append(bytes, light_header(0, 0, sorted.size()));
  append_edges(bytes, sorted);
  return bytes;
}

std::vector<char> simulated_light(int sensors) {
  const sim::LighthouseScenario scenario = full_rate(sensors);
  sim::LighthouseSimulator simulator(scenario, kInputSeed);
  const std::vector<lighthouse::RawPulse> pulses = pulses_of(simulator);
  const std::vector<lighthouse::Edge> edges = edges_of(pulses);
  std::vector<char> bytes;
  append(bytes, light_header(scenario.target.size(), simulator.stations().size(), edges.size()));
  append_target(bytes, scenario.target);
  for (const sim::SimulatedStation& station : simulator.stations()) {
    bench::StationRow row;
    for (std::size_t r = 0; r < 2; ++r) {
      const sim::SheetErrors& e = station.announced.rotor[r];
      row.rotor[r] = {e.phase_rad, e.tilt_rad, e.curve_rad, e.gibbous_phase_rad, e.gibbous_magnitude_rad};
    }
    append(bytes, row);
  }
  append_edges(bytes, edges);
  return bytes;
}

std::vector<char> network_hits(const NetworkFlight& flight) {
  std::vector<char> bytes;
  bench::NetworkHeader header;
  header.sensors = static_cast<std::uint32_t>(flight.target.size());
  header.stations = static_cast<std::uint32_t>(flight.stations.size());
  header.hits = static_cast<std::uint32_t>(flight.hits.size());
  append(bytes, header);
  append_target(bytes, flight.target);
  for (const network::Station& station : flight.stations) {
    const network::StationSigmas sigmas = station.sigmas.value_or(network::kUnstatedSigmas);
    append(bytes, bench::NetworkStationRow{row_of(*station.T_world_station), sigmas.rotation_rad, sigmas.position_m,
                                           sigmas.plane_rad});
  }
  for (const NetworkBenchHit& one : flight.hits) {
    append(bytes, bench::HitRow{one.hit.time_s, one.hit.angle_rad,
                                one.hit.sensor | std::uint64_t{one.plane} << 8U | std::uint64_t{one.station} << 16U});
  }
  return bytes;
}

std::vector<char> simulated_words(int sensors, double cycles) {
  constexpr std::uint32_t kSpeed = 0xFFFFFFFE;  // firmware/board/qemu_virt/capture_replay.hpp
  sim::LighthouseSimulator simulator(full_rate(sensors), kInputSeed);
  std::vector<lighthouse::RawPulse> pulses = pulses_of(simulator);
  std::stable_sort(pulses.begin(), pulses.end(),
                   [](const auto& a, const auto& b) { return a.rise_ticks < b.rise_ticks; });
  sim::CaptureFeed feed;
  std::int64_t now_ticks = 0;
  for (const lighthouse::RawPulse& pulse : pulses) {
    if (pulse.rise_ticks - now_ticks >= kTicksPerSecond / 1000) feed.advance(now_ticks = pulse.rise_ticks);
    feed.push(pulse);
  }
  feed.advance(now_ticks + kTicksPerSecond / 10);
  feed.end();
  std::vector<char> words;
  append(words, std::array<std::uint32_t, 4>{kSpeed, static_cast<std::uint32_t>(std::lround(1024 * cycles))});
  words.insert(words.end(), feed.bytes().begin(), feed.bytes().end());
  return words;
}

PoseInput pose_problems(const Target& target, int min_seen, int max_seen, int problems, int from_nothing) {
  test::PnpSet set;
  set.coplanar_views = false;
  set.min_sensors = min_seen;
  set.max_sensors = max_seen;
  test::PnpGenerator generator(target, set, kInputSeed);
  PoseInput input;
  bench::PoseHeader header;
  header.sensors = static_cast<std::uint32_t>(target.size());
  header.from_nothing = static_cast<std::uint32_t>(from_nothing);
  header.sigma_rad = set.sigma_rad;
  std::vector<char> rows;
  std::vector<double> warm_s, nothing_s;
  while (header.problems < static_cast<std::uint32_t>(problems)) {
    Posed posed{generator.next(), {}};
    Vector6 off;
    for (int i = 0; i < 6; ++i) off[i] = (i < 3 ? kInputPriorRotation_rad : kInputPriorPosition_m) * generator.normal();
    posed.prior = posed.problem.truth.moved_by(off);
    Result<pose::Solution, pose::Refusal> host = pose::Refusal::kNotConverged;
    const auto solve = [&](const LighthouseFromBody* prior) {
      return seconds_of([&] { host = pose::solve(target, posed.problem.observations, {}, prior); });
    };
    nothing_s.push_back(solve(nullptr));
    warm_s.push_back(solve(&posed.prior));
    if (!host.ok()) continue;
    append_problem(rows, posed, host->estimate);
    ++header.problems;
  }
  append(input.bytes, header);
  append_target(input.bytes, target);
  input.bytes.insert(input.bytes.end(), rows.begin(), rows.end());
  input.host_warm_us = 1e6 * middle_of(warm_s);
  input.host_nothing_us = 1e6 * middle_of(nothing_s);
  return input;
}

}  // namespace pharos::tools
