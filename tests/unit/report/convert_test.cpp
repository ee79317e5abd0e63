// SPDX-License-Identifier: Apache-2.0
#include "pharos/report/convert.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "unit/report/samples.hpp"

namespace pharos::report {
namespace {

TEST(Convert, SweepsSurviveExactly) {
  std::mt19937_64 random(31);
  for (std::size_t hits = 0; hits <= kMaxHitsPerSweep; ++hits) {
    const auto sweep = test::random_sweep(random, hits);
    test::expect_equal(from_wire(to_wire(sweep)), sweep);
  }
}

TEST(Convert, EveryCounterTravelsInItsPlace) {
  DecoderReport report;
  report.time_ticks = 77;
  std::uint32_t next = 1;
#define PHAROS_X(name, text) report.counters.name = next++;
  PHAROS_DECODER_COUNTERS(PHAROS_X)
#undef PHAROS_X
  const wire::Counters message = to_wire(report);
  ASSERT_EQ(message.values.size(), next - 1);
  EXPECT_EQ(message.values[0], report.counters.edges_in);
  const DecoderReport back = decoder_report(message);
  EXPECT_EQ(back.time_ticks, 77);
  next = 1;
  for_each_counter(back.counters,
                   [&](const char* name, std::uint32_t value, const char*) { EXPECT_EQ(value, next++) << name; });
}

TEST(Convert, CountersOfAnOlderOrNewerTargetAreTakenAsFarAsKnown) {
  wire::Counters older;
  older.values.push_back(5);
  EXPECT_EQ(decoder_report(older).counters.edges_in, 5u);
  EXPECT_EQ(decoder_report(older).counters.ootx_restarts, 0u);
  wire::Counters newer = to_wire(DecoderReport{});
  newer.values.push_back(9);
  EXPECT_EQ(decoder_report(newer).counters.ootx_restarts, 0u);
}

PoseReport report_of(const LighthousePoseEstimate& estimate) {
  PoseReport report;
  report.station = 1;
  report.flags = 5;
  report.time_ticks = estimate.time_ns / 20;
  report.observations = estimate.observations;
  report.pose = estimate;
  return report;
}

TEST(Convert, PosesSurviveToTheStatedPrecision) {
  std::mt19937_64 random(32);
  for (int i = 0; i < 500; ++i) {
    const auto sent = test::random_estimate(random, i % 2 == 0);
    const auto back = from_wire(to_wire(report_of(sent)));
    ASSERT_TRUE(back && back->pose.ok());
    const LighthousePoseEstimate& got = *back->pose;
    EXPECT_LT((got.pose.R - sent.pose.R).norm(), 1e-14);
    EXPECT_EQ(got.pose.t, sent.pose.t);
    EXPECT_LT((got.covariance - sent.covariance).norm(), 1e-7 * sent.covariance.norm());
    EXPECT_EQ(got.covariance, got.covariance.transpose());
    EXPECT_NEAR(got.residual_rms, sent.residual_rms, 1e-7 * sent.residual_rms);
    EXPECT_NEAR(got.adop_deg_per_rad, sent.adop_deg_per_rad, 1e-7 * sent.adop_deg_per_rad);
    EXPECT_NEAR(got.pdop_m_per_rad, sent.pdop_m_per_rad, 1e-7 * sent.pdop_m_per_rad);
    EXPECT_EQ(got.time_ns, sent.time_ns);
    EXPECT_EQ(got.observations, sent.observations);
    EXPECT_EQ(got.iterations, sent.iterations);
    ASSERT_EQ(got.ambiguous(), sent.ambiguous());
    if (!sent.ambiguous()) continue;
    EXPECT_LT((got.second->pose.R - sent.second->pose.R).norm(), 1e-14);
    EXPECT_EQ(got.second->pose.t, sent.second->pose.t);
    EXPECT_EQ(got.second->delta_chi2, sent.second->delta_chi2);
  }
}

TEST(Convert, RefusalsKeepTheirReason) {
  PoseReport report;
  report.observations = 3;
  report.pose = pose::Refusal::kDegenerate;
  const auto back = from_wire(to_wire(report));
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->pose.ok());
  EXPECT_EQ(back->pose.error(), pose::Refusal::kDegenerate);
  EXPECT_EQ(back->observations, 3);
}

TEST(Convert, APoseThatIsNoRotationOrAnUnknownRefusalIsNotTaken) {
  std::mt19937_64 random(33);
  wire::Pose message = to_wire(report_of(test::random_estimate(random, false)));
  message.answer->pose.orientation_wxyz[0] += 0.01;
  EXPECT_FALSE(from_wire(message).has_value());
  wire::Pose refused;
  refused.refusal = 200;
  EXPECT_FALSE(from_wire(refused).has_value());
}

}  // namespace
}  // namespace pharos::report
