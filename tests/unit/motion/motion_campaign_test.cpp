// SPDX-License-Identifier: Apache-2.0
// A hundred manoeuvres from slow to fast tumbling, a third of them with short and long darkness: consistent throughout.
#include <gtest/gtest.h>

#include "tests/unit/motion/flight.hpp"

namespace pharos::motion {
namespace {

TEST(MotionCampaign, NeesOverAHundredManoeuvres) {
  test::FlightScore all, dark;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const double pace = 1.0 + static_cast<double>(seed % 4);  // 0.5 m/s and 45 deg/s to 2 m/s and 180 deg/s
    sim::LighthouseScenario scenario = test::manoeuvre(12.0, 0.5 * pace, 45.0 * pace, seed);
    const bool darkness = seed % 3 == 0;
    if (darkness) scenario.faults.blackouts = {{3.0, 3.15}, {6.0, 7.0}, {9.0, 9.15}};
    test::fly(scenario, seed, [&](const test::FlightSample& answer) {
      all.add(answer);
      if (darkness) dark.add(answer);
    });
  }
  std::printf("all: NEES %.3f, RMS %.3f deg %.3f mm, max %.2f deg %.1f mm, %d answers, %d ambiguous, %d refused\n",
              all.nees_per_freedom(), all.rotation_rms_deg(), all.position_rms_mm(), all.rotation_max_deg,
              all.position_max_mm, all.answers, all.ambiguous, all.refused);
  std::printf("with darkness: NEES %.3f\n", dark.nees_per_freedom());
  EXPECT_GT(all.nees_per_freedom(), 0.9);
  EXPECT_LT(all.nees_per_freedom(), 1.1);
  EXPECT_GT(dark.nees_per_freedom(), 0.9);
  EXPECT_LT(dark.nees_per_freedom(), 1.1);
}

}  // namespace
}  // namespace pharos::motion
