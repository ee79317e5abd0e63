// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "tools/sim/lighthouse_simulator.hpp"

namespace pharos::sim {

// A decoder for simulated pulses that is independent of the product's: sufficient for clean light, written from the
// description of the signal alone.

inline constexpr double kTurn_ticks = 50e6 / 60.0;
inline constexpr double kPiTest = 3.14159265358979323846;

struct SeenFlash {
  std::int64_t rise_ticks = 0;
  std::int64_t length_ticks = 0;
  std::size_t sensors = 0;
  std::map<int, std::int64_t> rise_of;
  std::map<int, std::vector<double>> hits_ticks;  // centres after the flash, by sensor

  int code() const { return static_cast<int>(std::lround((static_cast<double>(length_ticks) - 3125.0) / 520.8333)); }
  bool axis_y() const { return (code() & 1) != 0; }
  bool data() const { return (code() & 2) != 0; }
  bool skip() const { return (code() & 4) != 0; }
};

inline std::vector<SimulatedPulse> all_pulses(LighthouseSimulator& simulator) {
  std::vector<SimulatedPulse> pulses;
  while (const auto pulse = simulator.next()) pulses.push_back(*pulse);
  return pulses;
}

/// Flashes in order; a hit belongs to the last flash before it.
inline std::vector<SeenFlash> read_flashes(std::vector<SimulatedPulse> pulses) {
  std::sort(pulses.begin(), pulses.end(),
            [](const SimulatedPulse& a, const SimulatedPulse& b) { return a.rise_ticks < b.rise_ticks; });
  std::vector<SeenFlash> flashes;
  for (const SimulatedPulse& pulse : pulses) {
    const std::int64_t length = pulse.fall_ticks - pulse.rise_ticks;
    if (length < 2000) {
      if (!flashes.empty()) {
        const double centre = 0.5 * static_cast<double>(pulse.rise_ticks + pulse.fall_ticks);
        flashes.back().hits_ticks[pulse.sensor].push_back(centre - static_cast<double>(flashes.back().rise_ticks));
      }
      continue;
    }
    if (flashes.empty() || pulse.rise_ticks - flashes.back().rise_ticks > 3000) {
      flashes.emplace_back();
      flashes.back().rise_ticks = pulse.rise_ticks;
    }
    SeenFlash& flash = flashes.back();
    flash.rise_of[pulse.sensor] = pulse.rise_ticks;
    ++flash.sensors;
    // Time zero is the strongest sensor's.
    if (length > flash.length_ticks) {
      flash.length_ticks = length;
      flash.rise_ticks = pulse.rise_ticks;
    }
  }
  return flashes;
}

/// A 12-sensor target of the paper's size: four sensors on top of a frustum, two on each slanted face.
inline Target frustum() {
  const double s = 1.0 / std::sqrt(5.0);
  Target target;
  const auto add = [&](double x, double y, double z, double nx, double ny, double nz) {
    target.push_back({static_cast<std::uint8_t>(target.size()), {x, y, z}, {nx, ny, nz}});
  };
  for (const double x : {-0.025, 0.025}) {
    for (const double y : {-0.025, 0.025}) add(x, y, 0.0625, 0, 0, 1);
  }
  add(0.055, 0.035, 0.015, 2 * s, 0, s);
  add(0.040, -0.015, 0.045, 2 * s, 0, s);
  add(-0.035, 0.055, 0.015, 0, 2 * s, s);
  add(0.015, 0.040, 0.045, 0, 2 * s, s);
  add(-0.055, -0.035, 0.015, -2 * s, 0, s);
  add(-0.040, 0.015, 0.045, -2 * s, 0, s);
  add(0.035, -0.055, 0.015, 0, -2 * s, s);
  add(-0.015, -0.040, 0.045, 0, -2 * s, s);
  return target;
}

/// Body z towards the station.
inline Matrix3 facing() { return Vector3(1, -1, -1).asDiagonal(); }

/// The frustum, stationary, with one ideal station, without noise of any kind.
inline LighthouseScenario noise_free_scenario(const RoomFromBody& pose = {facing(), {0.2, -0.15, 2.0}}) {
  LighthouseScenario scenario;
  scenario.duration_s = 1.0;
  scenario.target = frustum();
  scenario.rotor.wander_ticks = 0.0;
  scenario.rotor.turn_jitter_ticks = 0.0;
  scenario.rotor.second_wander_ticks = 0.0;
  scenario.noise = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  scenario.stations.resize(1);
  scenario.trajectory = std::make_shared<StationaryTrajectory>(std::vector<RoomFromBody>{pose}, 1e6, 0.0);
  return scenario;
}

/// The same with two stations, master and optical slave.
inline LighthouseScenario noise_free_pair() {
  LighthouseScenario scenario = noise_free_scenario();
  scenario.stations.resize(2);
  scenario.stations[0].mode = StationMode::kB;
  scenario.stations[1].mode = StationMode::kC;
  scenario.stations[1].id = 0xC33B4DE1u;
  return scenario;
}

/// theta of a point in its frame L for a form-1 station: the published equation.
inline double published_theta_form1(bool axis_y, const SheetErrors& e, const Vector3& p_L) {
  // The manufacturer's frame: X right, Y up, optical axis along -Z.
  const double X = p_L.x(), Y = -p_L.y(), ahead = p_L.z();
  const double a = axis_y ? Y : X, o = axis_y ? X : Y, s = axis_y ? 1.0 : -1.0;
  const double ax = s * std::atan2(a, ahead), ay = std::atan2(o, ahead), r = std::hypot(a, ahead);
  double g = ax + kPiTest / 2 - e.phase_rad - std::asin(e.tilt_rad * o / r);
  g -= e.gibbous_magnitude_rad * std::cos(e.gibbous_phase_rad + g);
  return g + e.curve_rad * ay * ay;
}

/// The same for form 2.
inline double published_theta_form2(bool axis_y, const SheetErrors& e, const Vector3& p_L) {
  const double X = p_L.x(), Y = -p_L.y(), ahead = p_L.z();
  const double a = axis_y ? Y : X, o = axis_y ? X : Y, s = axis_y ? 1.0 : -1.0;
  const double ax = s * std::atan2(a, ahead), ay = std::atan2(o, ahead), r = std::hypot(a, ahead);
  return kPiTest / 2 + ax -
         (std::asin(o * std::tan(e.tilt_rad) / r) + e.phase_rad -
          e.gibbous_magnitude_rad * std::sin(ax + e.gibbous_phase_rad) + e.curve_rad * ay * ay);
}

}  // namespace pharos::sim
