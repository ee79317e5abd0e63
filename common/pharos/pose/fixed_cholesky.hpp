// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "pharos/base/fixed_point.hpp"
#include "pharos/geometry/packed_symmetric.hpp"

namespace pharos::pose {

using FixedMatrix = PackedSymmetric<6, std::int64_t>;

/// L L^T = S A S of a positive definite matrix A (Q50) in integers, S the powers of two that put its diagonal into
/// [1/4, 1): so no element of L exceeds one, whatever the condition. Cost: some 1500 instructions on RV32IM.
class FixedCholesky {
 public:
  explicit FixedCholesky(const FixedMatrix& matrix);
  /// False where a pivot is below 2^-20 of a diagonal: too near to singular for 30 bits.
  bool good() const { return good_; }

  /// A vector times 2^places.
  struct Vector {
    std::array<std::int64_t, 6> element{};
    int places = 0;
  };
  /// L^-1 times `right`, below 2^50.
  Vector half_solved(const std::array<std::int64_t, 6>& right) const;
  /// Back substitution: S L^-T of it, by elements in their own units: element i times 2^(places +
  /// exponent_of_unknown(i)).
  Vector solved(const Vector& half) const;
  int exponent_of_unknown(std::size_t i) const { return -places_[i]; }
  /// Columns of L^-1 in units of 2^-kInverseExponent: column a times column b, scaled by S, is the inverse matrix' (a,
  /// b). False where one does not fit.
  bool inverse_columns(std::array<std::array<std::int32_t, 6>, 6>& columns) const;
  static constexpr int kInverseExponent = 18;

 private:
  fixed::Q30& l(std::size_t row, std::size_t column) { return below_[row * (row - 1) / 2 + column]; }
  fixed::Q30 l(std::size_t row, std::size_t column) const { return below_[row * (row - 1) / 2 + column]; }

  std::array<fixed::Q30, 15> below_;      // the diagonal
  std::array<std::uint32_t, 6> inverse_;  // of the diagonal's mantissa, Q30
  std::array<int, 6> exponents_;          // and its exponent
  std::array<int, 6> places_;             // of 1/S
  bool good_ = true;
};

}  // namespace pharos::pose
