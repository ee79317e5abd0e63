// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace pharos::fixed {

// Arithmetic for cores without a floating-point unit: a number is an integer times a power of two that its name or
// comment tells ("Q30": times 2^-30, range +-2). A 32 x 32 -> 64 bit product takes two instructions on RV32IM, a soft
// double's some 130.

/// A number in [-2, 2), unit 2^-30.
using Q30 = std::int32_t;

inline constexpr Q30 kOne = 1 << 30;

/// A whole product: no bit is lost.
constexpr std::int64_t product(std::int32_t a, std::int32_t b) { return std::int64_t{a} * b; }

/// a times b in Q30, rounded; with b of any Q, in that Q.
constexpr std::int32_t times(std::int32_t a, Q30 b) {
  return static_cast<std::int32_t>((product(a, b) + (std::int64_t{1} << 29)) >> 30);
}

/// The same for a wide a; |a| below 2^60.
constexpr std::int64_t times_wide(std::int64_t a, Q30 b) {
  const std::int64_t high = (a >> 32) * b;
  const auto low = static_cast<std::int64_t>(static_cast<std::uint64_t>(a) & 0xFFFFFFFFU) * b;
  return high * 4 + (low >> 30);
}

/// a times 2^places, rounded down; zero or minus one when nothing is left. The caller keeps it within 64 bits.
constexpr std::int64_t shifted(std::int64_t a, int places) {
  if (places >= 0) return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) << static_cast<unsigned>(places));
  return a >> std::min(-places, 63);
}

/// Binary places of |a|: 0 for 0, 1 for 1, 2 for 2 and 3, …
constexpr int places_of(std::int64_t a) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(a < 0 ? -a : a)));
}

/// a cut to [-limit, limit].
constexpr std::int32_t clamped(std::int64_t a, std::int32_t limit) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(a, -limit, limit));
}

/// A finite double in units of 2^-fraction, to the nearest; cut to +-2^62.
constexpr std::int64_t from_double(double value, int fraction) {
  constexpr std::int64_t kLargest = std::int64_t{1} << 62;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto exponent = static_cast<int>(bits >> 52U & 0x7FFU);
  if (exponent == 0) return 0;
  const int places = exponent - 1075 + fraction;
  const auto mantissa = static_cast<std::int64_t>((bits & ((std::uint64_t{1} << 52U) - 1)) | (std::uint64_t{1} << 52U));
  std::int64_t size = kLargest;
  if (places < -54) {
    size = 0;
  } else if (places < 0) {
    size = ((mantissa >> (-places - 1)) + 1) >> 1;
  } else if (places < 9) {
    size = mantissa << places;
  }
  return (bits >> 63U) != 0 ? -size : size;
}

/// value times 2^-fraction; exact where |value| < 2^53 and the result is neither zero's neighbour nor infinity's.
constexpr double to_double(std::int64_t value, int fraction) {
  if (value == 0) return 0.0;
  const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(value));
  return std::bit_cast<double>(bits - (static_cast<std::uint64_t>(static_cast<std::int64_t>(fraction)) << 52U));
}

/// 1 / a in units of 2^-27, to 2^-27, for a (Q30) from 1/8 to 2: half a division and two steps of Newton's.
constexpr std::int32_t reciprocal(Q30 a) {
  auto x = static_cast<std::int32_t>(0xFFFFFFFFU / (static_cast<std::uint32_t>(a) >> 14U) << 11U);
  for (int step = 0; step < 2; ++step) {
    const auto error = static_cast<std::int32_t>(((std::int64_t{1} << 57) - product(a, x)) >> 27);
    x += times(x, error);
  }
  return x;
}

/// Square root and its inverse of a positive number.
struct Root {
  Q30 root;              // of value times 4^doublings, in [1/2, 1)
  std::int64_t inverse;  // of that root, Q30, in (1, 2]
  int doublings;
};

/// Of a value in units of 2^-60, above 0 and below 1; to 2^-30.
constexpr Root root_of(std::int64_t value) {
  const int doublings = (60 - places_of(value)) / 2;
  const std::int64_t x = shifted(value, 2 * doublings) >> 29;    // Q31, [1/4, 1)
  std::int64_t y = 2'330'000'000 - ((x * 1'310'000'000) >> 31);  // Q30: within 11 % of the inverse root
  for (int step = 0; step < 4; ++step) {
    const std::int64_t square = (y * y) >> 32;     // Q28
    const std::int64_t unit = (x * square) >> 29;  // Q30: 1 where y is right
    y = (y * (std::int64_t{3} * kOne - unit)) >> 31;
  }
  return {static_cast<Q30>(std::min<std::int64_t>((x * y) >> 31, kOne - 1)), y, doublings};
}

struct SineCosine {
  Q30 sine;
  Q30 cosine;
};

/// Sine and cosine of an angle in Q30 rad, [-pi/2, pi/2]; to 4e-9.
constexpr SineCosine sine_cosine(Q30 angle) {
  // Taylor's series of half the angle (below 0.79: the first terms left out are 1e-11), then the double angle's rule.
  const Q30 half = angle / 2;
  const Q30 square = times(half, half);
  constexpr auto term = [](double value) { return static_cast<Q30>(value * kOne); };
  Q30 s = term(-1.0 / 39916800.0);
  for (const Q30 next : {term(1.0 / 362880.0), term(-1.0 / 5040.0), term(1.0 / 120.0), term(-1.0 / 6.0), kOne}) {
    s = next + times(s, square);
  }
  Q30 c = term(1.0 / 479001600.0);
  for (const Q30 next :
       {term(-1.0 / 3628800.0), term(1.0 / 40320.0), term(-1.0 / 720.0), term(1.0 / 24.0), -kOne / 2}) {
    c = next + times(c, square);
  }
  const Q30 sine_half = times(half, s);
  const Q30 cosine_half = kOne + times(c, square);
  return {static_cast<Q30>(product(sine_half, cosine_half) >> 29),
          kOne - static_cast<Q30>(product(sine_half, sine_half) >> 29)};
}

}  // namespace pharos::fixed
