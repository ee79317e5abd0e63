// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "pharos/geometry/pose.hpp"
#include "pharos/geometry/target.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

/// W: the scenario's room, in which stations and trajectories are given. If the first station's pose is omitted, it is
/// that station's frame L.
struct Room {};

using RoomFromBody = Pose<Room, frame::Body>;
using RoomFromStation = Pose<Room, frame::Lighthouse>;

/// The target's pose at any (true) time.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  virtual RoomFromBody at(double time_s) const = 0;
  /// False while no light reaches the target: between two stationary poses, while it is moved.
  virtual bool lit(double time_s) const;
};

/// Stationary poses one after the other, `hold_s` each, the last `gap_s` of each without light.
class StationaryTrajectory final : public Trajectory {
 public:
  StationaryTrajectory(std::vector<RoomFromBody> poses, double hold_s, double gap_s);
  RoomFromBody at(double time_s) const override;
  bool lit(double time_s) const override;

 private:
  std::size_t index_at(double time_s) const;
  std::vector<RoomFromBody> poses_;
  double hold_s_;
  double gap_s_;
};

/// Stationary poses one after the other, `hold_s` each; in the last `move_s` of each the target moves to the next one
/// with light: straight, with an even rotation, and smooth at both ends.
class CarriedTrajectory final : public Trajectory {
 public:
  CarriedTrajectory(std::vector<RoomFromBody> poses, double hold_s, double move_s);
  RoomFromBody at(double time_s) const override;

 private:
  std::vector<RoomFromBody> poses_;
  double hold_s_;
  double move_s_;
};

/// One coordinate as a sine: amplitude sin(2 pi frequency t + phase).
struct Sine {
  double amplitude = 0.0;
  double frequency_hz = 0.0;
  double phase_rad = 0.0;
  double at(double time_s) const;
};

/// t = t0 + sines; R = R0 Rz(spin t) exp([sines, rotation vector in the body frame]x).
class SineTrajectory final : public Trajectory {
 public:
  SineTrajectory(const RoomFromBody& centre, const std::array<Sine, 3>& position_m,
                 const std::array<Sine, 3>& rotation_rad, double spin_rad_s);
  RoomFromBody at(double time_s) const override;

 private:
  RoomFromBody centre_;
  std::array<Sine, 3> position_m_;
  std::array<Sine, 3> rotation_rad_;
  double spin_rad_s_;
};

/// One pose with its time.
struct Waypoint {
  double time_s = 0.0;
  RoomFromBody pose;
};

/// Natural cubic splines through the waypoints' positions and (sign-aligned, then normalised) quaternions; at rest
/// before the first and after the last. Neighbouring attitudes should differ by less than 90 deg.
class WaypointTrajectory final : public Trajectory {
 public:
  explicit WaypointTrajectory(const std::vector<Waypoint>& waypoints);
  RoomFromBody at(double time_s) const override;

 private:
  using Coordinates = Eigen::Matrix<double, 7, 1>;
  std::vector<double> times_s_;
  std::vector<Coordinates> values_;
  std::vector<Coordinates> curvatures_;
};

/// Limits of a random manoeuvre.
struct ManoeuvreLimits {
  Vector3 low_m{-2.0, -1.0, 1.0};  // the volume, in the room; paper 002, section 4.3: 4 m x 4 m x 2 m,
  Vector3 high_m{2.0, 1.0, 5.0};   // starting about 1 m ahead of the station
  double half_field_deg = 50.0;    // kept within this angle of straight ahead of the room's origin
  double speed_m_s = 0.5;          // greatest speed, reached
  double rate_deg_s = 60.0;        // greatest turning rate, reached where following the station needs less
  double tilt_deg = 35.0;          // the body's z axis stays about this close to the direction to the origin
};

/// Smooth random flight within a volume, the body's z axis roughly towards the room's origin: sums of three sines of
/// random frequency and phase for each coordinate, scaled to the greatest speed and rate over `duration_s`.
std::unique_ptr<Trajectory> make_random_manoeuvre(const ManoeuvreLimits& limits, double duration_s,
                                                  RandomStream random);

/// Limits of random stationary poses.
struct RandomStationaryPoses {
  int count = 1;
  double min_range_m = 1.0;
  double max_range_m = 4.0;
  double max_angle_deg = 45.0;  // of the direction, in both axes, from straight ahead of the room's origin
  int min_lit = 4;              // sensors whose incidence is below the limit
};

/// Random stationary poses: direction and range uniform, attitude uniform among those with enough lit sensors. Throws
/// host::InputError if none of 10,000 attitudes has as many.
std::vector<RoomFromBody> random_stationary_poses(const RandomStationaryPoses& limits, const Target& target,
                                                  double max_incidence_deg, RandomStream random);

/// Rotation uniform over all attitudes.
Matrix3 random_rotation(RandomStream& random);

}  // namespace pharos::sim
