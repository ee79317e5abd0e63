// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/calibration_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host/support/input_error.hpp"
#include "host/toml/strict_toml.hpp"
#include "pharos/base/units.hpp"

namespace pharos::calibrate {
namespace {

using host::InputError;
using host::Range;
using host::TomlTable;

constexpr Range kMetres{-12.0, 12.0};  // as in a target's table
constexpr double kSamePlace_m = 1e-3;
constexpr std::int64_t kMaxParameters = 3 * kMaxSensors + kMaxStations * kAxes * kRotorParameters + 6;

Vector3 vector_of(const std::array<double, 3>& values) { return Vector3(values.data()); }

std::string id_text(std::uint32_t id) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%08X", static_cast<unsigned>(id));
  return text.data();
}

void read_sensor(const TomlTable& table, CalibrationFile& file) {
  SensorPlacement sensor;
  sensor.sensor = static_cast<std::uint8_t>(table.integer("sensor", 0, kMaxSensors - 1));
  sensor.position_m = vector_of(table.vector<3>("position_m", kMetres));
  sensor.normal = vector_of(table.vector_or<3>("normal", {}, {-1.0, 1.0}));
  if (find_sensor(file.sensors, sensor.sensor) != nullptr) table.fail("sensor", "stands already in the file");
  file.sensors.push_back(sensor);
  file.nominal_m.push_back(vector_of(table.vector<3>("nominal_m", kMetres)));
  table.vector_or<3>("sigma_m", {}, host::kNotNegative);
}

// For readers of the file and for estimates of the calibration's accuracy; tracking itself uses only the scale.
void read_summary(const TomlTable& table, CalibrationFile& file) {
  table.choice_or("scale", "prior", {"prior", "measured"});
  file.scale_sigma = table.number_or("scale_sigma", 0.0, {0.0, 1.0});
  file.model_form = static_cast<int>(table.integer_or("model_form", 0, 1, 2));
  table.integer_or("stills", 0, 0, 1'000'000'000);
  table.integer_or("poses", 0, 0, 1'000'000'000);
  table.number_or("unmodelled_arcsec", 0.0, host::kNotNegative);
  table.text_or("body_frame", "");
  file.parameters = table.texts("parameters");
  if (file.parameters.size() > static_cast<std::size_t>(kMaxParameters)) {
    table.fail("parameters", "more than any calibration has");
  }
  file.covariance = table.rows("covariance", file.parameters.size());
  if (file.covariance.size() != file.parameters.size()) {
    table.fail("covariance", "must have a row for each of the parameters");
  }
}

// The six rows and columns of the covariance that belong to the pair.
Matrix6 pair_covariance(const TomlTable& table, const CalibrationFile& file) {
  const std::string first = "station " + id_text(file.pair->station) + " turn_x_rad";
  const auto found = std::find(file.parameters.begin(), file.parameters.end(), first);
  const auto at = static_cast<std::size_t>(found - file.parameters.begin());
  if (at + 6 > file.parameters.size()) {
    table.fail("station", "the covariance in [calibration] does not tell how well its pose is known; keep \"" + first +
                              "\" and what follows, or remove this [[pair]]");
  }
  Matrix6 covariance;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      covariance(i, j) = file.covariance[at + static_cast<std::size_t>(i)][at + static_cast<std::size_t>(j)];
    }
  }
  return covariance;
}

void read_pair(const TomlTable& table, CalibrationFile& file) {
  if (file.pair) table.fail("reference", "a second [[pair]]; two stations make one");
  file.pair.emplace();
  file.pair->reference = host::read_station_id(table, "reference");
  file.pair->station = host::read_station_id(table, "station");
  const std::array<double, 4> wxyz = table.vector<4>("orientation_wxyz", {-1.0, 1.0});
  const Quaternion q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  constexpr double kUnitWithin = 1e-3;
  if (!(std::abs(q.norm() - 1.0) < kUnitWithin)) table.fail("orientation_wxyz", "must be a unit quaternion");
  file.pair->T_reference_station = {q.normalized().toRotationMatrix(), vector_of(table.vector<3>("position_m"))};
  file.pair->covariance = pair_covariance(table, file);
}

CalibrationFile read(const TomlTable& root, const std::string& name) {
  CalibrationFile file;
  file.name = name;
  file.stations = host::read_stations(root);
  read_summary(root.table_or_empty("calibration"), file);
  for (const TomlTable& table : root.tables("sensor")) read_sensor(table, file);
  for (const TomlTable& table : root.tables("pair")) read_pair(table, file);
  root.reject_unknown();
  if (file.has_target()) {
    const auto shape = check_target(file.sensors);
    if (!shape) throw InputError(file.name + ": the [[sensor]] tables are no target: " + describe(shape.error()));
  }
  return file;
}

}  // namespace

CalibrationFile read_calibration_file(const std::string& path) {
  return read(TomlTable::parse_file(path), path == "-" ? "standard input" : path);
}

CalibrationFile parse_calibration(std::string_view text, const std::string& name) {
  return read(TomlTable::parse_text(text, name), name);
}

Target calibrated_target(const CalibrationFile& file, const Target& nominal) {
  if (!file.has_target()) return nominal;
  const std::string other = file.name + ": a calibration of another target: ";
  Target target = nominal;
  for (SensorPlacement& sensor : target) {
    const SensorPlacement* calibrated = find_sensor(file.sensors, sensor.sensor);
    const std::string which = "sensor " + std::to_string(sensor.sensor);
    if (calibrated == nullptr) {
      throw InputError(other + which + " is not in it; give the calibration made with this table");
    }
    const Vector3& was = file.nominal_m[static_cast<std::size_t>(calibrated - file.sensors.begin())];
    if ((sensor.position_m - was).norm() > kSamePlace_m) {
      throw InputError(other + which + " stands elsewhere in its table; calibrate with this table");
    }
    sensor.position_m = calibrated->position_m;
  }
  for (const SensorPlacement& sensor : file.sensors) {
    if (find_sensor(nominal, sensor.sensor) == nullptr) {
      throw InputError(other + "its sensor " + std::to_string(sensor.sensor) +
                       " is not in the target's table; give the calibration made with this table");
    }
  }
  return target;
}

void widen_by_scale(LighthousePoseEstimate& estimate, double scale_sigma) {
  // If the target is larger by the factor 1 + s, its range is larger by the same factor.
  const Vector3 shift_m = scale_sigma * estimate.pose.t;
  estimate.covariance.bottomRightCorner<3, 3>() += shift_m * shift_m.transpose();
}

}  // namespace pharos::calibrate
