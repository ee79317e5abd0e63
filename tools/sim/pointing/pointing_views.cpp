// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/pointing/pointing_views.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "pharos/base/units.hpp"
#include "tools/sim/pointing/sky_frames.hpp"

namespace pharos::sim {
namespace {

constexpr double kGravity_m3_s2 = 3.986004418e14;
constexpr double kEarthRate_rad_s = 7.292115e-5;

Vector3 random_direction(RandomStream& random) {
  const Vector3 v(random.normal(), random.normal(), random.normal());
  return v.normalized();
}

Matrix3 inertial_from_earth(double seconds) {
  return Eigen::AngleAxisd(kEarthRate_rad_s * seconds, Vector3::UnitZ()).toRotationMatrix();
}

// The circular orbit in I, which is E at time 0, the pass' middle.
class Orbit {
 public:
  Orbit(const PointingPass& pass, const PointingStation& station) {
    const Vector3 place = station_in_earth_m(station);
    const Matrix3 R = earth_from_station(station);
    radius_m_ = place.norm() + pass.altitude_m;
    const Vector3 up = place.normalized();
    const Vector3 ahead = (std::sin(pass.heading_rad) * R.col(0) + std::cos(pass.heading_rad) * R.col(1));
    const Vector3 level = (ahead - ahead.dot(up) * up).normalized();
    above_ = std::cos(pass.side_rad) * up + std::sin(pass.side_rad) * up.cross(level);
    flight_ = level;
    rate_rad_s_ = std::sqrt(kGravity_m3_s2 / (radius_m_ * radius_m_ * radius_m_));
  }
  Vector3 up(double seconds) const {
    return std::cos(rate_rad_s_ * seconds) * above_ + std::sin(rate_rad_s_ * seconds) * flight_;
  }
  Vector3 place_m(double seconds) const { return radius_m_ * up(seconds); }
  /// Columns: flight, against the orbit's normal, nadir.
  Matrix3 axes(double seconds) const {
    const Vector3 normal = above_.cross(flight_), down = -up(seconds);
    Matrix3 R;
    R << normal.cross(Vector3(-down)), -normal, down;
    return R;
  }

 private:
  double radius_m_ = 0.0;
  Vector3 above_, flight_;
  double rate_rad_s_ = 0.0;
};

Vector3 axis_inertial(const PointingPass& pass, const Orbit& orbit, double seconds) {
  const Vector3 axis = pass.axis.normalized();
  switch (pass.law) {
    case PointingPass::Law::kInertial:
      return axis;
    case PointingPass::Law::kNadir:
      return orbit.axes(seconds) * axis;
    case PointingPass::Law::kSpin:
      return Eigen::AngleAxisd(pass.spin_rate_rad_s * seconds, pass.spin.normalized()) * axis;
  }
  return axis;
}

}  // namespace

Vector3 sun_for(const PointingView& view, RandomStream& random) {
  const Vector3 sight = station_from_camera(view.azimuth_rad, view.elevation_rad).col(2);
  const Vector3 between = (view.R_station_body.col(2) - sight).normalized();
  return (between + 0.3 * random_direction(random)).normalized();
}

std::vector<PointingView> random_views(const RandomPointingViews& limits, RandomStream random) {
  std::vector<PointingView> views;
  while (static_cast<int>(views.size()) < limits.count) {
    PointingView view;
    view.time_s = static_cast<double>(views.size());
    view.range_m = limits.range_m;
    view.azimuth_rad = random.uniform(0.0, kTwoPi);
    view.elevation_rad = random.uniform(limits.min_elevation_rad, limits.max_elevation_rad);
    const Vector3 sight = station_from_camera(view.azimuth_rad, view.elevation_rad).col(2);
    const Vector3 axis = random_direction(random);
    if (std::acos(std::min(1.0, std::abs(axis.dot(sight)))) < limits.min_from_sight_rad) continue;
    view.R_station_body = station_from_body(axis, sight, random.uniform(-limits.max_roll_rad, limits.max_roll_rad));
    view.to_sun_station = sun_for(view, random);
    views.push_back(view);
  }
  return views;
}

std::vector<PointingView> pass_views(const PointingPass& pass, const PointingStation& station, RandomStream random) {
  const Orbit orbit(pass, station);
  const Matrix3 R_earth_station = earth_from_station(station);
  std::vector<PointingView> views;
  for (int k = 0; k < pass.images; ++k) {
    const double seconds = pass.spacing_s * (k - 0.5 * (pass.images - 1));
    const Matrix3 R_inertial_station = inertial_from_earth(seconds) * R_earth_station;
    const Vector3 to = R_inertial_station.transpose() * orbit.place_m(seconds) -
                       R_earth_station.transpose() * station_in_earth_m(station);
    PointingView view;
    view.time_s = pass.start_s + pass.spacing_s * k;
    view.azimuth_rad = std::atan2(to.x(), to.y());
    if (view.azimuth_rad < 0.0) view.azimuth_rad += kTwoPi;
    view.elevation_rad = std::atan2(to.z(), std::hypot(to.x(), to.y()));
    view.range_m = to.norm();
    const Vector3 axis = R_inertial_station.transpose() * axis_inertial(pass, orbit, seconds);
    view.R_station_body = station_from_body(axis, to.normalized(), 0.2);
    view.to_sun_station = sun_for(view, random);
    views.push_back(view);
  }
  return views;
}

}  // namespace pharos::sim
