// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/pass.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "orbit_sight.hpp"

namespace pharos::pointing {
namespace {

constexpr double kSigma_rad = 0.05 * kRadPerDeg;  // of a panel's image 60 px long
constexpr int kImages = 100;
constexpr double kSpacing_s = 2.0;

using AxisAt = std::function<Vector3(double time_s)>;  // in I

std::vector<PassImage> pass_of(const OrbitSight& truth, const AxisAt& axis, unsigned seed, bool with_range = false) {
  std::mt19937_64 random(seed);
  std::vector<PassImage> images;
  for (int k = 0; k < kImages; ++k) {
    const double time_s = truth.culmination_s + kSpacing_s * (k - 0.5 * (kImages - 1));
    images.push_back(truth.image(time_s, axis(time_s), kSigma_rad, random, with_range));
  }
  return images;
}

PassSolution solve(const OrbitSight& truth, const std::vector<PassImage>& images, AttitudeLaw law) {
  const auto workspace = std::make_unique<PassWorkspace>();
  PassOptions options;
  options.station = truth.station;
  options.law = law;
  return estimate_pass(images, options, *workspace);
}

double error_deg(const PassSolution& answer, const OrbitSight& truth, const Vector3& axis_inertial) {
  const Vector3 expected = station_to_earth(truth.station).transpose() * axis_inertial;
  return std::atan2(answer.estimate.axis_station.cross(expected).norm(),
                    std::abs(answer.estimate.axis_station.dot(expected))) *
         kDegPerRad;
}

AxisAt inertial(const Vector3& axis) {
  return [axis](double) { return axis; };
}
AxisAt nadir(const OrbitSight& truth, const Vector3& axis_orbital) {
  return [&truth, axis_orbital](double t) { return Vector3(truth.orbital(t).transpose() * axis_orbital); };
}
AxisAt spinning(const OrbitSight& truth, const Spin& spin) {
  return [&truth, spin](double t) { return spin.at(t - truth.culmination_s); };
}

const Vector3 kAxis = Vector3(0.5, -0.6, 0.62).normalized();

TEST(Pass, AnInertialAxisIsFoundAndItsErrorIsWhatIsStated) {
  const OrbitSight truth;
  double square = 0.0;
  constexpr int kPasses = 30;
  for (unsigned seed = 1; seed <= kPasses; ++seed) {
    const PassSolution answer = solve(truth, pass_of(truth, inertial(kAxis), seed), AttitudeLaw::kInertial);
    ASSERT_FALSE(answer.failure) << name_of(*answer.failure);
    EXPECT_LT(error_deg(answer, truth, kAxis), 0.1);
    EXPECT_GE(answer.estimate.axis_station.z(), 0.0);
    EXPECT_EQ(answer.estimate.images, kImages);
    square += std::pow(error_deg(answer, truth, kAxis) * kRadPerDeg / answer.estimate.sigma_rad(), 2) / kPasses;
  }
  EXPECT_NEAR(std::sqrt(square), 1.0, 0.3);
}

TEST(Pass, ANadirLockedAxisIsFoundWithRangesAndWithout) {
  const OrbitSight truth;
  const Vector3 across = Vector3(0.1, 0.98, -0.15).normalized();
  for (const bool with_range : {true, false}) {
    const PassSolution answer = solve(truth, pass_of(truth, nadir(truth, across), 3, with_range), AttitudeLaw::kNadir);
    ASSERT_FALSE(answer.failure) << name_of(*answer.failure);
    EXPECT_LT(error_deg(answer, truth, nadir(truth, across)(truth.culmination_s)), 0.1);
    EXPECT_LT(std::min((answer.estimate.axis_law - across).norm(), (answer.estimate.axis_law + across).norm()), 0.002);
    ASSERT_TRUE(answer.estimate.orbit);
  }
}

TEST(Pass, ASpinningAxisIsFoundWithItsSpin) {
  const OrbitSight truth;
  const Spin spin{kAxis, Vector3(0.1, 0.9, 0.4).normalized(), 1.3 * kRadPerDeg};
  const PassSolution answer = solve(truth, pass_of(truth, spinning(truth, spin), 4), AttitudeLaw::kSpin);
  ASSERT_FALSE(answer.failure) << name_of(*answer.failure);
  EXPECT_LT(error_deg(answer, truth, kAxis), 0.3);
  ASSERT_TRUE(answer.estimate.spin);
  const Spin& found = answer.estimate.spin->spin;
  const double way = found.spin.dot(spin.spin) < 0.0 ? -1.0 : 1.0;
  EXPECT_NEAR(way * found.rate_rad_s * kDegPerRad, 1.3, 0.01);
  EXPECT_LT((way * found.spin - spin.spin).norm(), 0.01);
}

TEST(Pass, AWrongLawIsRejected) {
  const OrbitSight truth;
  const Vector3 across = Vector3(0.3, 0.8, -0.5).normalized();
  const Spin spin{kAxis, Vector3(0.1, 0.9, 0.4).normalized(), 0.3 * kRadPerDeg};
  const auto failure_of = [&](const AxisAt& axis, AttitudeLaw law) {
    return solve(truth, pass_of(truth, axis, 5), law).failure;
  };
  EXPECT_EQ(failure_of(nadir(truth, across), AttitudeLaw::kInertial), PassFailure::kLawDoesNotFit);
  EXPECT_EQ(failure_of(inertial(kAxis), AttitudeLaw::kNadir), PassFailure::kLawDoesNotFit);
  EXPECT_EQ(failure_of(spinning(truth, spin), AttitudeLaw::kInertial), PassFailure::kLawDoesNotFit);
  EXPECT_EQ(failure_of(spinning(truth, spin), AttitudeLaw::kNadir), PassFailure::kLawDoesNotFit);
}

TEST(Pass, AnAxisThatStandsStillHasNoSpin) {
  const OrbitSight truth;
  for (const unsigned seed : {11U, 12U}) {
    EXPECT_EQ(solve(truth, pass_of(truth, inertial(kAxis), seed), AttitudeLaw::kSpin).failure,
              PassFailure::kSpinNotSeen);
  }
}

TEST(Pass, AFewImagesOfAnotherEdgeAreSetAside) {
  const OrbitSight truth;
  std::vector<PassImage> images = pass_of(truth, inertial(kAxis), 6);
  std::mt19937_64 random(7);
  for (const std::size_t k : {20U, 50U, 81U}) {
    images[k] = truth.image(images[k].observation.time_s, Vector3::UnitZ(), kSigma_rad, random, false);
  }
  const PassSolution answer = solve(truth, images, AttitudeLaw::kInertial);
  ASSERT_FALSE(answer.failure);
  EXPECT_EQ(answer.estimate.rejected, 3);
  EXPECT_LT(error_deg(answer, truth, kAxis), 0.1);
}

TEST(Pass, ImagesWithoutPlanesAreGapsNotErrors) {
  const OrbitSight truth;
  std::vector<PassImage> images = pass_of(truth, inertial(kAxis), 8);
  for (std::size_t k = 10; k < 60; ++k) images[k].planes_station.clear();
  const PassSolution answer = solve(truth, images, AttitudeLaw::kInertial);
  ASSERT_FALSE(answer.failure);
  EXPECT_EQ(answer.estimate.images, kImages - 50);
  EXPECT_LT(error_deg(answer, truth, kAxis), 0.3);
}

TEST(Pass, SaysWhatIsMissing) {
  const OrbitSight truth;
  std::vector<PassImage> images = pass_of(truth, inertial(kAxis), 9);
  EXPECT_EQ(solve(truth, {images.begin(), images.begin() + 2}, AttitudeLaw::kInertial).failure,
            PassFailure::kTooFewImages);
  for (std::size_t k = 0; k < images.size(); ++k) images[k].observation.time_s = 1000.0 + 0.05 * static_cast<double>(k);
  EXPECT_EQ(solve(truth, images, AttitudeLaw::kNadir).failure, PassFailure::kNoOrbit);
}

TEST(IsFitting, FollowsTheQuantilesOfChiSquared) {
  // 99.99 % of chi-squared: 4 degrees of freedom 23.5, 10: 35.6 (tables).
  EXPECT_TRUE(is_fitting(23.0, 4));
  EXPECT_FALSE(is_fitting(24.2, 4));
  EXPECT_TRUE(is_fitting(35.0, 10));
  EXPECT_FALSE(is_fitting(36.5, 10));
  EXPECT_TRUE(is_fitting(1.9 * 500, 500));
  EXPECT_FALSE(is_fitting(2.1 * 500, 500));
  EXPECT_TRUE(is_fitting(0.0, 0));
}

}  // namespace
}  // namespace pharos::pointing
