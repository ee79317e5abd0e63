// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/orbit.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::pointing {
namespace {

constexpr double kLowest_m = 120e3;
constexpr double kHighest_m = 60'000e3;
constexpr int kHalvings = 60;

// Position in I; on the sphere of `radius_m` where the sighting's own range is not to be used.
Vector3 place_inertial(const Observation& observation, const Geodetic& station, double epoch_s, double radius_m,
                       bool by_range) {
  const Vector3 base = station_place_earth_m(station);
  const Vector3 ahead = station_to_earth(station) * direction_station(observation.sight);
  double range_m = observation.range_m;
  if (!by_range) {
    const double along = base.dot(ahead);
    range_m = -along + std::sqrt(std::max(0.0, along * along + radius_m * radius_m - base.squaredNorm()));
  }
  return earth_to_inertial(observation.time_s - epoch_s) * (base + range_m * ahead);
}

struct Motion {
  Vector3 normal = Vector3::Zero();
  double rate_rad_s = 0.0;
  double arc_rad = 0.0;
  double radius_m = 0.0;
};

Motion motion_of(std::span<const Observation> observations, const Geodetic& station, double epoch_s, double radius_m,
                 bool by_range) {
  const auto place = [&](const Observation& s) { return place_inertial(s, station, epoch_s, radius_m, by_range); };
  Motion motion;
  Vector3 before = place(observations.front());
  const Vector3 first = before.normalized();
  for (const Observation& observation : observations) {
    const Vector3 now = place(observation);
    motion.normal += before.cross(now);
    motion.radius_m += now.norm() / static_cast<double>(observations.size());
    before = now;
  }
  motion.normal.normalize();
  // Slope of the angle in the orbit's plane over time.
  const Vector3 ahead = motion.normal.cross(first);
  double n = 0.0, t = 0.0, a = 0.0, tt = 0.0, ta = 0.0;
  for (const Observation& observation : observations) {
    const Vector3 now = place(observation);
    const double angle = std::atan2(now.dot(ahead), now.dot(first)), time = observation.time_s - epoch_s;
    motion.arc_rad = std::max(motion.arc_rad, std::abs(angle));
    n += 1.0;
    t += time;
    a += angle;
    tt += time * time;
    ta += time * angle;
  }
  const double spread = tt - t * t / n;
  motion.rate_rad_s = spread > 0.0 ? (ta - t * a / n) / spread : 0.0;
  return motion;
}

double circular_rate_rad_s(double radius_m) {
  return std::sqrt(kEarthGravity_m3_s2 / (radius_m * radius_m * radius_m));
}

}  // namespace

Result<Orbit, OrbitFailure> find_orbit(std::span<const Observation> observations, const Geodetic& station,
                                       double epoch_s) {
  if (observations.size() < 3) return OrbitFailure::kTooShort;
  const bool by_range =
      std::all_of(observations.begin(), observations.end(), [](const Observation& s) { return s.range_m > 0.0; });
  double low_m = station_place_earth_m(station).norm() + kLowest_m, high_m = kEarthRadius_m + kHighest_m;
  if (!by_range) {
    // At a greater height the same lines of sight mean a faster target, and the orbit a slower one: one intersection.
    const auto too_high = [&](double radius_m) {
      return motion_of(observations, station, epoch_s, radius_m, false).rate_rad_s > circular_rate_rad_s(radius_m);
    };
    if (too_high(low_m) || !too_high(high_m)) return OrbitFailure::kNotAnOrbit;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle_m = 0.5 * (low_m + high_m);
      (too_high(middle_m) ? high_m : low_m) = middle_m;
    }
  }
  const Motion motion = motion_of(observations, station, epoch_s, low_m, by_range);
  if (!(motion.arc_rad > kMinArc_rad) || !motion.normal.allFinite()) return OrbitFailure::kTooShort;
  // Ranges of an object that stands on or hovers over the ground give no orbit.
  if (by_range && motion.radius_m < low_m) return OrbitFailure::kNotAnOrbit;
  return Orbit{motion.normal, motion.radius_m, by_range};
}

Matrix3 inertial_to_orbital(const Orbit& orbit, const Observation& observation, const Geodetic& station,
                            double epoch_s) {
  const Vector3 place = place_inertial(observation, station, epoch_s, orbit.radius_m, orbit.from_ranges);
  const Vector3& h = orbit.normal_inertial;
  const Vector3 up = (place - h.dot(place) * h).normalized();
  Matrix3 R;
  R.row(0) = h.cross(up).transpose();
  R.row(1) = -h.transpose();
  R.row(2) = -up.transpose();
  return R;
}

}  // namespace pharos::pointing
