// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/fixed_observation_table.hpp"

#include <limits>

#include "pharos/base/units.hpp"

namespace pharos::pose {
namespace {

using fixed::Q30;
using WideVector = std::array<std::int64_t, 3>;

constexpr int kMetrePlaces = 40;  // lengths of the input: 2^-40 m
constexpr Q30 kQuarterTurn = static_cast<Q30>(kPi / 2 * fixed::kOne);
// Farther than 2^18 m, nearer or smaller than 2^-10 m there is no valid target.
constexpr int kFarthestPlaces = 18, kNearestPlaces = -10;

WideVector wide(const Vector3& v) {
  return {fixed::from_double(v[0], kMetrePlaces), fixed::from_double(v[1], kMetrePlaces),
          fixed::from_double(v[2], kMetrePlaces)};
}

// The smallest n for which the vector is shorter than 2^n m.
int length_places_of(const WideVector& v) {
  const int largest = fixed::max_bits_of(v);
  std::int64_t square = 0;
  for (const std::int64_t x : v) {
    const std::int64_t scaled = fixed::shifted(x, 30 - largest);
    square += scaled * scaled;
  }
  return (fixed::bits_of(square) + 1) / 2 - 30 + largest - kMetrePlaces;
}

// Position of the centroid in the lighthouse frame, 2^-40 m.
WideVector centroid_of(const WideVector& centre, const LighthouseFromBody& pose) {
  WideVector sum = wide(pose.t);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto k = static_cast<std::size_t>(i);
      sum[k] += fixed::times_wide(centre[static_cast<std::size_t>(j)],
                                  static_cast<Q30>(fixed::from_double(pose.R(i, j), 30)));
    }
  }
  return sum;
}

bool see(FixedObservationTable& s, std::size_t entry, const Observation& o) {
  FixedObservationTable::Sensor& sensor = s.sensor[entry];
  const auto a = static_cast<std::size_t>(index_of(o.axis));
  if (sensor.seen[a]) return false;
  const auto off = static_cast<Q30>(fixed::from_double(o.theta_rad, 30) - kQuarterTurn);
  const fixed::SineCosine sc = fixed::sine_cosine(off);
  sensor.seen[a] = true;
  sensor.cosine[a] = -sc.sine;
  sensor.sine[a] = sc.cosine;
  ++s.rows;
  return true;
}

// The sensors seen, from their centroid, scaled to the largest.
bool place_sensors(const std::array<WideVector, kMaxSensors>& body, FixedObservationTable& s) {
  const auto count = static_cast<std::size_t>(s.count);
  for (std::size_t i = 0; i < 3; ++i) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += body[k][i];
    s.centre[i] = sum / s.count;
  }
  const auto from_centre = [&](std::size_t k) {
    return WideVector{body[k][0] - s.centre[0], body[k][1] - s.centre[1], body[k][2] - s.centre[2]};
  };
  s.body_exponent = kNearestPlaces;
  for (std::size_t k = 0; k < count; ++k) s.body_exponent = std::max(s.body_exponent, length_places_of(from_centre(k)));
  if (s.body_exponent > kFarthestPlaces) return false;
  for (std::size_t k = 0; k < count; ++k) {
    const WideVector v = from_centre(k);
    for (std::size_t i = 0; i < 3; ++i) {
      s.sensor[k].body[i] = static_cast<std::int32_t>(fixed::shifted(v[i], 30 - kMetrePlaces - s.body_exponent));
    }
  }
  return true;
}

}  // namespace

bool collect_fixed(const Target& target, const Observations& observations, const LighthouseFromBody& prior,
                   FixedObservationTable& table) {
  constexpr std::uint8_t kNone = 0xFF;
  std::array<std::uint8_t, kMaxSensors> placement_of, entry_of;
  placement_of.fill(kNone);
  entry_of.fill(kNone);
  for (std::size_t k = 0; k < target.size(); ++k) {
    if (target[k].sensor < kMaxSensors) placement_of[target[k].sensor] = static_cast<std::uint8_t>(k);
  }
  std::array<WideVector, kMaxSensors> body;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Observation& o = observations[k];
    if (!(o.theta_rad > 0.0 && o.theta_rad < kPi)) return false;
    if (o.sensor >= kMaxSensors || placement_of[o.sensor] == kNone) continue;
    std::uint8_t& entry = entry_of[o.sensor];
    if (entry == kNone) {
      entry = static_cast<std::uint8_t>(table.count++);
      table.sensor[entry].seen = {};
      body[entry] = wide(target[placement_of[o.sensor]].position_m);
    }
    if (!see(table, entry, o)) return false;
    table.used[k] = true;
  }
  if (table.count == 0 || !place_sensors(body, table)) return false;
  table.length_exponent = length_places_of(centroid_of(table.centre, prior));
  return table.length_exponent >= std::max(kNearestPlaces, table.body_exponent) &&
         table.length_exponent <= kFarthestPlaces;
}

FixedPose fixed_pose(const FixedObservationTable& table, const LighthouseFromBody& pose) {
  FixedPose out;
  const WideVector centroid = centroid_of(table.centre, pose);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out.column[j][i] = static_cast<Q30>(fixed::from_double(pose.R(static_cast<int>(i), static_cast<int>(j)), 30));
    }
    out.centroid[i] = static_cast<std::int32_t>(fixed::shifted(centroid[i], 30 - kMetrePlaces - table.length_exponent));
  }
  return out;
}

LighthouseFromBody double_pose(const FixedObservationTable& table, const FixedPose& pose) {
  // One step of the polar decomposition's iteration, R (3 - R^T R) / 2, on a matrix that is a rotation to 2^-28: the
  // difference of R^T R from the unit matrix is exact in integers, and small.
  LighthouseFromBody out;
  std::array<std::array<std::int32_t, 3>, 3> excess{};  // 2^-57, half of the excess
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      std::int64_t sum = i == j ? -(std::int64_t{1} << 60) : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += fixed::product(pose.column[i][k], pose.column[j][k]);
      excess[i][j] = excess[j][i] = fixed::clamped(sum >> 4, std::numeric_limits<std::int32_t>::max());
    }
  }
  for (int i = 0; i < 3; ++i) {
    const auto r = static_cast<std::size_t>(i);
    std::int64_t origin = fixed::shifted(pose.centroid[r], table.length_exponent + kMetrePlaces - 30);
    for (std::size_t j = 0; j < 3; ++j) {
      std::int64_t too_much = 0;  // 2^-87
      for (std::size_t k = 0; k < 3; ++k) too_much += fixed::product(pose.column[k][r], excess[k][j]);
      const std::int64_t element = (std::int64_t{pose.column[j][r]} << 30) - (too_much >> 27);
      out.R(i, static_cast<int>(j)) = fixed::to_double(element, 60);
      origin -= fixed::times_wide(table.centre[j], pose.column[j][r]);
    }
    out.t[i] = fixed::to_double(origin, kMetrePlaces);
  }
  return out;
}

FixedVector turned(const FixedPose& pose, const FixedVector& body) {
  FixedVector out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = (fixed::high(pose.column[0][i], body[0]) + fixed::high(pose.column[1][i], body[1]) +
              fixed::high(pose.column[2][i], body[2])) *
             4;
  }
  return out;
}

}  // namespace pharos::pose
