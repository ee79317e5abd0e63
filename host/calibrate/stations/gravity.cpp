// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/gravity.hpp"

#include <cmath>

namespace pharos::calibrate {
namespace {

constexpr std::size_t kMinSamples = 20;
constexpr double kEnd_s = 0.08;  // at a piece's ends accelerations are not known well

}  // namespace

Up up_of(const std::vector<BodySpline>& motion, const std::vector<Acceleration>& samples) {
  std::vector<Vector3> sums;
  Vector3 total = Vector3::Zero();
  std::size_t count = 0, i = 0;
  for (const BodySpline& piece : motion) {
    Vector3 sum = Vector3::Zero();
    const double begin_s = piece.begin_s() + kEnd_s, end_s = piece.end_s() - kEnd_s;
    while (i < samples.size() && samples[i].time_s < begin_s) ++i;
    for (; i < samples.size() && samples[i].time_s <= end_s; ++i, ++count) {
      const double at_s = samples[i].time_s;
      sum += piece.pose(at_s).R * samples[i].f_m_s2 - piece.acceleration_m_s2(at_s);
    }
    total += sum;
    sums.push_back(sum);
  }
  Up up;
  if (count < kMinSamples || !(total.norm() > 0.0)) return up;
  up.direction = total.normalized();
  double square = 0.0;
  for (const Vector3& sum : sums) square += (sum - up.direction * up.direction.dot(sum)).squaredNorm();
  up.sigma_rad = std::sqrt(0.5 * square) / total.norm();
  return up;
}

}  // namespace pharos::calibrate
