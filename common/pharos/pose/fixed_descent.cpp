// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/fixed_descent.hpp"

#include <limits>

#include "pharos/base/hot.hpp"

namespace pharos::pose {
namespace {

using fixed::high;
using fixed::product;
using fixed::Q30;
using fixed::times;

constexpr int kGradientPlaces = 55;
/// Sums of 128 rows stay within 64 bits while no residual exceeds 1/8 rad and no sensor is nearer to the station's
/// plane than 1/8 of the unit of length.
constexpr Q30 kLargestTangent = fixed::kOne / 8;
constexpr Q30 kMinDepth = fixed::kOne / 8;
constexpr Q30 kLongestStep = fixed::kOne / 2;

constexpr Q30 q30(double value) { return static_cast<Q30>(value * fixed::kOne); }

// One axis of one sensor: residual (Q30 rad) and its derivatives by the point's coordinates along and ahead (Q25).
struct AxisTerms {
  Q30 residual;
  std::int32_t by_along, by_ahead;
};

PHAROS_HOT bool axis_terms(Q30 along, Q30 ahead, Q30 cosine, Q30 sine, AxisTerms& terms) {
  const auto opposite = static_cast<Q30>((product(ahead, cosine) - product(along, sine)) >> 30);
  const std::int64_t adjacent = (product(along, cosine) + product(ahead, sine)) >> 30;
  if (adjacent < kMinDepth || !fixed::is_narrow(adjacent)) return false;
  const std::int32_t inverse = fixed::reciprocal(static_cast<Q30>(adjacent));
  const std::int64_t tangent = product(opposite, inverse) >> 27;
  if (tangent > kLargestTangent || tangent < -kLargestTangent) return false;
  const auto u = static_cast<Q30>(tangent);
  const std::int32_t square = high(u * 8, u * 8);  // Q34: below 2^-6
  // u - u^3 (1/3 - u^2 (1/5 - u^2 / 7)), the inner brackets in Q30.
  const Q30 fifth = q30(1.0 / 5.0) - high(square, q30(1.0 / 7.0)) / 4;
  const Q30 third = q30(1.0 / 3.0) - high(square, fifth) / 4;
  terms.residual = u - high(high(u * 8, square * 4), third * 2) / 8;
  // along^2 + ahead^2 = adjacent^2 (1 + u^2).
  const std::int32_t inverse_square = high(inverse, inverse) * 4;  // Q24
  const std::int32_t shrink = square - high(square, square) / 4;   // Q34
  const std::int32_t scale = inverse_square - high(inverse_square, shrink) / 4;
  terms.by_along = high(ahead, scale) * -8;
  terms.by_ahead = high(along, scale) * 8;
  return true;
}

// Adds one row, whose translation part is by_along on unknown `along` and by_ahead on the depth.
template <std::size_t along>
void add(const std::array<std::int32_t, 3>& r, const AxisTerms& t, FixedNormal& n, std::int64_t& square_sum) {
  n.matrix.lower[0] += product(r[0], r[0]);
  n.matrix.lower[1] += product(r[1], r[0]);
  n.matrix.lower[2] += product(r[1], r[1]);
  n.matrix.lower[3] += product(r[2], r[0]);
  n.matrix.lower[4] += product(r[2], r[1]);
  n.matrix.lower[5] += product(r[2], r[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    n.matrix(along, k) += product(r[k], t.by_along);
    n.matrix(5, k) += product(r[k], t.by_ahead);
    n.gradient[k] += product(r[k], t.residual);
  }
  n.matrix(along, along) += product(t.by_along, t.by_along);
  n.matrix(5, along) += product(t.by_along, t.by_ahead);
  n.matrix(5, 5) += product(t.by_ahead, t.by_ahead);
  n.gradient[along] += product(t.by_along, t.residual);
  n.gradient[5] += product(t.by_ahead, t.residual);
  square_sum += product(t.residual, t.residual);
}

bool add_sensor(const FixedObservationTable& s, const FixedObservationTable::Sensor& sensor, const FixedPose& pose,
                FixedNormal& n, std::int64_t& square_sum) {
  const FixedVector q = turned(pose, sensor.body);
  const int places = s.length_exponent - s.body_exponent;
  FixedVector p;
  for (std::size_t k = 0; k < 3; ++k) {
    if (__builtin_add_overflow(pose.centroid[k], q[k] >> places, &p[k])) return false;
  }
  // q in Q30 times a derivative in Q25 that fills what is free above it: Q25.
  const auto part = [&q](std::int32_t derivative, std::size_t k) { return high(derivative * 8, q[k]) / 2; };
  AxisTerms t;
  if (sensor.seen[0]) {
    if (!axis_terms(p[0], p[2], sensor.cosine[0], sensor.sine[0], t)) return false;
    add<3>({part(t.by_ahead, 1), part(t.by_along, 2) - part(t.by_ahead, 0), -part(t.by_along, 1)}, t, n, square_sum);
  }
  if (sensor.seen[1]) {
    if (!axis_terms(p[1], p[2], sensor.cosine[1], sensor.sine[1], t)) return false;
    add<4>({part(t.by_ahead, 1) - part(t.by_along, 2), -part(t.by_ahead, 0), part(t.by_along, 0)}, t, n, square_sum);
  }
  return true;
}

FixedVector cross(const FixedVector& a, const FixedVector& b) {
  const auto element = [&](std::size_t i, std::size_t j) {
    return static_cast<std::int32_t>((product(a[i], b[j]) - product(a[j], b[i])) >> 30);
  };
  return {element(1, 2), element(2, 0), element(0, 1)};
}

// The same damping as DoubleSystem; false where a sum does not fit.
bool damp(FixedMatrix& matrix, double damping) {
  constexpr double kRoom = 1e18;
  const auto fraction = [&](std::int64_t diagonal) { return fixed::to_double(diagonal, 0) * damping; };
  const double turn = fraction(std::max({matrix(0, 0), matrix(1, 1), matrix(2, 2)}));
  for (std::size_t i = 0; i < 6; ++i) {
    const double more = i < 3 ? turn : fraction(matrix(i, i));
    if (!(more < kRoom)) return false;
    matrix(i, i) += fixed::from_double(more, 0);
  }
  return true;
}

}  // namespace

PHAROS_HOT FixedNormal FixedSystem::linearise(const FixedPose& pose) const {
  FixedNormal normal;
  std::int64_t square_sum = 0;
  for (int i = 0; i < table_.count; ++i) {
    if (!add_sensor(table_, table_.sensor[static_cast<std::size_t>(i)], pose, normal, square_sum)) {
      normal.cost = std::numeric_limits<double>::infinity();
      return normal;
    }
  }
  normal.cost = fixed::to_double(square_sum, 60);
  return normal;
}

FixedStep FixedSystem::step(const FixedNormal& normal, double damping) const {
  FixedStep step;
  FixedMatrix matrix = normal.matrix;
  if (damping != 0.0 && !damp(matrix, damping)) return step;
  const FixedCholesky factor(matrix);
  if (!factor.good()) return step;
  const FixedCholesky::Vector half = factor.half_solved(normal.gradient);
  const FixedCholesky::Vector full = factor.solved(half);
  step.solved = true;
  // g^T A^-1 g is the square of the half-solved vector.
  const int largest = fixed::max_bits_of(half.element);
  std::int64_t square = 0;
  for (const std::int64_t y : half.element) {
    const std::int64_t cut = fixed::shifted(y, 30 - largest);
    square += cut * cut;
  }
  step.decrease = fixed::to_double(square, 2 * (30 - largest - half.places + kGradientPlaces));
  for (std::size_t i = 0; i < 6; ++i) {
    const int unit = i < 3 ? table_.length_exponent - table_.body_exponent : 0;
    const int places = full.places + factor.exponent_of_unknown(i) + unit - kGradientPlaces + 30;
    const bool too_long = fixed::bits_of(full.element[i]) + places > 30;
    const std::int64_t delta =
        too_long ? (full.element[i] < 0 ? -fixed::kOne : fixed::kOne) : fixed::shifted(full.element[i], places);
    step.delta[i] = -fixed::clamped(delta, kLongestStep);
  }
  return step;
}

FixedPose FixedSystem::moved(const FixedPose& pose, const std::array<Q30, 6>& delta) const {
  const FixedVector half{delta[0] / 2, delta[1] / 2, delta[2] / 2};
  const Q30 square = times(half[0], half[0]) + times(half[1], half[1]) + times(half[2], half[2]);
  const std::int32_t scale = fixed::reciprocal(fixed::kOne + square);  // Q27
  FixedPose to;
  for (std::size_t c = 0; c < 3; ++c) {
    const FixedVector once = cross(half, pose.column[c]);
    const FixedVector twice = cross(half, once);
    for (std::size_t i = 0; i < 3; ++i) {
      to.column[c][i] = pose.column[c][i] + static_cast<Q30>(product(once[i] + twice[i], scale) >> 26);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t sum = std::int64_t{pose.centroid[i]} + delta[i + 3];
    to.centroid[i] = fixed::clamped(sum, std::numeric_limits<std::int32_t>::max());
  }
  return to;
}

double FixedSystem::square_between(const FixedPose& a, const FixedNormal& normal, const FixedPose& b) const {
  // Half the sum of the columns' cross products is the rotation axis times the sine of its angle.
  std::array<std::int64_t, 6> d{};
  std::int64_t cosine = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const FixedVector part = cross(a.column[c], b.column[c]);
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] += part[i];
      cosine += product(a.column[c][i], b.column[c][i]) >> 30;
    }
  }
  // 1 + 2 cos: beyond half a radian the two are never the same.
  if (cosine < q30(0.87) + std::int64_t{fixed::kOne} + q30(0.87)) return 1e300;
  // All in units of 2^-31, the rotation in those of the normal equations too.
  const int unit = table_.length_exponent - table_.body_exponent;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = fixed::shifted(d[i], -std::min(unit, 30));
    d[i + 3] = (std::int64_t{b.centroid[i]} - a.centroid[i]) * 2;
  }
  // Vector and matrix scaled to 30 bits each; so the sum of 36 products of three stays within 64 bits.
  const int vector_cut = 30 - fixed::max_bits_of(d);
  const int matrix_cut = 30 - fixed::max_bits_of(normal.matrix.lower);
  std::array<std::int32_t, 6> v{};
  for (std::size_t i = 0; i < 6; ++i) v[i] = static_cast<std::int32_t>(fixed::shifted(d[i], vector_cut));
  std::int64_t square = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    std::int64_t row = 0;
    for (std::size_t j = 0; j <= i; ++j) {
      const auto element = static_cast<std::int32_t>(fixed::shifted(normal.matrix(i, j), matrix_cut));
      row += i == j ? product(element, v[j]) / 2 : product(element, v[j]);
    }
    square += fixed::times_wide(row, v[i]);
  }
  return fixed::to_double(square, 50 + matrix_cut + 2 * (31 + vector_cut) - 30 - 1);
}

}  // namespace pharos::pose
