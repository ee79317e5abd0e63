// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/fixed_covariance.hpp"

namespace pharos::pose {
namespace {

// Rows of S L^-T, one an unknown: the inverse matrix' (a, b) is row a times row b.
using WideRow = std::array<std::int64_t, 6>;

// The centroid in the body, rotated into the lighthouse frame, in units of the target's size, 2^-20.
bool lever(const FixedObservationTable& s, const FixedPose& pose, FixedVector& v) {
  constexpr int kPlaces = 20;
  for (std::size_t i = 0; i < 3; ++i) {
    std::int64_t sum = 0;
    for (std::size_t j = 0; j < 3; ++j) sum += fixed::times_wide(s.centre[j], pose.column[j][i]);
    const std::int64_t scaled = fixed::shifted(sum, kPlaces - 40 - s.body_exponent);
    if (fixed::bits_of(scaled) > 28) return false;
    v[i] = static_cast<std::int32_t>(scaled);
  }
  return true;
}

// The translation of the body's origin is that of the centroid plus lever x rotation.
void to_origin(const FixedVector& v, std::array<WideRow, 6>& rows) {
  for (std::size_t m = 0; m < 6; ++m) {
    const std::array<std::int64_t, 3> turn{rows[0][m], rows[1][m], rows[2][m]};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      rows[i + 3][m] += (v[j] * turn[k] - v[k] * turn[j]) >> 20;
    }
  }
}

int largest_places(const std::array<WideRow, 6>& rows) {
  int largest = 0;
  for (const WideRow& row : rows) {
    for (const std::int64_t x : row) largest = std::max(largest, fixed::bits_of(x));
  }
  return largest;
}

}  // namespace

bool fixed_unit_covariance(const FixedObservationTable& table, const FixedPose& pose, const FixedNormal& normal,
                           Matrix6& covariance) {
  const FixedCholesky factor(normal.matrix);
  std::array<std::array<std::int32_t, 6>, 6> columns;
  FixedVector v;
  if (!factor.good() || !factor.inverse_columns(columns) || !lever(table, pose, v)) return false;
  // One unit for all rows: the largest unknown's.
  int common = factor.exponent_of_unknown(0);
  for (std::size_t a = 1; a < 6; ++a) common = std::max(common, factor.exponent_of_unknown(a));
  std::array<WideRow, 6> rows;
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t m = 0; m < 6; ++m)
      rows[a][m] = fixed::shifted(columns[a][m], factor.exponent_of_unknown(a) - common);
  }
  to_origin(v, rows);
  const int cut = 30 - largest_places(rows);
  for (WideRow& row : rows) {
    for (std::int64_t& x : row) x = fixed::shifted(x, cut);
  }
  const auto unit_of = [&](std::size_t a) {
    return a < 3 ? table.length_exponent - table.body_exponent : table.length_exponent;
  };
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      std::int64_t sum = 0;
      for (std::size_t m = 0; m < 6; ++m) {
        sum += fixed::product(static_cast<std::int32_t>(rows[a][m]), static_cast<std::int32_t>(rows[b][m]));
      }
      const int fraction = 2 * (FixedCholesky::kInverseExponent + cut - common) - unit_of(a) - unit_of(b);
      const double element = fixed::to_double(sum, fraction);
      covariance(static_cast<int>(a), static_cast<int>(b)) = element;
      covariance(static_cast<int>(b), static_cast<int>(a)) = element;
    }
  }
  return true;
}

}  // namespace pharos::pose
