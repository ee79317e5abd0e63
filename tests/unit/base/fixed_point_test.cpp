// SPDX-License-Identifier: Apache-2.0
#include "pharos/base/fixed_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pharos::fixed {
namespace {

constexpr double kUnit = 1.0 / kOne;
__extension__ using Wide = __int128;

TEST(FixedPoint, FromDoubleAndBackIsTheNearest) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> values(-2.0, 2.0);
  for (int k = 0; k < 10'000; ++k) {
    const double value = values(engine);
    for (const int fraction : {0, 20, 30, 40, 60}) {
      const double back = to_double(from_double(value, fraction), fraction);
      EXPECT_LE(std::abs(back - value), std::ldexp(0.5, -fraction)) << value << " in 2^-" << fraction;
    }
  }
}

TEST(FixedPoint, FromDoubleCutsWhatDoesNotFit) {
  EXPECT_EQ(from_double(0.0, 30), 0);
  EXPECT_EQ(from_double(-0.0, 30), 0);
  EXPECT_EQ(from_double(1e-300, 30), 0);
  EXPECT_EQ(from_double(1e300, 30), std::int64_t{1} << 62);
  EXPECT_EQ(from_double(-1e300, 30), -(std::int64_t{1} << 62));
  EXPECT_EQ(from_double(std::nan(""), 30), std::int64_t{1} << 62);
  EXPECT_EQ(to_double(0, 30), 0.0);
}

TEST(FixedPoint, ShiftsBothWays) {
  EXPECT_EQ(shifted(3, 2), 12);
  EXPECT_EQ(shifted(-3, 2), -12);
  EXPECT_EQ(shifted(12, -2), 3);
  EXPECT_EQ(shifted(1, -100), 0);
  EXPECT_EQ(shifted(-1, -100), -1);
}

TEST(FixedPoint, ReciprocalIsGoodToItsUnit) {
  for (std::int64_t a = kOne / 8; a < std::int64_t{2} * kOne; a += 100'003) {
    const double inverse = reciprocal(static_cast<Q30>(a)) * std::ldexp(1.0, -27);
    ASSERT_NEAR(inverse, 1.0 / (static_cast<double>(a) * kUnit), std::ldexp(2.0, -27)) << a;
  }
}

TEST(FixedPoint, RootAndItsInverse) {
  std::mt19937_64 engine(2);
  for (int k = 0; k < 100'000; ++k) {
    const auto value = static_cast<std::int64_t>(engine() >> (4U + engine() % 56U));
    if (value == 0) continue;
    const Root root = root_of(value);
    const double expected = std::sqrt(std::ldexp(static_cast<double>(value), 2 * root.binary_exponent - 60));
    ASSERT_GE(expected, 0.4999999);
    ASSERT_LT(expected, 1.0);
    ASSERT_NEAR(root.root * kUnit, expected, 3 * kUnit) << value;
    ASSERT_NEAR(static_cast<double>(root.inverse) * kUnit, 1.0 / expected, 6 * kUnit) << value;
  }
}

TEST(FixedPoint, SineAndCosineOfTheWholeRange) {
  double worst = 0.0;
  const auto quarter = static_cast<std::int64_t>(std::acos(0.0) * kOne);
  for (std::int64_t angle = -quarter; angle <= quarter; angle += 10'007) {
    const SineCosine sc = sine_cosine(static_cast<Q30>(angle));
    const double exact = static_cast<double>(angle) * kUnit;
    worst =
        std::max({worst, std::abs(sc.sine * kUnit - std::sin(exact)), std::abs(sc.cosine * kUnit - std::cos(exact))});
  }
  EXPECT_LT(worst, 5e-9);
}

TEST(FixedPoint, WideProductsMatchTheExactOnes) {
  std::mt19937_64 engine(3);
  for (int k = 0; k < 10'000; ++k) {
    const auto a = static_cast<std::int64_t>(engine()) >> 4;
    const auto b = static_cast<std::int32_t>(engine());
    const auto exact = static_cast<std::int64_t>((static_cast<Wide>(a) * b) >> 30);
    if (std::abs(static_cast<double>(a) * b) > 9e27) continue;
    ASSERT_EQ(times_wide(a, b), exact);
  }
}

}  // namespace
}  // namespace pharos::fixed
