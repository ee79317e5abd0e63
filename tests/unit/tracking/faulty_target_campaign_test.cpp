// SPDX-License-Identifier: Apache-2.0
// Nineteen thousand answers of a faulty target for each fault and frequency. PHAROS_FAULTY_SEED: the first of forty
// flights in place of 201, which the thresholds were set on; the counts are printed, and the limits hold for 201.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/unit/tracking/faulty_target.hpp"

namespace pharos::test {
namespace {

Count campaign(Fault fault, double fraction, double onset_s) {
  const char* asked = std::getenv("PHAROS_FAULTY_SEED");
  const std::uint64_t first = asked == nullptr ? 201 : std::strtoull(asked, nullptr, 10);
  return score_of(fault, fraction, onset_s, first, first + 39);
}

TEST(FaultyTargetCampaign, AFaultFromTheStartGivesNothingThatIsFarOff) {
  for (const Fault fault : {Fault::kWrongTimes, Fault::kShiftedSweeps, Fault::kShiftedHits}) {
    for (const double fraction : {0.01, 0.1, 0.5, 1.0}) EXPECT_EQ(campaign(fault, fraction, 0.0).wrong, 0);
  }
  for (const double fraction : {0.01, 0.1, 0.5, 1.0}) {
    EXPECT_LE(campaign(Fault::kSteadyOffset, fraction, 0.0).wrong, 5);
  }
}

// The first sweeps of a fault meet a target that was sound for long.
TEST(FaultyTargetCampaign, AFaultThatBeginsInFlightGivesNothingThatIsFarOff) {
  for (const Fault fault : {Fault::kWrongTimes, Fault::kShiftedSweeps, Fault::kShiftedHits}) {
    for (const double fraction : {0.1, 0.5, 1.0}) EXPECT_EQ(campaign(fault, fraction, 2.0).wrong, 0);
  }
  for (const double fraction : {0.1, 0.5, 1.0}) EXPECT_LE(campaign(Fault::kSteadyOffset, fraction, 2.0).wrong, 5);
}

}  // namespace
}  // namespace pharos::test
