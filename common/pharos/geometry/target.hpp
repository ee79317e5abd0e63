// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "pharos/base/capacity.hpp"
#include "pharos/base/result.hpp"
#include "pharos/base/static_vector.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos {

/// One photodiode of a cooperative target.
struct SensorPlacement {
  std::uint8_t sensor = 0;               // its number on the capture board, 0..31; numbers may have gaps
  Vector3 position_m = Vector3::Zero();  // centre of the photosensitive face, body frame
  Vector3 normal = Vector3::Zero();      // outward unit normal, body frame; zero where unknown
  bool has_normal() const { return normal.squaredNorm() > 0.5; }
};

/// Positions of a target's photodiodes: the paper's a-priori installation coordinates.
using Target = StaticVector<SensorPlacement, kMaxSensors>;

/// The placement of sensor number `sensor`, or null where the target does not have it.
const SensorPlacement* find_sensor(const Target& target, std::uint8_t sensor);

/// Why a target cannot carry a pose.
enum class TargetError : std::uint8_t {
  kNone,
  kTooFewSensors,      // fewer than three: no pose from any station
  kDuplicateNumber,    // one number twice
  kDuplicatePosition,  // two sensors closer than 0.1 mm: one of them is a mistake
  kSensorNumberTooLarge,
  kNotFinite,
  kCollinear,  // all on one line: rotation about it is unobservable
};

/// Properties of a valid target's shape that affect the pose.
struct TargetShape {
  std::size_t sensors = 0;
  /// All within 0.5 mm of one plane: single cycles may fit two poses (reported as ambiguous).
  bool coplanar = false;
  /// Standard deviations along the principal axes, m, largest first.
  Vector3 extent_m = Vector3::Zero();
};

/// Checks a target once, when it is loaded.
Result<TargetShape, TargetError> check_target(const Target& target);

/// One short lower-case phrase for messages: "fewer than three sensors", …
const char* describe(TargetError error);

}  // namespace pharos
