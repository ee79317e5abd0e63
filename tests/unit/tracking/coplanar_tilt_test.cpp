// SPDX-License-Identifier: Apache-2.0
// Four coplanar sensors alone, whose tilt passes zero: the body may have gone on to either side, and only perspective
// tells which. Until it has, the answer is ambiguous.
#include <gtest/gtest.h>

#include "tests/unit/tracking/faulty_target.hpp"
#include "tests/unit/tracking/tilting_plate.hpp"

namespace pharos::test {
namespace {

// Of seeds 1 to 200 those in which the wrong side was followed with a confident sigma, for up to 180 answers each.
TEST(CoplanarTilt, ThatPassesZeroIsAmbiguousUntilItsSideIsTold) {
  constexpr std::array<std::uint64_t, 7> kFlights{22, 49, 70, 74, 94, 114, 160};
  int ambiguous = 0;
  for (const std::uint64_t seed : kFlights) {
    const Count count = score_of(Fault::kNone, 1.0, 0.0, seed, seed, tilting_plate);
    EXPECT_EQ(count.wrong, 0) << seed;
    EXPECT_GT(count.ok + count.ambiguous, 0.8 * count.answers) << seed;
    ambiguous += count.ambiguous;
  }
  EXPECT_GT(ambiguous, 0);
}

// The tilt passes zero and grows about another axis than the one that is followed: 5.6 deg in place of 3, with a stated
// 2.6. Both shorten the pattern of the sensors, one of them in what the filter takes for range: 58 answers were up to
// 23 mm off at a stated 4.
TEST(CoplanarTilt, ThatIsWrongIsInTheRangesSigma) {
  const Count count = score_of(Fault::kNone, 1.0, 0.0, 15237, 15237, tilting_plate);
  EXPECT_EQ(count.wrong, 0);
  EXPECT_GT(count.ok, 0.8 * count.answers);
}

// Seen alone for a second and more of a flight of all twelve; in 14294 after two wrong sweeps of a rotor.
TEST(CoplanarTilt, OfAFlightIsNotTakenForItsMirrorImage) {
  const Count sound = score_of(Fault::kNone, 1.0, 0.0, 14223, 14223);
  const Count faulty = score_of(Fault::kShiftedSweeps, 0.01, 0.0, 14294, 14294);
  for (const Count& count : {sound, faulty}) {
    EXPECT_EQ(count.wrong, 0);
    EXPECT_GT(count.ok + count.ambiguous, 0.85 * count.answers);
  }
}

}  // namespace
}  // namespace pharos::test
