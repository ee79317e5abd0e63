// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/motion/kinematic_state.hpp"
#include "pharos/motion/unrolled.hpp"

namespace pharos::motion {

// Products with a sweep's factor. One column of it is zero, as one rotor never observes all six directions: it is left
// out, and so is one half of what is symmetric. All sizes are constants, so that a column stays in registers, and
// Eigen's loops over columns are compiled into their caller (flatten): called one by one they cost half as much again.

/// No column is zero.
inline constexpr int kNone = 6;
/// How many are not, if `blind` is.
template <int blind>
inline constexpr int kColumns = blind < kNone ? 5 : 6;

/// A side P L, or a gain P L C^-T, without the column that is zero.
template <int blind>
using Gain = Eigen::Matrix<double, 6, kColumns<blind>>;

/// f(k, j): a gain's column k is of the factor's column j.
template <int blind, class Function>
inline void for_each_column(const Function& f) {
  for_each_number<kColumns<blind>>([&f](auto column) {
    constexpr int k = column, j = k + (k < blind ? 0 : 1);
    f(std::integral_constant<int, k>{}, std::integral_constant<int, j>{});
  });
}

/// f(column of the factor): of each one before column j.
template <int blind, int j, class Function>
inline void for_each_before(const Function& f) {
  for_each_number<j>([&f](auto column) {
    if constexpr (constexpr int before = column; before != blind) f(before);
  });
}

/// f(column that is zero, as a constant).
template <class Function>
auto without_blind_column(const SweepInformation& sweep, const Function& f) {
  if (sweep.factor(4, 4) == 0.0) return f(std::integral_constant<int, 4>{});  // axis x: no bearing tells y
  if (sweep.factor(3, 3) == 0.0) return f(std::integral_constant<int, 3>{});
  return f(std::integral_constant<int, kNone>{});
}

template <int blind>
[[gnu::flatten]] Gain<blind> times_factor(const Matrix6& covariance_with_seen, const SweepInformation& sweep) {
  Gain<blind> side;
  for_each_column<blind>([&](auto place, auto column) {
    constexpr int k = place, j = column, rows = 6 - j;
    side.col(k) = covariance_with_seen.rightCols<rows>().lazyProduct(sweep.factor.col(j).template tail<rows>());
  });
  return side;
}

/// side C^-T.
template <int blind>
[[gnu::flatten]] Gain<blind> whitened(const Gain<blind>& side, const Innovation& innovation) {
  Gain<blind> gain;
  for_each_column<blind>([&](auto place, auto column) {
    constexpr int k = place, j = column;
    Vector6 left = side.col(k);
    for_each_number<k>([&](auto number) {
      constexpr int before = number;
      left -= innovation.factor(j, before < blind ? before : before + 1) * gain.col(before);
    });
    gain.col(k) = innovation.inverse_root[j] * left;
  });
  return gain;
}

/// Of another part of the state, by its covariance with the pose that the innovation is of.
template <int blind>
Gain<blind> gain_of(const Matrix6& covariance_with_seen, const SweepInformation& sweep, const Innovation& innovation) {
  return whitened<blind>(times_factor<blind>(covariance_with_seen, sweep), innovation);
}

/// Of that pose itself.
template <int blind>
Gain<blind> gain_of(const Innovation& innovation) {
  return whitened<blind>(innovation.side.leftCols<kColumns<blind>>(), innovation);
}

/// from -= a b^T.
template <int columns>
[[gnu::flatten]] void subtract_product(Matrix6& from, const Eigen::Matrix<double, 6, columns>& a,
                                       const Eigen::Matrix<double, 6, columns>& b) {
  from -= a.lazyProduct(b.transpose());
}

/// from -= a a^T.
template <int columns>
[[gnu::flatten]] void subtract_square(Matrix6& from, const Eigen::Matrix<double, 6, columns>& a) {
  Matrix6 square;  // its lower triangle
  for_each_number<6>([&](auto number) {
    constexpr int k = number, rows = 6 - even(k);
    square.col(k).template tail<rows>() = a.template bottomRows<rows>().lazyProduct(a.row(k).transpose());
  });
  for_each_number<6>([&](auto number) {
    constexpr int k = number, below = 5 - k;
    from.col(k).template tail<below + 1>() -= square.col(k).template tail<below + 1>();
    if constexpr (below > 0) {
      from.row(k).template tail<below>() -= square.col(k).template tail<below>().transpose();
    }
  });
}

template <int blind>
[[gnu::flatten]] Vector6 shift_of(const Gain<blind>& gain, const Innovation& innovation) {
  Eigen::Matrix<double, kColumns<blind>, 1> seen;
  for_each_column<blind>([&](int k, int j) { seen[k] = innovation.whitened[j]; });
  return gain.lazyProduct(seen);
}

}  // namespace pharos::motion
