// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pharos/base/static_vector.hpp"
#include "pharos/geometry/pose.hpp"
#include "pharos/lighthouse/lh2_model.hpp"
#include "pharos/lighthouse/station_model.hpp"

namespace pharos::network {

/// Stations of one room: as many as Lighthouse 2.0 has channels.
inline constexpr std::size_t kMaxNetworkStations = 16;
inline constexpr std::size_t kPlanes = lighthouse::kPlanes;

using WorldFromStation = Pose<frame::World, frame::Lighthouse>;
using WorldFromBody = Pose<frame::World, frame::Body>;

enum class Generation : std::uint8_t { kLighthouse1 = 1, kLighthouse2 = 2 };

/// 1 sigma of what is known of a station, for covariances.
struct StationSigmas {
  /// Of each component of the orientation. A geometry that was found from a target has its positions wrong by as much
  /// as makes up for it, so bearings to bodies are better than that; their attitudes are not.
  double rotation_rad = 0.0;
  double position_m = 0.0;  // of each component, beside that
  double plane_rad = 0.0;   // of each laser plane's angle: what calibration, model and geometry leave
  /// A geometry that was found from a target is right where the target was, and the less the further from there: each
  /// station alone may be turned about that place, and all lengths of the room from it may be wrong by a fraction.
  double turn_rad = 0.0;
  double scale = 0.0;
  std::array<double, 3> anchor_m{};  // that place, world frame

  Vector3 from_anchor(const Vector3& body_m) const { return body_m - Vector3(anchor_m[0], anchor_m[1], anchor_m[2]); }
  /// What is common to a plane's angles of one body at this range, wherever it is.
  double bearing_rad(double range_m) const { return std::hypot(plane_rad, position_m / range_m); }
  /// What stations may contradict each other by in a plane's angle of a body at this place.
  double contradiction_rad(double range_m, const Vector3& body_m) const {
    return std::hypot(bearing_rad(range_m), turn_rad * from_anchor(body_m).norm() / range_m);
  }
  /// Covariance of a body's position from turn and scale, m^2.
  Matrix3 deformation(const Vector3& body_m) const {
    const Vector3 d = from_anchor(body_m);
    return (turn_rad * turn_rad + scale * scale) * d.squaredNorm() * Matrix3::Identity() -
           turn_rad * turn_rad * d * d.transpose();
  }
};

/// Independent errors of a geometry: all that four stations can have.
inline constexpr std::size_t kMaxErrorModes = 24;
/// A station's part of each at 1 sigma: rotation (rad) and position (m), as Pose::moved_by. The k-th of all stations
/// belong together, so that the covariance of all poses is the sum over k of their outer products.
using ErrorModes = StaticVector<Vector6, kMaxErrorModes>;

/// A base station of a room: what it is, where it stands, how its planes depart from ideal ones.
struct Station {
  std::uint8_t number = 0;  // LH1: 0 or 1; LH2: its channel, 0..15
  std::uint32_t id = 0;
  Generation generation = Generation::kLighthouse1;
  std::optional<WorldFromStation> T_world_station;
  /// Of both generations; the ogee terms are zero for LH1. LH1: plane 0 = axis x, 1 = axis y; LH2: a, b.
  std::array<lighthouse::PlaneCalibration, kPlanes> plane;
  std::optional<StationSigmas> sigmas;
  ErrorModes modes;  // beside `sigmas`
};

using Stations = StaticVector<Station, kMaxNetworkStations>;

/// The station of that number, or null.
const Station* find_station(const Stations& stations, std::uint8_t number);

/// Raw angle that a plane shows for a point ahead of the station (z > 0, frame L), rad: theta of LH1, alpha of LH2.
double raw_angle(const Station& station, std::size_t plane, const Vector3& p_station);

/// Gradient by the point of the same angle of an ideal station, rad/m. A real station's differs by a percent.
Vector3 ideal_gradient(Generation generation, std::size_t plane, const Vector3& p_station);

/// Unit direction (frame L, z > 0) at which the station shows both raw angles; empty where there is none.
std::optional<Vector3> direction_of(const Station& station, const lighthouse::PlaneAngles& raw_rad);

}  // namespace pharos::network
