// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/measurements/measured_world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/sim/measurements/source_faults.hpp"

namespace pharos::sim {
namespace {

Vector3 normal3(RandomStream& random) { return {random.normal(), random.normal(), random.normal()}; }

std::vector<TruthState> simulate_truth(const WorldSettings& settings) {
  RandomStream random(settings.seed, "world truth");
  constexpr double dt = 1.0 / kWorldRate_hz;
  const double velocity_step = std::sqrt(settings.acceleration_density * dt);
  const double rate_step = std::sqrt(settings.angular_acceleration_density * dt);
  TruthState now;
  now.pose.t = settings.position_m;
  // Facing the vehicle (z towards it), turned by a little.
  now.pose.R = rotation_exp(Vector3(std::numbers::pi, 0, 0)) * rotation_exp(0.2 * normal3(random));
  now.velocity_m_s = settings.velocity_m_s;
  now.rate_rad_s = settings.rate_rad_s;
  std::vector<TruthState> truth;
  const auto steps = static_cast<std::size_t>(settings.duration_s * kWorldRate_hz);
  for (std::size_t k = 0; k <= steps; ++k) {
    now.time_s = static_cast<double>(k) * dt;
    truth.push_back(now);
    const Vector3 velocity = now.velocity_m_s + velocity_step * normal3(random);
    const Vector3 rate = now.rate_rad_s + rate_step * normal3(random);
    now.pose.t += 0.5 * dt * (now.velocity_m_s + velocity);
    now.pose.R = orthonormalised(rotation_exp(0.5 * dt * (now.rate_rad_s + rate)) * now.pose.R);
    now.velocity_m_s = velocity;
    now.rate_rad_s = rate;
  }
  return truth;
}

// One source's measuring chain: mounting, slow error, noise.
class Chain {
 public:
  Chain(const MeasuredSource& source, std::uint64_t seed)
      : source_(source), random_(seed, "world source " + source.name) {
    if (!source.relative) bias_ = draw();
  }

  WorldSensorPose measure(const TruthState& truth) {
    const double step_s = truth.time_s - time_s_;
    move_bias(truth.time_s);
    WorldSensorPose pose;
    if (source_.relative) {
      // The slow error turns with the target.
      const Pose<frame::Target, frame::Target> error{rotation_exp(bias_.head<3>()), bias_.tail<3>()};
      const auto seen = source_.T_vehicle_sensor.inverse() * (truth.pose * error);
      if (!first_) first_ = seen.inverse();
      pose = {seen.R * first_->R, seen.R * first_->t + seen.t};
    } else {
      // The slow error is one of the mounting: its rotation acts about the sensor.
      Pose<frame::Vehicle, frame::Camera> mounting = source_.T_vehicle_sensor;
      mounting.R = rotation_exp(-bias_.head<3>()) * mounting.R;
      const auto seen = mounting.inverse() * (truth.pose * source_.T_target_feature);
      pose = seen;
      pose.t += source_.T_vehicle_sensor.R.transpose() * bias_.tail<3>();
    }
    move_noise(step_s);
    pose = pose.moved_by(noise_);
    if (source_.no_roll) {
      pose.R = rotation_exp(pose.R.col(2) * random_.uniform(-std::numbers::pi, std::numbers::pi)) * pose.R;
    }
    return pose;
  }

 private:
  Vector6 draw() {
    Vector6 v;
    v << source_.bias_rad * normal3(random_), source_.bias_m * normal3(random_);
    return v;
  }

  void move_noise(double step_s) {
    const bool alike = source_.noise_time_s > 0.0 && !noise_.isZero(0.0);  // the first one is independent
    const double kept = alike ? std::exp(-step_s / source_.noise_time_s) : 0.0;
    Vector6 fresh;
    fresh << source_.noise_rad * normal3(random_), source_.noise_m * normal3(random_);
    noise_ = kept * noise_ + std::sqrt(1.0 - kept * kept) * fresh;
  }

  void move_bias(double time_s) {
    const double dt = time_s - time_s_;
    time_s_ = time_s;
    if (source_.relative) {
      bias_ += std::sqrt(2.0 * std::max(0.0, first_ ? dt : 0.0) / source_.bias_time_constant_s) * draw();
    } else {
      const double kept = std::exp(-dt / source_.bias_time_constant_s);
      bias_ = kept * bias_ + std::sqrt(1.0 - kept * kept) * draw();
    }
  }

  const MeasuredSource& source_;
  RandomStream random_;
  Vector6 bias_ = Vector6::Zero();
  Vector6 noise_ = Vector6::Zero();
  double time_s_ = 0.0;
  std::optional<Pose<frame::Target, frame::Camera>> first_;
};

void measure_source(const WorldSettings& settings, std::size_t index, const std::vector<TruthState>& truth,
                    std::vector<SimulatedPose>& out) {
  const MeasuredSource& source = settings.sources[index];
  Chain chain(source, settings.seed);
  SourceFault fault = settings.fault;
  if (fault.source != index) fault.kind = SourceFaultKind::kNone;
  SourceFaultMaker maker(fault, source, settings.seed);
  const auto step = static_cast<std::size_t>(kWorldRate_hz / source.rate_hz);
  // Sources do not measure at the same instants.
  for (std::size_t k = 1 + 7 * index; k < truth.size(); k += step) {
    if (truth[k].time_s < source.from_s || truth[k].time_s > source.until_s) continue;
    SimulatedPose pose;
    pose.source = index;
    pose.time_s = truth[k].time_s;
    pose.arrival_s = truth[k].time_s + source.delay_s;
    pose.pose = chain.measure(truth[k]);
    pose.noise_rad = source.noise_rad;
    pose.noise_m = source.noise_m;
    maker.apply(pose);
    if (source.no_roll) pose.unmeasured_axis = pose.pose.R.col(2);
    out.push_back(pose);
  }
}

}  // namespace

MeasuredWorld simulate_world(const WorldSettings& settings) {
  MeasuredWorld world;
  world.truth = simulate_truth(settings);
  for (std::size_t s = 0; s < settings.sources.size(); ++s) measure_source(settings, s, world.truth, world.poses);
  std::stable_sort(world.poses.begin(), world.poses.end(),
                   [](const SimulatedPose& a, const SimulatedPose& b) { return a.arrival_s < b.arrival_s; });
  return world;
}

}  // namespace pharos::sim
