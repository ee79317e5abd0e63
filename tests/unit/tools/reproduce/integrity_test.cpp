// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tools/evaluation/reproduce/integrity/campaign.hpp"

namespace pharos::tools {
namespace {

IntegrityTrial answered(double error, double sigma) { return {true, "ok", {{"attitude, deg", error, sigma, 1.0}}}; }

double value_of(const std::vector<ComparisonRow>& rows, const std::string& what) {
  for (const ComparisonRow& row : rows) {
    if (row.what == what) return row.ours.value_or(-1.0);
  }
  ADD_FAILURE() << "no row " << what;
  return -1.0;
}

TEST(Integrity, AFailureIsBeyondFiveSigmasAndBeyondTheTolerance) {
  EXPECT_FALSE(answered(0.9, 0.01).failed());
  EXPECT_FALSE(answered(4.9, 1.0).failed());
  EXPECT_TRUE(answered(5.1, 1.0).failed());
  IntegrityTrial ambiguous = answered(50.0, 0.1);
  ambiguous.status = "ambiguous";
  EXPECT_FALSE(ambiguous.failed());
}

TEST(Integrity, CountsAreByStatusAndAvailabilityByTheRule) {
  const std::vector<IntegrityTrial> trials = {answered(0.3, 0.1),
                                              answered(30.0, 0.1),
                                              {true, "refused_no_panel", {}},
                                              {false, "refused_no_panel", {}},
                                              {true, "ambiguous", {}}};
  const IntegrityKind kind{"kind", "always", [&](std::uint64_t seed) { return trials[seed - 7]; }, {}, {}};
  int steps = 0;
  const IntegrityCounts counts = run_integrity(kind, 7, 5, nullptr, [&] { ++steps; });
  EXPECT_EQ(steps, 5);
  const std::vector<ComparisonRow> rows = counts.rows(kind);
  EXPECT_EQ(value_of(rows, "trials"), 5);
  EXPECT_EQ(value_of(rows, "answered"), 2);
  EXPECT_EQ(value_of(rows, "ambiguous"), 1);
  EXPECT_EQ(value_of(rows, "refused"), 2);
  EXPECT_EQ(value_of(rows, "failures"), 1);
  EXPECT_EQ(value_of(rows, "availability"), 50.0);
  EXPECT_DOUBLE_EQ(value_of(rows, "attitude, deg: error over sigma, RMS"), std::sqrt((9.0 + 90000.0) / 2.0));
  EXPECT_THAT(rows[4].remark, testing::HasSubstr("8"));
}

}  // namespace
}  // namespace pharos::tools
