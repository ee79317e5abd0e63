// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace pharos::bench {

// Input of the measuring programs, as it lies in memory (little-endian, and doubles on 8 bytes, on both sides): QEMU's
// generic loader puts the file there before they start.
inline constexpr std::uintptr_t kInputAddress = 0x82000000;
inline constexpr std::uint32_t kMagic = 0x50484231;  // "1BHP"

struct SensorRow {
  std::uint64_t sensor = 0;
  std::array<double, 3> position_m{};
};

/// Phase, tilt, curve, gibbous phase and magnitude of each rotor, rad.
struct StationRow {
  std::array<std::array<double, 5>, 2> rotor{};
};

struct EdgeRow {
  std::uint32_t stamp_low = 0;
  std::uint32_t rest = 0;  // stamp / 2^32 in bits 8.., level in bit 7, sensor below

  constexpr std::int64_t stamp_ticks() const {
    return static_cast<std::int64_t>((std::uint64_t{rest >> 8U} << 32U) | stamp_low);
  }
  constexpr std::uint8_t sensor() const { return rest & 0x7FU; }
  constexpr bool rising() const { return (rest & 0x80U) != 0; }
};

/// measure_light: header, then sensors, stations (none: poses are of raw angles), edges.
struct LightHeader {
  std::uint32_t magic = kMagic;
  std::uint32_t sensors = 0;
  std::uint32_t stations = 0;
  std::uint32_t edges = 0;
  double sigma_rad = 0.0;  // noise of an angle as given to the solver
};

struct ObservationRow {
  std::uint64_t sensor_axis = 0;  // 2 sensor + axis
  double theta_rad = 0.0;
};

struct PoseRow {
  std::array<double, 9> rotation{};  // row by row
  std::array<double, 3> position_m{};
};

/// measure_pose: header, sensors, then problems: ProblemHeader, its observations.
struct PoseHeader {
  std::uint32_t magic = kMagic;
  std::uint32_t sensors = 0;
  std::uint32_t problems = 0;
  std::uint32_t from_nothing = 0;  // the first so many are solved without the prior too
  double sigma_rad = 0.0;
};

/// measure_network: header, sensors, stations, hits in the order of time.
struct NetworkHeader {
  std::uint32_t magic = kMagic;
  std::uint32_t sensors = 0;
  std::uint32_t stations = 0;
  std::uint32_t hits = 0;
};

/// Where a station of Lighthouse 1.0 stands, and what is known of that.
struct NetworkStationRow {
  PoseRow T_world_station;
  double sigma_rotation_rad = 0.0, sigma_position_m = 0.0, sigma_plane_rad = 0.0;
};

struct HitRow {
  double time_s = 0.0;
  double angle_rad = 0.0;
  std::uint64_t who = 0;  // sensor, plane in bit 8, station from bit 16 on

  constexpr std::uint8_t sensor() const { return who & 0xFFU; }
  constexpr std::size_t plane() const { return static_cast<std::size_t>(who >> 8U & 1U); }
  constexpr std::uint8_t station() const { return who >> 16U & 0xFFU; }
};

struct ProblemHeader {
  std::uint64_t observations = 0;
  PoseRow prior;
  PoseRow host;                               // the host's result
  std::array<double, 36> host_information{};  // inverse covariance
  std::uint64_t host_ambiguous = 0;
};

}  // namespace pharos::bench
