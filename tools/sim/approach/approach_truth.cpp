// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/approach_truth.hpp"

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

constexpr double kLastSpeed_m_s = 0.005;
constexpr double kFullTurn = 2.0 * kPi;
const Matrix3 kFacing = Vector3(1.0, -1.0, -1.0).asDiagonal();  // the target's z axis towards the vehicle

Matrix3 about_z(double angle_rad) { return rotation_exp({0.0, 0.0, angle_rad}); }

Sine random_sine(RandomStream& random, double amplitude, double low_hz, double high_hz) {
  return {amplitude, random.uniform(low_hz, high_hz), random.uniform(0.0, kFullTurn)};
}

double distance_after(double start_m, double decay, double time_s) {
  const double rest = kLastSpeed_m_s / decay;
  return (start_m + rest) * std::exp(-decay * time_s) - rest;
}

// The k with which the distance is end_m after the duration; bisection, since the distance falls with k.
double decay_of(const ApproachMotion& motion) {
  double low = 1e-9, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (distance_after(motion.start_m, middle, motion.duration_s) > motion.end_m ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Vector3 sum(const std::array<Sine, 6>& sines, double time_s) {
  return {sines[0].at(time_s) + sines[3].at(time_s), sines[1].at(time_s) + sines[4].at(time_s),
          sines[2].at(time_s) + sines[5].at(time_s)};
}

}  // namespace

ApproachTruth::ApproachTruth(const ApproachMotion& motion, std::uint64_t seed)
    : motion_(motion), decay_per_s_(decay_of(motion)) {
  RandomStream random(seed, "approach motion");
  const double nutation = motion.nutation_deg * kRadPerDeg;
  const double axial = motion.inertia_ratio;  // transverse moment of inertia: 1
  const double momentum = motion.rate_deg_s * kRadPerDeg / std::hypot(std::cos(nutation) / axial, std::sin(nutation));
  precession_rad_s_ = momentum;
  spin_rad_s_ = momentum * std::cos(nutation) * (1.0 / axial - 1.0);
  precession_phase_rad_ = random.uniform(0.0, kFullTurn);
  spin_phase_rad_ = random.uniform(0.0, kFullTurn);
  const bool fast = motion.form == ApproachMotion::Form::kManoeuvre;
  for (std::size_t i = 0; i < sway_.size(); ++i) {
    sway_[i] = random_sine(random, 0.5, fast ? 0.03 : 0.003, fast ? 0.12 : 0.012);
    turn_[i] = random_sine(random, 0.5, 0.03, 0.12);
  }
  for (Sine& sine : vehicle_sway_rad_) {
    sine = random_sine(random, motion.attitude_sway_deg * kRadPerDeg, 0.005, 0.02);
  }
}

double ApproachTruth::distance_m(double time_s) const { return distance_after(motion_.start_m, decay_per_s_, time_s); }

host::VehicleFromTarget ApproachTruth::approach(double time_s) const {
  const double distance = distance_m(time_s);
  const double sway = motion_.sway_m * distance / motion_.start_m;
  const Vector3 aside = sway * sum(sway_, time_s);
  host::VehicleFromTarget pose;
  pose.R = kFacing * about_z(precession_phase_rad_ + precession_rad_s_ * time_s) *
           rotation_exp({motion_.nutation_deg * kRadPerDeg, 0.0, 0.0}) *
           about_z(spin_phase_rad_ + spin_rad_s_ * time_s);
  const Vector3 centre(aside.x(), aside.y(), distance + motion_.centre_of_mass_m);
  pose.t = centre + pose.R * Vector3(0.0, 0.0, motion_.centre_of_mass_m);
  const Matrix3 sway_R =
      rotation_exp({vehicle_sway_rad_[0].at(time_s), vehicle_sway_rad_[1].at(time_s), vehicle_sway_rad_[2].at(time_s)});
  return {sway_R * pose.R, sway_R * pose.t};
}

host::VehicleFromTarget ApproachTruth::manoeuvre(double time_s) const {
  const Matrix3 turn = rotation_exp(motion_.turn_deg * kRadPerDeg * sum(turn_, time_s));
  return {turn * kFacing * about_z(spin_phase_rad_),
          Vector3(0.0, 0.0, motion_.start_m) + motion_.sway_m * sum(sway_, time_s)};
}

host::VehicleFromTarget ApproachTruth::at(double time_s) const {
  return motion_.form == ApproachMotion::Form::kApproach ? approach(time_s) : manoeuvre(time_s);
}

ApproachTruth::Rates ApproachTruth::rates(double time_s) const {
  constexpr double kHalf_s = 1e-3;
  const Vector6 moved = pose_difference(at(time_s + kHalf_s), at(time_s - kHalf_s)) / (2.0 * kHalf_s);
  return {moved.tail<3>(), moved.head<3>()};
}

}  // namespace pharos::sim
