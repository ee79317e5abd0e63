// SPDX-License-Identifier: Apache-2.0
#include "host/stations/network_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "host/stations/station_file.hpp"
#include "host/support/exact_number.hpp"
#include "host/toml/strict_toml.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

using lighthouse::PlaneCalibration;
using network::Generation;
using network::Station;

// Several times the largest value of any real station; curve and ogee of LH2 are factors of a polynomial.
constexpr Range kSmallAngle{-0.3, 0.3};
constexpr Range kFactor{-2.0, 2.0};
constexpr Range kCircle{-6.3, 6.3};
constexpr Range kPosition_m{-1000.0, 1000.0};
constexpr Range kSigma_m{0.0, 10.0};
constexpr Range kSigma_deg{0.0, 90.0};
constexpr Range kSigmaScale{0.0, 1.0};
constexpr Range kMode{-10.0, 10.0};  // rad, m
constexpr Range kQuaternion{-1.01, 1.01};
constexpr double kUnitTolerance = 0.01;

struct Field {
  const char* lh1_key;  // as in station_file; null where LH1 has no such term
  const char* lh2_key;
  double PlaneCalibration::*member;
  Range lh1, lh2;

  const char* key(Generation generation) const { return generation == Generation::kLighthouse1 ? lh1_key : lh2_key; }
  const Range& range(Generation generation) const { return generation == Generation::kLighthouse1 ? lh1 : lh2; }
};
constexpr std::array<Field, 7> kFields{{
    {"phase_rad", "phase_rad", &PlaneCalibration::phase_rad, kSmallAngle, kSmallAngle},
    {"tilt_rad", "tilt_rad", &PlaneCalibration::tilt_rad, kSmallAngle, kSmallAngle},
    {"curve_rad", "curve", &PlaneCalibration::curve, kSmallAngle, kFactor},
    {"gibbous_phase_rad", "gibbous_phase_rad", &PlaneCalibration::gibbous_phase_rad, kCircle, kCircle},
    {"gibbous_magnitude_rad", "gibbous_magnitude_rad", &PlaneCalibration::gibbous_magnitude_rad, kSmallAngle,
     kSmallAngle},
    {nullptr, "ogee_phase_rad", &PlaneCalibration::ogee_phase_rad, kCircle, kCircle},
    {nullptr, "ogee_magnitude", &PlaneCalibration::ogee_magnitude, {0.0, 0.0}, kFactor},
}};

void read_pose(const TomlTable& table, Station& station) {
  const bool position = table.has("position_m"), rotation = table.has("rotation_wxyz");
  if (position != rotation) table.fail("position_m", "a pose needs both position_m and rotation_wxyz");
  if (!position) return;
  const auto t = table.vector<3>("position_m", kPosition_m);
  const auto q = table.vector<4>("rotation_wxyz", kQuaternion);
  const Quaternion quaternion(q[0], q[1], q[2], q[3]);
  if (!(std::abs(quaternion.norm() - 1.0) < kUnitTolerance)) table.fail("rotation_wxyz", "must have length 1");
  station.T_world_station =
      network::WorldFromStation{quaternion.normalized().toRotationMatrix(), Vector3(t[0], t[1], t[2])};
}

void read_sigmas(const TomlTable& table, Station& station) {
  network::StationSigmas sigmas;
  sigmas.rotation_rad = table.number_or("sigma_rotation_deg", 0.0, kSigma_deg) * kRadPerDeg;
  sigmas.position_m = table.number_or("sigma_position_m", 0.0, kSigma_m);
  sigmas.plane_rad = table.number_or("sigma_plane_rad", 0.0, kSmallAngle);
  sigmas.turn_rad = table.number_or("sigma_turn_deg", 0.0, kSigma_deg) * kRadPerDeg;
  sigmas.scale = table.number_or("sigma_scale", 0.0, kSigmaScale);
  sigmas.anchor_m = table.vector_or<3>("anchor_m", {}, kPosition_m);
  if (table.has("sigma_turn_deg") || table.has("sigma_scale") || table.has("sigma_rotation_deg") ||
      table.has("sigma_position_m") || table.has("sigma_plane_rad")) {
    station.sigmas = sigmas;
  }
}

