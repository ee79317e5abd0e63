// SPDX-License-Identifier: Apache-2.0
#include "host/table/target_file.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "host/support/input_error.hpp"
#include "host/table/table_reader.hpp"

namespace pharos::host {
namespace {

constexpr double kNormalTolerance = 0.05;
// No base station is seen from farther than some 6 m, so no sensor of one target is farther from another; twice that
// allows for a body's origin elsewhere. A target of 12 mm already exceeds it when given in millimetres.
constexpr double kFarthest_m = 12.0;

struct NormalColumns {
  std::size_t x, y, z;
};

std::optional<NormalColumns> find_normals(TableReader& table) {
  const auto x = table.find_optional("nx");
  const auto y = table.find_optional("ny");
  const auto z = table.find_optional("nz");
  if (!x && !y && !z) return std::nullopt;
  if (!x || !y || !z) {
    throw InputError(table.name() + ": line 1: normals need the three columns nx,ny,nz; add the missing or remove all");
  }
  return NormalColumns{*x, *y, *z};
}

Vector3 read_position(const TableReader& table) {
  Vector3 position_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t column = axis + 1;
    const double value = table.number(column);
    if (std::abs(value) > kFarthest_m) {
      table.fail(column, std::string(table.text(column)) +
                             " m is more than 12 m from the body's origin; give metres, not millimetres");
    }
    position_m[static_cast<Eigen::Index>(axis)] = value;
  }
  return position_m;
}

Vector3 read_normal(const TableReader& table, const NormalColumns& columns) {
  if (table.empty(columns.x) && table.empty(columns.y) && table.empty(columns.z)) return Vector3::Zero();
  const Vector3 normal(table.number(columns.x), table.number(columns.y), table.number(columns.z));
  const double length = normal.norm();
  if (length == 0.0) return Vector3::Zero();
  if (std::abs(length - 1.0) > kNormalTolerance) {
    table.fail_row("the normal nx,ny,nz has length " + std::to_string(length) + "; it must be 1");
  }
  return normal / length;
}

// Finds the two lines in conflict; check_target reports only that there are two.
void check_against_earlier(const TableReader& table, const std::map<int, std::size_t>& line_of_sensor, int sensor) {
  const auto earlier = line_of_sensor.find(sensor);
  if (earlier == line_of_sensor.end()) return;
  table.fail_row("sensor " + std::to_string(sensor) + " stands already in line " + std::to_string(earlier->second) +
                 "; remove one of the two");
}

std::string closest_pair(const Target& target) {
  double minimum = std::numeric_limits<double>::infinity();
  std::string pair;
  for (std::size_t i = 0; i < target.size(); ++i) {
    for (std::size_t j = i + 1; j < target.size(); ++j) {
      const double distance = (target[i].position_m - target[j].position_m).norm();
      if (distance >= minimum) continue;
      minimum = distance;
      pair = std::to_string(target[i].sensor) + " and " + std::to_string(target[j].sensor);
    }
  }
  return pair;
}

std::string advice(const Target& target, TargetError error) {
  switch (error) {
    case TargetError::kTooFewSensors:
      return " (" + std::to_string(target.size()) + "); a pose needs four in view";
    case TargetError::kDuplicatePosition:
      return " (" + closest_pair(target) + "); correct the position of one";
    case TargetError::kCollinear:
      return "; rotation about it cannot be seen: place some sensors off the line";
    default:
      return "";
  }
}

}  // namespace

TargetFile read_target(const std::string& path) {
  TableReader table(ByteSource(path), {"sensor", "x_m", "y_m", "z_m"});
  const std::optional<NormalColumns> normals = find_normals(table);
  TargetFile file;
  std::map<int, std::size_t> line_of_sensor;
  while (table.next()) {
    const auto sensor = static_cast<int>(table.integer(0, 0, kMaxSensors - 1));
    check_against_earlier(table, line_of_sensor, sensor);
    line_of_sensor[sensor] = table.line_number();
    SensorPlacement placement;
    placement.sensor = static_cast<std::uint8_t>(sensor);
    placement.position_m = read_position(table);
    if (normals) placement.normal = read_normal(table, *normals);
    file.target.push_back(placement);
  }
  const Result<TargetShape, TargetError> shape = check_target(file.target);
  if (!shape) {
    throw InputError(table.name() + ": " + describe(shape.error()) + advice(file.target, shape.error()));
  }
  file.shape = *shape;
  return file;
}

}  // namespace pharos::host
