// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/fixed_cholesky.hpp"

namespace pharos::pose {
namespace {

constexpr int kMatrixPlaces = 50;
constexpr std::int64_t kMinPivot = std::int64_t{1} << 40;  // Q60
constexpr int kVectorPlaces = 36;  // bits of a right side's largest element: it may grow by 2^10 twice, and six times

}  // namespace

FixedCholesky::FixedCholesky(const FixedMatrix& matrix) {
  for (std::size_t i = 0; i < 6; ++i) {
    const int diagonal = fixed::bits_of(matrix(i, i)) - kMatrixPlaces;
    places_[i] = (diagonal >= 0 ? diagonal + 1 : diagonal) / 2;
    good_ = good_ && matrix(i, i) > 0;
  }
  for (std::size_t j = 0; j < 6 && good_; ++j) {
    for (std::size_t i = j; i < 6; ++i) {
      std::int64_t sum = fixed::shifted(matrix(i, j), 60 - kMatrixPlaces - places_[i] - places_[j]);
      for (std::size_t k = 0; k < j; ++k) sum -= fixed::product(l(i, k), l(j, k));
      if (i > j) {
        // No element exceeds the root of the pivot, so the doubled sum stays below one.
        const auto cut = static_cast<std::int32_t>(fixed::shifted(sum, exponents_[j] - 30));
        l(i, j) = static_cast<fixed::Q30>((std::int64_t{cut} * inverse_[j]) >> 30);
        continue;
      }
      if (sum < kMinPivot) {
        good_ = false;
        break;
      }
      const fixed::Root root = fixed::root_of(std::min(sum, (std::int64_t{1} << 60) - 1));
      inverse_[j] = root.inverse;
      exponents_[j] = root.binary_exponent;
    }
  }
}

FixedCholesky::Vector FixedCholesky::half_solved(const std::array<std::int64_t, 6>& right) const {
  Vector y;
  int largest = -200;
  for (std::size_t i = 0; i < 6; ++i) {
    if (right[i] != 0) largest = std::max(largest, fixed::bits_of(right[i]) - places_[i]);
  }
  if (largest == -200) return y;
  y.places = largest - kVectorPlaces;
  for (std::size_t i = 0; i < 6; ++i) {
    std::int64_t sum = fixed::shifted(right[i], -places_[i] - y.places);
    for (std::size_t k = 0; k < i; ++k) sum -= fixed::times_wide(y.element[k], l(i, k));
    y.element[i] = fixed::shifted(fixed::times_wide(sum, static_cast<fixed::Q30>(inverse_[i] / 2)), exponents_[i] + 1);
  }
  return y;
}

FixedCholesky::Vector FixedCholesky::solved(const Vector& half) const {
  Vector x = half;
  for (std::size_t i = 6; i-- > 0;) {
    std::int64_t sum = half.element[i];
    for (std::size_t k = i + 1; k < 6; ++k) sum -= fixed::times_wide(x.element[k], l(k, i));
    x.element[i] = fixed::shifted(fixed::times_wide(sum, static_cast<fixed::Q30>(inverse_[i] / 2)), exponents_[i] + 1);
  }
  return x;
}

bool FixedCholesky::inverse_columns(std::array<std::array<std::int32_t, 6>, 6>& columns) const {
  constexpr int kSpare = 20;  // bits of a sum beyond the required ones
  for (std::size_t j = 0; j < 6; ++j) {
    columns[j].fill(0);
    for (std::size_t i = j; i < 6; ++i) {
      std::int64_t sum = i == j ? std::int64_t{1} << (30 + kInverseExponent) : 0;
      for (std::size_t k = j; k < i; ++k) sum -= fixed::product(columns[j][k], l(i, k));
      const std::int64_t half = fixed::times_wide(sum >> kSpare, static_cast<fixed::Q30>(inverse_[i] / 2));
      const std::int64_t element = fixed::shifted(half, exponents_[i] + 1 - (30 - kSpare));
      if (!fixed::is_narrow(element)) return false;
      columns[j][i] = static_cast<std::int32_t>(element);
    }
  }
  return true;
}

}  // namespace pharos::pose