void read_modes(const TomlTable& table, Station& station) {
  if (!table.has("error_modes")) return;
  const auto rows = table.rows("error_modes", 6, kMode);
  if (rows.size() > network::kMaxErrorModes) {
    table.fail("error_modes", "has more than " + std::to_string(network::kMaxErrorModes) + " rows");
  }
  for (const std::vector<double>& row : rows) {
    Vector6 mode;
    std::copy(row.begin(), row.end(), mode.data());
    station.modes.push_back(mode);
  }
}

Station read_station(const TomlTable& table) {
  Station station;
  station.number = static_cast<std::uint8_t>(table.integer("number", 0, network::kMaxNetworkStations - 1));
  station.generation = static_cast<Generation>(table.integer("generation", 1, 2));
  if (table.has("id")) station.id = read_station_id(table, "id");
  for (const Field& field : kFields) {
    const char* key = field.key(station.generation);
    if (key == nullptr) continue;
    const auto values = table.vector_or<network::kPlanes>(key, {}, field.range(station.generation));
    for (std::size_t k = 0; k < values.size(); ++k) station.plane[k].*field.member = values[k];
  }
  read_pose(table, station);
  read_sigmas(table, station);
  read_modes(table, station);
  return station;
}

std::string modes_text(const network::ErrorModes& modes) {
  std::string out = "error_modes = [\n";
  for (const Vector6& mode : modes) {
    std::array<double, 6> row{};
    std::copy(mode.begin(), mode.end(), row.begin());
    out += "  " + exact_list(row) + ",\n";
  }
  return out + "]\n";
}

}  // namespace

network::Stations read_network_file(const std::string& path) {
  const TomlTable root = TomlTable::parse_file(path);
  network::Stations stations;
  for (const TomlTable& table : root.tables("station")) {
    const Station station = read_station(table);
    if (network::find_station(stations, station.number) != nullptr) {
      table.fail("number", "station " + std::to_string(station.number) + " comes twice");
    }
    stations.push_back(station);
  }
  root.reject_unknown();
  if (stations.empty()) throw InputError(path + ": no [[station]]");
  return stations;
}

std::string network_text(const network::Stations& stations) {
  std::string out =
      "# Stations of a room: T_world_station takes the station's frame (x right, y down, z ahead) to the world.\n";
  for (const Station& station : stations) {
    std::array<char, 16> id{};
    std::snprintf(id.data(), id.size(), "%08X", static_cast<unsigned>(station.id));
    out += "\n[[station]]\nnumber = " + std::to_string(station.number) + "\nid = \"" + id.data() +
           "\"\ngeneration = " + std::to_string(static_cast<int>(station.generation)) + "\n";
    for (const Field& field : kFields) {
      const char* key = field.key(station.generation);
      if (key == nullptr) continue;
      out += std::string(key) + " = " +
             exact_list(std::array{station.plane[0].*field.member, station.plane[1].*field.member}) + "\n";
    }
    if (station.T_world_station) {
      const Vector3& t = station.T_world_station->t;
      const Quaternion q = station.T_world_station->quaternion();
      out += "position_m = " + exact_list(std::array{t.x(), t.y(), t.z()}) + "\n";
      out += "rotation_wxyz = " + exact_list(std::array{q.w(), q.x(), q.y(), q.z()}) + "\n";
    }
    if (station.sigmas) {
      out += "sigma_position_m = " + exact_number(station.sigmas->position_m) + "\n";
      out += "sigma_rotation_deg = " + exact_number(station.sigmas->rotation_rad * kDegPerRad) + "\n";
      out += "sigma_plane_rad = " + exact_number(station.sigmas->plane_rad) + "\n";
      out += "sigma_turn_deg = " + exact_number(station.sigmas->turn_rad * kDegPerRad) + "\n";
      out += "sigma_scale = " + exact_number(station.sigmas->scale) + "\n";
      out += "anchor_m = " + exact_list(station.sigmas->anchor_m) + "\n";
    }
    if (!station.modes.empty()) out += modes_text(station.modes);
  }
  return out;
}

}  // namespace pharos::host
