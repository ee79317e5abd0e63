// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "pharos/base/units.hpp"
#include "tests/unit/tools/evaluate/planted.hpp"

namespace pharos::evaluate {
namespace {

constexpr double kDuration_s = 20.0;

TEST(Distribution, IsWhatItsNamesSay) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Distribution d = distribution_of(values);
  EXPECT_EQ(d.median, 50.0);
  EXPECT_EQ(d.p95, 95.0);
  EXPECT_EQ(d.p99, 99.0);
  EXPECT_EQ(d.max, 100.0);
  EXPECT_NEAR(d.rms, std::sqrt(3383.5), 1e-9);
  EXPECT_EQ(distribution_of({2.0}).p95, 2.0);
}

TEST(Figures, SpreadLeavesOutAConstantOffsetThatErrorsHold) {
  Planted planted = plant(*manoeuvre(kDuration_s), kDuration_s, {}, {0.0, 0.001, 0.0, 1.0});
  for (auto& sample : planted.estimate.samples) sample.pose.t.x() += 0.010;
  const Comparison c = compare(planted.estimate, planted.truth, {});
  ASSERT_EQ(c.refused, "");
  EXPECT_NEAR(c.figures.position.spread, std::sqrt(3.0) * 0.001, 0.05e-3);
  EXPECT_NEAR(c.figures.position.error.rms, std::sqrt(0.010 * 0.010 + 3.0 * 0.001 * 0.001), 0.1e-3);
  EXPECT_NEAR(c.figures.ate_m, std::sqrt(3.0) * 0.001, 0.05e-3);
  // Two independent errors in a motion.
  EXPECT_NEAR(*c.figures.position.relative, std::sqrt(6.0) * 0.001, 0.2e-3);
}

TEST(Figures, TellConsistentSigmasFromTooSmallOnes) {
  for (const double scale : {1.0, 0.5}) {
    const PlantedNoise noise{0.1 * kRadPerDeg, 0.001, 0.0, scale};
    const Planted planted = plant(*manoeuvre(kDuration_s), kDuration_s, {}, noise);
    const Comparison c = compare(planted.estimate, planted.truth, {});
    for (const Figures* half : {&c.figures.rotation, &c.figures.position}) {
      ASSERT_TRUE(half->consistency);
      EXPECT_NEAR(half->consistency->normalised_square * scale * scale, 1.0, 0.06);
      // Three equal axes: P(chi2_3 <= 3 k^2).
      EXPECT_NEAR(half->consistency->within[0], scale == 1.0 ? 0.608 : 0.139, 0.03);
      EXPECT_NEAR(half->consistency->within[1], scale == 1.0 ? 0.993 : 0.608, 0.03);
    }
  }
}

TEST(Figures, SayNothingOfSigmasThatAreNotStated) {
  const Planted planted = plant(*manoeuvre(kDuration_s), kDuration_s, {}, {});
  EXPECT_FALSE(compare(planted.estimate, planted.truth, {}).figures.rotation.consistency);
}

TEST(PoseAt, IsExactAtSamplesAndHalfwayBetween) {
  const Trajectory<TruthPose> two = {{1.0, {rotation_exp({0, 0, 0.2}), {1, 0, 0}}, {}, {}},
                                     {1.5, {rotation_exp({0, 0, 0.6}), {3, 0, 0}}, {}, {}}};
  const auto middle = pose_at(two, 1.25, 1.0);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(rotation_log(middle->pose.R).z(), 0.4, 1e-12);
  EXPECT_NEAR(middle->pose.t.x(), 2.0, 1e-12);
  EXPECT_NEAR(middle->rate_rad_s.z(), 0.8, 1e-12);
  EXPECT_NEAR(middle->velocity_m_s.x(), 4.0, 1e-12);
  EXPECT_FALSE(pose_at(two, 1.25, 0.4)) << "a gap is not bridged";
  EXPECT_TRUE(pose_at(two, 1.5, 0.4)) << "a sample's own time needs no neighbour";
  EXPECT_FALSE(pose_at(two, 0.9, 1.0));
  EXPECT_FALSE(pose_at(two, 1.6, 1.0));
}

}  // namespace
}  // namespace pharos::evaluate
