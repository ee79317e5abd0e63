// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/slam/body_campaign.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "tools/sim/stereo_tumbling/body_sequence.hpp"

namespace pharos::tools {
namespace {

// Small images, so that a few degrees take seconds.
sim::BodyScenario short_turn() {
  sim::BodyScenario scenario;
  scenario.turn_deg = 6.0;
  scenario.width_px = 400;
  scenario.height_px = 300;
  return scenario;
}

TEST(RandomBody, HasItsPartsTwiceWhereItIsSymmetric) {
  const sim::RandomBody body = sim::random_body(4);
  ASSERT_TRUE(body.symmetric);
  const Matrix3 opposite = Vector3(-1.0, -1.0, 1.0).asDiagonal();
  int wings = 0;
  for (const sim::Solid& one : body.scene.solids) {
    if (one.material.line_m <= 0.0) continue;
    ++wings;
    int alike = 0;
    for (const sim::Solid& other : body.scene.solids) {
      alike += other.material.pattern == one.material.pattern && other.R.isApprox(opposite * one.R) &&
               other.t_m.isApprox(opposite * one.t_m);
    }
    EXPECT_EQ(alike, 1);
  }
  EXPECT_EQ(wings, 2);
}

TEST(RandomBody, IsAnotherForEverySeedAndTheSameForOne) {
  const sim::RandomBody body = sim::random_body(5), again = sim::random_body(5), other = sim::random_body(7);
  EXPECT_FALSE(body.symmetric);
  EXPECT_EQ(body.spin_axis_body, again.spin_axis_body);
  EXPECT_EQ(body.scene.solids.size(), again.scene.solids.size());
  EXPECT_GT((body.spin_axis_body - other.spin_axis_body).norm(), 1e-3);
}

// A box on a floor: between light and shadow a large sun leaves a wider border.
TEST(SolidScene, ALargeSunSoftensShadows) {
  sim::SolidScene scene;
  scene.solids.push_back({sim::SolidBox{{-2.0, -2.0, 0.0}, {2.0, 2.0, 0.1}}, {}});
  scene.solids.push_back({sim::SolidBox{{-0.3, -0.3, -1.0}, {0.3, 0.3, -0.9}}, {}});
  scene.to_sun = Vector3(0.6, 0.0, -0.8);
  scene.fill = 0.0;
  const sim::Lens lens = sim::centred_lens(160, 120, 120.0);
  const auto half_lit = [&](double radius_rad) {
    scene.sun_radius_rad = radius_rad;
    const sim::LinearImage image = sim::solid_image(scene, lens, Matrix3::Identity(), Vector3(0.0, 0.0, -4.0), 16);
    int count = 0;
    for (const float light : image.light) count += light > 0.05F && light < 0.3F ? 1 : 0;
    return count;
  };
  EXPECT_GT(half_lit(0.15), 2 * half_lit(0.0));
}

TEST(BodyCampaign, FollowsABodyThroughAFewDegrees) {
  BodyCampaign campaign;
  campaign.scenario = short_turn();
  const BodyFigures figures = run_body(campaign, 9);
  EXPECT_EQ(figures.pairs, 7);
  EXPECT_EQ(figures.placed, 7);
  EXPECT_EQ(figures.lost, 0);
  EXPECT_EQ(figures.loops_right + figures.loops_wrong, 0);
  EXPECT_GT(figures.rmse_deg, 0.0);
  EXPECT_LT(figures.rmse_deg, 0.3);
  EXPECT_GE(figures.largest_deg, figures.last_deg);
  EXPECT_GT(figures.attitude_over_sigma, 0.0);
}

}  // namespace
}  // namespace pharos::tools
