// SPDX-License-Identifier: Apache-2.0
#include "pharos/tracking/unknown_station.hpp"

#include "pharos/motion/cycle_information.hpp"

namespace pharos::tracking {
namespace {

motion::HitFit hit_at(const LighthouseFromBody& T_lighthouse_body, const Vector3& body_m, Axis axis) {
  const Vector3 q = T_lighthouse_body.R * body_m;
  motion::HitFit hit;
  hit.point_m = q + T_lighthouse_body.t;
  const double along = hit.point_m[index_of(axis)], ahead = hit.point_m.z();
  const double inverse_square = 1.0 / (along * along + ahead * ahead);
  Vector3 gradient = Vector3::Zero();
  gradient[index_of(axis)] = -ahead * inverse_square;
  gradient.z() = along * inverse_square;
  hit.jacobian << q.cross(gradient), gradient;
  hit.residual_rad = hit.ideal_rad = 0.0;
  hit.variance = 1.0;
  hit.bearing = 0;
  return hit;
}

}  // namespace

std::optional<Matrix6> rotor_covariance(const LighthouseFromBody& T_lighthouse_body, const track::EpochTracker& cycle,
                                        const Target& target, const motion::RotorSpread& spread) {
  motion::CycleInformation both;
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    motion::HitFits hits;
    for (std::size_t i = 0; i < cycle.bearing_count(); ++i) {
      const track::TrackedBearing bearing = cycle.bearing(i);
      const SensorPlacement* sensor = find_sensor(target, bearing.raw.sensor);
      if (!bearing.used || bearing.axis != axis || sensor == nullptr) continue;
      hits.push_back(hit_at(T_lighthouse_body, sensor->position_m, axis));
    }
    if (hits.empty()) return std::nullopt;
    constexpr double kUnitVariance = 1.0;
    constexpr std::int64_t kSameInstant = 0;
    both.set(axis, hits, kUnitVariance, kSameInstant, true);
  }
  return both.covariance_of(spread);
}

}  // namespace pharos::tracking
