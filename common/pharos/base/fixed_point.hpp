// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace pharos::fixed {

// Arithmetic for cores without a floating-point unit: a number is an integer times a power of two given by its name or
// comment ("Q30": times 2^-30, range +-2). A 32 x 32 -> 64 bit product takes two instructions on RV32IM, a soft
// double's some 130.

/// A number in [-2, 2), unit 2^-30.
using Q30 = std::int32_t;

inline constexpr Q30 kOne = 1 << 30;

/// The full product: no bit is lost.
constexpr std::int64_t product(std::int32_t a, std::int32_t b) { return std::int64_t{a} * b; }

/// The upper half of the product, rounded down: one instruction, where 30 bits suffice.
constexpr std::int32_t high(std::int32_t a, std::int32_t b) { return static_cast<std::int32_t>(product(a, b) >> 32); }

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

/// a times 2^places, rounded down; zero or minus one when no bit is left. The caller keeps it within 64 bits.
constexpr std::int64_t shifted(std::int64_t a, int places) {
  if (places >= 0) return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) << static_cast<unsigned>(places));
  return a >> std::min(-places, 63);
}

/// Number of bits of |a|: 0 for 0, 1 for 1, 2 for 2 and 3, …
constexpr int bits_of(std::int64_t a) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(a < 0 ? -a : a)));
}

/// The maximum number of bits of any of them.
template <class Range>
constexpr int max_bits_of(const Range& range) {
  std::uint64_t all = 0;
  for (const std::int64_t a : range) all |= static_cast<std::uint64_t>(a < 0 ? -a : a);
  return static_cast<int>(std::bit_width(all));
}

/// Whether it fits 32 bits.
constexpr bool is_narrow(std::int64_t a) { return a == static_cast<std::int32_t>(a); }

/// a limited to [-limit, limit].
constexpr std::int32_t clamped(std::int64_t a, std::int32_t limit) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(a, -limit, limit));
}

/// A finite double in units of 2^-fraction, to the nearest; limited to +-2^62.
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

/// 1 / a in units of 2^-27, to 2^-27, for a (Q30) from 1/8 to 2: half a division and two steps of Newton's method.
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
  Q30 root;               // of value times 4^doublings, in [1/2, 1)
  std::uint32_t inverse;  // of that root, Q30, in (1, 2]
  int binary_exponent;
};

/// Of a value in units of 2^-60, above 0 and below 1; to 2^-30.
constexpr Root root_of(std::int64_t value) {
  const int binary_exponent = (60 - bits_of(value)) / 2;
  const auto x = static_cast<std::uint32_t>(shifted(value, 2 * binary_exponent) >> 29);  // Q31, [1/4, 1)
  constexpr auto times_unsigned = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} * b; };
  // Q30: within 11 % of the inverse root.
  std::uint32_t y = 2'330'000'000U - static_cast<std::uint32_t>(times_unsigned(x, 1'310'000'000U) >> 31U);
  for (int step = 0; step < 4; ++step) {
    const auto square = static_cast<std::uint32_t>(times_unsigned(y, y) >> 32U);     // Q28
    const auto unit = static_cast<std::uint32_t>(times_unsigned(x, square) >> 29U);  // Q30: 1 where y is right
    y = static_cast<std::uint32_t>(times_unsigned(y, 3U * kOne - unit) >> 31U);
  }
  const auto root = static_cast<std::uint32_t>(times_unsigned(x, y) >> 31U);
  return {static_cast<Q30>(std::min<std::uint32_t>(root, kOne - 1)), y, binary_exponent};
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
  // The error of the last terms shrinks with those that follow.
  for (const Q30 next : {term(1.0 / 362880.0), term(-1.0 / 5040.0)}) {
    s = next + 4 * high(s, square) + 2;
  }
  s = term(1.0 / 120.0) + times(s, square);
  s = kOne + times(term(-1.0 / 6.0) + times(s, square), square);
  Q30 c = term(1.0 / 479001600.0);
  for (const Q30 next : {term(-1.0 / 3628800.0), term(1.0 / 40320.0)}) {
    c = next + 4 * high(c, square) + 2;
  }
  c = term(-1.0 / 720.0) + times(c, square);
  c = -kOne / 2 + times(term(1.0 / 24.0) + times(c, square), square);
  const Q30 sine_half = times(half, s);
  const Q30 cosine_half = kOne + times(c, square);
  return {static_cast<Q30>(product(sine_half, cosine_half) >> 29),
          kOne - static_cast<Q30>(product(sine_half, sine_half) >> 29)};
}

}  // namespace pharos::fixed
