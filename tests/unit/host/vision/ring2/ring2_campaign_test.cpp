// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/unit/host/vision/ring2/rendered_pair.hpp"

namespace pharos::host {
namespace {

// Fewer rays than in `pharos sim stereo`, at fewer positions: half the time. Edges are less accurate, so the limits
// hold there too.
constexpr Rays kQuick{3, 0.05};

TEST(Ring2Campaign, AHundredRenderedAttitudes) {
  const sim::Ring2Scenario scenario = sim::parse_ring2_scenario("[random]\ncount = 100\n", "campaign", 1);
  const int count = static_cast<int>(scenario.poses.size());
  Ring2Detector finder(ring2::core_rig(scenario.rig), {});
  double square = 0.0;
  int answered = 0;
  int wrong = 0;
  for (std::size_t pair = 0; pair < scenario.poses.size(); ++pair) {
    const Ring2Detection circles = finder.find(views_of(rendered_pair(scenario, pair, kQuick)));
    if (!circles.estimate || circles.estimate->ambiguous()) {
      EXPECT_FALSE(!circles.estimate && circles.refusal.empty());
      std::printf("pair %zu: %s\n", pair, circles.refusal.c_str());
      continue;
    }
    const double error_deg = angle_deg(circles.estimate->normal, scenario.target_at(pair).normal);
    ++answered;
    square += error_deg * error_deg;
    wrong += error_deg > 1.0 ? 1 : 0;
  }
  const double rms_deg = std::sqrt(square / answered);
  std::printf("%d of %d answered, RMS %.4f deg\n", answered, count, rms_deg);
  EXPECT_GE(answered, (98 * count + 99) / 100);
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(rms_deg, 0.1);
}

}  // namespace
}  // namespace pharos::host
