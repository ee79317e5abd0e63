// SPDX-License-Identifier: Apache-2.0
// Nineteen thousand answers of a faulty target for each fault and frequency.
#include <gtest/gtest.h>

#include "tests/unit/tracking/faulty_target.hpp"

namespace pharos::test {
namespace {

Count campaign(Fault fault, double fraction, double onset_s) { return score_of(fault, fraction, onset_s, 201, 240); }

TEST(FaultyTargetCampaign, AFaultFromTheStartGivesNothingThatIsFarOff) {
  for (const Fault fault : {Fault::kWrongTimes, Fault::kShiftedSweeps, Fault::kShiftedHits}) {
    for (const double fraction : {0.01, 0.1, 0.5, 1.0}) EXPECT_EQ(campaign(fault, fraction, 0.0).wrong, 0);
  }
  for (const double fraction : {0.01, 0.1, 0.5, 1.0}) {
    EXPECT_LE(campaign(Fault::kSteadyOffset, fraction, 0.0).wrong, 5);
  }
}

// The first sweeps of a fault meet a target that was sound for long.
TEST(FaultyTargetCampaign, AFaultThatBeginsInFlightGivesLittleThatIsFarOff) {
  for (const Fault fault : {Fault::kWrongTimes, Fault::kShiftedSweeps, Fault::kShiftedHits, Fault::kSteadyOffset}) {
    for (const double fraction : {0.1, 0.5, 1.0}) {
      const Count count = campaign(fault, fraction, 2.0);
      EXPECT_LT(1000 * count.wrong, count.answers);
    }
  }
}

}  // namespace
}  // namespace pharos::test
