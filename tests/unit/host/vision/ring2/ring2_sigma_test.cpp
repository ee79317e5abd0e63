// SPDX-License-Identifier: Apache-2.0
// What the answer states of its errors, over random bodies. `pharos reproduce integrity --kind ring2` has more of them.
#include <gtest/gtest.h>

#include "host/vision/ring2/ring2_detector.hpp"
#include "pharos/base/units.hpp"
#include "tools/evaluation/reproduce/ring2/simulated_pair.hpp"
#include "tools/sim/ring2/random_target.hpp"

namespace pharos::host {
namespace {

struct Answer {
  double off_deg = 0.0, sigma_deg = 0.0;
};

Answer answer_of(std::uint64_t seed) {
  const sim::RandomTarget target = sim::random_target(seed);
  const GreyImage left = sim::image_of(target, 0, seed), right = sim::image_of(target, 1, seed);
  const Ring2Detection found = Ring2Detector(ring2::core_rig(target.rig), {}).find({left.view(), right.view()});
  EXPECT_TRUE(found.estimate.has_value()) << seed << ": " << found.refusal;
  if (!found.estimate) return {};
  return {found.estimate->normal.cross(target.truth.normal).norm() * kDegPerRad,
          found.estimate->sigma_normal_rad() * kDegPerRad};
}

// Where nothing disturbs four contours of 50 to 180 px, 0.07 px are stated of them: 0.064 deg for 0.09.
TEST(Ring2Sigmas, AreSmallWhereNothingDisturbsTheContours) {
  const Answer answer = answer_of(440014);
  EXPECT_LT(answer.sigma_deg, 0.07);
  EXPECT_LT(answer.off_deg, 2.0 * answer.sigma_deg);
}

// The nozzle's contours look whole, and are those of another of its edges, 0.3 px off.
TEST(Ring2Sigmas, HoldAContourOfAnotherEdge) {
  const Answer answer = answer_of(440015);
  EXPECT_GT(answer.off_deg, 0.1);
  EXPECT_LT(answer.off_deg, 4.0 * answer.sigma_deg);
}

}  // namespace
}  // namespace pharos::host
