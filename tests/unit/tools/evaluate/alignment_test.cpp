// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pharos/base/units.hpp"
#include "tests/unit/tools/evaluate/planted.hpp"

namespace pharos::evaluate {
namespace {

using ::testing::HasSubstr;

constexpr double kSeconds = 20.0;

ComparisonOptions find_all() {
  ComparisonOptions options;
  options.mode = AlignMode::kHandEye;
  options.time_offset_s.reset();
  return options;
}

double turn_deg(const Matrix3& a, const Matrix3& b) { return rotation_angle_between(a, b) * kDegPerRad; }

TEST(Align, FindsFramesBodiesAndClockOfACleanRecordingToItsResolution) {
  const Alignment hidden = planted_alignment();
  const Planted planted = plant(*manoeuvre(kSeconds), kSeconds, hidden, {});
  const Comparison c = compare(planted.estimate, planted.truth, find_all());
  ASSERT_EQ(c.refused, "") << c.why;
  EXPECT_TRUE(c.aligned.open.empty());
  EXPECT_NEAR(c.aligned.alignment.time_offset_s, hidden.time_offset_s, 1e-6);
  EXPECT_LT(turn_deg(c.aligned.alignment.world.R, hidden.world.R), 1e-4);
  EXPECT_LT(turn_deg(c.aligned.alignment.body.R, hidden.body.R), 1e-4);
  EXPECT_LT((c.aligned.alignment.world.t - hidden.world.t).norm(), 1e-5);
  EXPECT_LT((c.aligned.alignment.body.t - hidden.body.t).norm(), 1e-5);
  EXPECT_LT(c.figures.position.error.max, 1e-5);
  EXPECT_EQ(c.pairs.pairs.size(), planted.estimate.rows);
  EXPECT_NEAR(c.figures.coverage, 1.0, 1e-6);
}

TEST(Align, IsRobustToNoiseAndOutlierPosesAndCountsThem) {
  const Alignment hidden = planted_alignment();
  const PlantedNoise noise{0.1 * kRadPerDeg, 0.001, 0.02, 1.0};
  const Planted planted = plant(*manoeuvre(kSeconds), kSeconds, hidden, noise);
  const Comparison c = compare(planted.estimate, planted.truth, find_all());
  ASSERT_EQ(c.refused, "") << c.why;
  EXPECT_NEAR(c.aligned.alignment.time_offset_s, hidden.time_offset_s, 0.5e-3);
  EXPECT_LT(turn_deg(c.aligned.alignment.world.R, hidden.world.R), 0.03);
  EXPECT_LT((c.aligned.alignment.world.t - hidden.world.t).norm(), 1e-3);
  EXPECT_LT((c.aligned.alignment.body.t - hidden.body.t).norm(), 1e-3);
  // The outliers remain in the figures: 0.7 rad and 100 mm.
  EXPECT_GT(c.figures.rotation.error.max * kDegPerRad, 39.0);
  EXPECT_GT(c.figures.position.error.max, 0.095);
  EXPECT_NEAR(c.figures.rotation.error.median * kDegPerRad, 1.538 * 0.1, 0.01);
  EXPECT_NEAR(c.figures.position.error.median, 1.538e-3, 0.1e-3);
}

TEST(Align, TakesAGivenOffsetAsItIs) {
  const Alignment hidden = planted_alignment();
  const Planted planted = plant(*manoeuvre(kSeconds), kSeconds, hidden, {});
  ComparisonOptions options = find_all();
  options.time_offset_s = hidden.time_offset_s + 0.010;
  const Comparison c = compare(planted.estimate, planted.truth, options);
  ASSERT_EQ(c.refused, "") << c.why;
  EXPECT_EQ(c.aligned.alignment.time_offset_s, hidden.time_offset_s + 0.010);
  EXPECT_GT(c.figures.position.error.rms, 1e-3);
}

TEST(Align, FindsTheClockAloneWhereFramesAreKnown) {
  Alignment hidden;
  hidden.time_offset_s = -7.25;
  const Planted planted = plant(*manoeuvre(kSeconds), kSeconds, hidden, {});
  ComparisonOptions options;
  options.time_offset_s.reset();
  const Comparison c = compare(planted.estimate, planted.truth, options);
  ASSERT_EQ(c.refused, "") << c.why;
  EXPECT_NEAR(c.aligned.alignment.time_offset_s, -7.25, 1e-6);
}

TEST(Align, Se3FindsTheWorldsOnly) {
  Alignment hidden = planted_alignment();
  hidden.body = {};
  hidden.time_offset_s = 0.0;
  const Planted planted = plant(*manoeuvre(kSeconds), kSeconds, hidden, {});
  ComparisonOptions options;
  options.mode = AlignMode::kSe3;
  const Comparison c = compare(planted.estimate, planted.truth, options);
  ASSERT_EQ(c.refused, "") << c.why;
  EXPECT_LT((c.aligned.alignment.world.t - hidden.world.t).norm(), 1e-5);
  EXPECT_LT(c.figures.ate_m, 1e-5);
}

/// Rotates only about the body's z, on a circle in a plane.
class OneAxis final : public sim::Trajectory {
 public:
  sim::RoomFromBody at(double t) const override {
    const double angle = 1.5 * std::sin(0.7 * t) + 0.4 * std::sin(1.9 * t + 1.0);
    return {rotation_exp({0.0, 0.0, angle}), {std::sin(0.5 * t), 0.7 * std::cos(0.3 * t), 2.0}};
  }
};

TEST(Align, SaysWhichOffsetTurningAboutOneAxisLeavesOpen) {
  const Planted planted = plant(OneAxis(), kSeconds, planted_alignment(), {});
  const Comparison c = compare(planted.estimate, planted.truth, find_all());
  ASSERT_EQ(c.refused, "") << c.why;
  ASSERT_EQ(c.aligned.open.size(), 1u);
  EXPECT_EQ(c.aligned.open[0].parts(), "world_offset|body_offset");
  // The axis in ESTIMATE's world is its z.
  EXPECT_NEAR(std::abs(c.aligned.open[0].world_offset.normalized().z()), 1.0, 1e-3);
  EXPECT_LT(c.figures.position.error.max, 1e-5);
}

class Motionless final : public sim::Trajectory {
 public:
  sim::RoomFromBody at(double) const override { return {rotation_exp({0.1, 0.2, 0.3}), {0.1, 0.2, 2.0}}; }
};

TEST(Align, RefusesATargetThatNeverMoved) {
  Alignment hidden = planted_alignment();
  hidden.time_offset_s = 0.0;
  const Planted planted = plant(Motionless(), kSeconds, hidden, {0.001, 0.001, 0.0, 1.0});
  ComparisonOptions options = find_all();
  options.time_offset_s = 0.0;
  const Comparison c = compare(planted.estimate, planted.truth, options);
  EXPECT_EQ(c.refused, "refused_too_little_motion");
  EXPECT_THAT(c.why, HasSubstr("turn between the"));
  options.mode = AlignMode::kSe3;
  EXPECT_EQ(compare(planted.estimate, planted.truth, options).refused, "refused_too_little_motion");
  options.time_offset_s.reset();
  EXPECT_EQ(compare(planted.estimate, planted.truth, options).refused, "refused_time_offset");
}

TEST(Align, RefusesAnOffsetThatAPeriodicMotionLeavesOpen) {
  class Periodic final : public sim::Trajectory {
   public:
    sim::RoomFromBody at(double t) const override {
      return {rotation_exp({0.5 * std::sin(kTwoPi * t / 2.0), 0.2, 0.0}), {std::sin(kTwoPi * t / 2.0), 0.0, 2.0}};
    }
  };
  const Planted planted = plant(Periodic(), kSeconds, {}, {});
  ComparisonOptions options;
  options.time_offset_s.reset();
  const Comparison c = compare(planted.estimate, planted.truth, options);
  EXPECT_EQ(c.refused, "refused_time_offset");
  EXPECT_THAT(c.why, HasSubstr("repeats itself"));
}

TEST(Align, RefusesRecordingsThatShareNoTime) {
  const Planted planted = plant(*manoeuvre(kSeconds), kSeconds, planted_alignment(), {});
  const Comparison c = compare(planted.estimate, planted.truth, {});
  EXPECT_EQ(c.refused, "refused_no_overlap");
  EXPECT_THAT(c.why, HasSubstr("--time-offset"));
  EXPECT_EQ(c.pairs.outside, planted.estimate.rows);
}

TEST(Align, LeavesOutWhatTruthDoesNotKnow) {
  Planted planted = plant(*manoeuvre(kSeconds), kSeconds, {}, {});
  auto& samples = planted.truth.samples;
  std::erase_if(samples, [](const auto& s) { return s.time_s > 5.0 && s.time_s < 6.0; });
  const Comparison c = compare(planted.estimate, planted.truth, {});
  ASSERT_EQ(c.refused, "");
  EXPECT_NEAR(static_cast<double>(c.pairs.in_gap), 120.0, 2.0);
  EXPECT_NEAR(c.figures.coverage, 1.0 - 1.0 / kSeconds, 0.002);
}

}  // namespace
}  // namespace pharos::evaluate
