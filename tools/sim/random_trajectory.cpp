// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "host/support/input_error.hpp"
#include "pharos/base/units.hpp"
#include "tools/sim/trajectory.hpp"

namespace pharos::sim {
namespace {

constexpr int kSines = 3;
constexpr double kSampleStep_s = 0.01;
constexpr int kRounds = 20;  // of a limit's search

// A wandering coordinate within [-1, 1].
struct Wander {
  std::array<Sine, kSines> sines;

  explicit Wander(RandomStream& random) {
    double sum = 0.0;
    for (Sine& sine : sines) {
      sine = {random.uniform(0.4, 1.0), random.uniform(0.05, 0.25), random.uniform(0.0, kTwoPi)};
      sum += sine.amplitude;
    }
    for (Sine& sine : sines) sine.amplitude /= sum;
  }
  double at(double time_s) const {
    double value = 0.0;
    for (const Sine& sine : sines) value += sine.at(time_s);
    return value;
  }
};

// Body z towards the room's origin, body x as level as possible.
Matrix3 facing_origin(const Vector3& position) {
  const Vector3 z = -position.normalized();
  const Vector3 x = z.cross(Vector3::UnitY()).normalized();
  Matrix3 R;
  R << x, z.cross(x), z;
  return R;
}

class ManoeuvreTrajectory final : public Trajectory {
 public:
  ManoeuvreTrajectory(const ManoeuvreLimits& limits, RandomStream& random)
      : limits_(limits),
        position_{Wander(random), Wander(random), Wander(random)},
        tilt_{Wander(random), Wander(random)},
        roll_(random) {}

  RoomFromBody at(double time_s) const override {
    const Vector3 position = position_at(time_s * position_pace_);
    return {facing_origin(position) * turn_at(time_s * turning_pace_), position};
  }

  void scale_to_limits(double duration_s) {
    // The maximum speed grows with the scale of time, but a faster flight also covers more of its path: a few
    // iterations converge.
    const auto samples = static_cast<int>(duration_s / kSampleStep_s);
    std::vector<Vector3> positions(static_cast<std::size_t>(samples) + 1);
    for (int round = 0; round <= kRounds; ++round) {
      for (int k = 0; k <= samples; ++k) {
        positions[static_cast<std::size_t>(k)] = position_at(k * kSampleStep_s * position_pace_);
      }
      if (round < kRounds) position_pace_ *= limits_.speed_m_s / std::max(top_speed(positions), 1e-9);
    }
    double low = 0.0;
    double high = 100.0;
    for (int halving = 0; halving < kRounds; ++halving) {
      turning_pace_ = 0.5 * (low + high);
      (turns_faster(positions, limits_.rate_deg_s * kRadPerDeg) ? high : low) = turning_pace_;
    }
    turning_pace_ = low;
  }

 private:
  static double top_speed(const std::vector<Vector3>& positions) {
    double top = 0.0;
    for (std::size_t k = 1; k < positions.size(); ++k) {
      top = std::max(top, (positions[k] - positions[k - 1]).norm() / kSampleStep_s);
    }
    return top;
  }

  bool turns_faster(const std::vector<Vector3>& positions, double rate_rad_s) const {
    Matrix3 before;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const Matrix3 R = facing_origin(positions[k]) * turn_at(static_cast<double>(k) * kSampleStep_s * turning_pace_);
      if (k > 0 && rotation_angle_between(before, R) / kSampleStep_s > rate_rad_s) return true;
      before = R;
    }
    return false;
  }

  Matrix3 turn_at(double time) const {
    const double tilt = limits_.tilt_deg * kRadPerDeg;
    return rotation_exp(Vector3(tilt * tilt_[0].at(time), tilt * tilt_[1].at(time), 0.0)) *
           rotation_exp(Vector3(0.0, 0.0, kTwoPi * roll_.at(time)));
  }

  // The field of view limits the volume laterally, by a smooth function so that the acceleration is continuous.
  Vector3 position_at(double time) const {
    Vector3 p;
    p.z() = coordinate(2, position_[2].at(time), 1e9);
    const double reach = std::tan(limits_.half_field_deg * kRadPerDeg) * p.z();
    p.x() = coordinate(0, position_[0].at(time), reach);
    p.y() = coordinate(1, position_[1].at(time), reach);
    return p;
  }
  double coordinate(Eigen::Index axis, double wander, double reach) const {
    const double middle = 0.5 * (limits_.low_m[axis] + limits_.high_m[axis]);
    const double half = 0.5 * (limits_.high_m[axis] - limits_.low_m[axis]);
    const double room = std::max(reach - std::abs(middle), 1e-3);
    const double softened = std::pow(std::pow(std::max(half, 1e-6), -4.0) + std::pow(room, -4.0), -0.25);
    return middle + (reach > 1e8 ? half : softened) * wander;
  }

  ManoeuvreLimits limits_;
  std::array<Wander, 3> position_;
  std::array<Wander, 2> tilt_;
  Wander roll_;
  double position_pace_ = 1.0;
  double turning_pace_ = 1.0;
};

bool shows_enough(const RoomFromBody& pose, const Target& target, double min_cosine, int wanted) {
  int lit = 0;
  for (const SensorPlacement& sensor : target) {
    const Vector3 to_origin = -(pose * sensor.position_m).normalized();
    if (!sensor.has_normal() || (pose.R * sensor.normal).dot(to_origin) > min_cosine) ++lit;
  }
  return lit >= wanted;
}

}  // namespace

Matrix3 random_rotation(RandomStream& random) {
  Eigen::Vector4d v;
  for (int i = 0; i < 4; ++i) v[i] = random.normal();
  return Quaternion(v).normalized().toRotationMatrix();
}

std::unique_ptr<Trajectory> make_random_manoeuvre(const ManoeuvreLimits& limits, double duration_s,
                                                  RandomStream random) {
  auto trajectory = std::make_unique<ManoeuvreTrajectory>(limits, random);
  trajectory->scale_to_limits(duration_s);
  return trajectory;
}

std::vector<RoomFromBody> random_stationary_poses(const RandomStationaryPoses& limits, const Target& target,
                                                  double max_incidence_deg, RandomStream random) {
  const double min_cosine = std::cos(max_incidence_deg * kRadPerDeg);
  std::vector<RoomFromBody> poses;
  for (int i = 0; i < limits.count; ++i) {
    const double angle = limits.max_angle_deg * kRadPerDeg;
    // One draw a statement: compilers differ in the order of arguments.
    const double y = std::tan(random.uniform(-angle, angle));
    const double x = std::tan(random.uniform(-angle, angle));
    const Vector3 direction = Vector3(x, y, 1.0).normalized();
    const Vector3 position = direction * random.uniform(limits.min_range_m, limits.max_range_m);
    RoomFromBody pose{random_rotation(random), position};
    int tries = 0;
    while (!shows_enough(pose, target, min_cosine, limits.min_lit)) {
      if (++tries == 10'000) {
        throw host::InputError("no attitude of the target shows " + std::to_string(limits.min_lit) +
                               " sensors; lower trajectory.min_lit or raise light.max_incidence_deg");
      }
      pose.R = random_rotation(random);
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace pharos::sim
