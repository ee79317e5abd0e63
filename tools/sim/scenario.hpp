// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pharos/geometry/target.hpp"
#include "tools/sim/laser_sheet.hpp"
#include "tools/sim/trajectory.hpp"

namespace pharos::sim {

// A scenario of the lighthouse simulator: what a TOML file says (read_scenario), or what a program fills in. Every
// default is that of the file; README.md lists keys, units and where the numbers come from. Ticks are 20 ns.

/// Role of a station in the slot cycle: A cable slave or single station, B master, C optical slave.
enum class StationMode : std::uint8_t { kA = 0, kB = 1, kC = 2 };

struct StationScenario {
  std::uint32_t id = 0xBEC08E38u;
  StationMode mode = StationMode::kA;
  int channel = 0;  // of Lighthouse 2.0
  RoomFromStation pose;
  /// Calibration before half precision; empty: typical values drawn from the seed.
  std::optional<std::array<SheetErrors, 2>> calibration = std::array<SheetErrors, 2>{};
};

struct ClockScenario {
  std::int64_t start_ticks = 50'000'000;
  double offset_ppm = 0.0;
  double drift_ppm_per_s = 0.0;
  bool wrap32 = false;  // written stamps keep 32 bits only
};

struct RotorScenario {
  double rate_hz = 60.0;
  double offset_ppm = 0.0;
  double wander_ticks = 177.0;          // slow wander of each rotor's phase, standard deviation
  double turn_jitter_ticks = 4.0;       // from turn to turn, flash and laser together: no angle error
  double second_delay_ticks = 20404.0;  // second station's flash after the first's
  double second_wander_ticks = 100.0;
};

struct NoiseScenario {
  double sigma_arcsec = 8.8;          // of one sensor's angle in one sweep
  double rho = 0.8717;                // correlation of two sensors of one rotor
  double flash_fraction = 0.6;        // of the common variance: from the flash; the rest from the rotor
  double narrow_sigma_arcsec = 25.0;  // added for hits of 52 ticks and below, none from 104 ticks
  double flash_rise_ticks = 0.3;      // own noise of a sensor's flash edges
  double width_ticks = 2.0;           // own noise of a pulse's width
  double bit_jitter_ns = 8.0;         // of each change of the data, Lighthouse 2.0
};

struct LightScenario {
  double max_incidence_deg = 60.0;
  double max_range_m = 10.0;
  double half_field_deg = 60.0;
  double lateness_low = 0.55;  // rise delay = factor x (longest length - own length); factor drawn per sensor
  double lateness_high = 0.95;
};

/// A second hit of some sensors in every sweep of one rotor.
struct ReflectionScenario {
  int station = 0;
  Rotor rotor = Rotor::kX;
  std::vector<int> sensors;
  double from_s = 0.0;
  double to_s = 1e9;
  double delay_ticks = 866.0;  // negative: before the direct hit
  double width_ratio = 0.85;
};

struct Interval {
  double from_s = 0.0;
  double to_s = 0.0;
};

struct RestartScenario {
  int station = 0;
  double at_s = 0.0;
  double off_s = 3.0;
};

struct FaultScenario {
  double missed_flash_rate = 0.0;        // of a station's flashes, unseen by every sensor
  double missed_flash_burst = 1.0;       // flashes of a station missed in a row, mean
  double missed_flash_pulse_rate = 0.0;  // of single sensors' flash pulses
  double missed_hit_rate = 0.0;          // of hits
  double stretched_flash_rate = 0.0;     // of a station's flashes, longer by 100 to 1500 ticks on every sensor
  double merged_flash_rate = 0.0;        // of slots of two stations: one pulse from first rise to second fall
  double hands_per_s = 0.0;              // mean number of times a hand is put over sensors
  double hand_s = 0.5;                   // duration
  double hand_fraction = 0.3;            // of the sensors that it covers
  std::vector<ReflectionScenario> reflections;
  int stale_pulses = 0;  // first pulses off by stale_s (positive: ahead) and saturated in length
  double stale_s = 14.2;
  double reorder_rate = 0.0;  // of pulses that come late by up to reorder_us
  double reorder_us = 120.0;
  double doubled_rate = 0.0;       // of pulses sent twice
  double lost_edge_rate = 0.0;     // of edges
  double cut_burst_rate = 0.0;     // of Lighthouse 2.0's bursts: a part of the light only
  double glitches_per_s = 0.0;     // pulses of 1 to 20 ticks on any sensor
  double endless_per_s = 0.0;      // pulses of 20 to 200 ms
  double ootx_corrupt_rate = 0.0;  // of frames, one bit wrong
  std::vector<RestartScenario> restarts;
  std::vector<Interval> blackouts;
};

/// Face of a convex body that may occlude sensors: the body is where normal . p <= offset, p in the body frame.
struct BodyFace {
  Vector3 normal = Vector3::UnitZ();
  double offset_m = 0.0;
};

/// Standard deviations of the systematic errors; `workshop()` gives those named so.
struct ErrorScenario {
  double sensor_position_m = 0.0;
  double phase_rad = 0.0;
  double tilt_rad = 0.0;
  double curve_rad = 0.0;
  double gibbous_magnitude_rad = 0.0;

  static ErrorScenario workshop() { return {0.4e-3, 0.5e-3, 0.3e-3, 0.3e-3, 0.3e-3}; }
};

struct LighthouseScenario {
  int generation = 1;  // of the stations
  double duration_s = 10.0;
  Target target;  // nominal
  std::vector<BodyFace> body;
  SheetForm form = SheetForm::kForm1;
  ErrorScenario errors;
  ClockScenario clock;
  RotorScenario rotor;
  NoiseScenario noise;
  LightScenario light;
  std::vector<StationScenario> stations;  // one or two, of which the first flashes first; 16 of generation 2
  FaultScenario faults;
  std::shared_ptr<const Trajectory> trajectory;
};

/// Reads and checks a scenario file. The seed determines random poses and manoeuvres. Throws host::InputError with
/// file, line and key.
LighthouseScenario read_scenario(const std::filesystem::path& path, std::uint64_t seed);

}  // namespace pharos::sim
