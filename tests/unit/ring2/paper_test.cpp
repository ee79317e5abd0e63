// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "pharos/ring2/paper_method.hpp"
#include "tests/unit/ring2/scenes.hpp"

namespace pharos::ring2 {
namespace {

double paper_error_deg(const Scene& scene) {
  const auto estimate = solve_ring2_by_paper(core_rig(scene.rig), clean_contours(scene));
  EXPECT_TRUE(estimate.ok());
  return estimate ? angle_between(estimate->normal, scene.target.normal) / kDeg : 90.0;
}

double one_camera_error_deg(const Scene& scene) {
  const ContourSet contours = clean_contours(scene);
  const auto attitude =
      attitude_by_one_camera(core_rig(scene.rig).views[0], *contours[0][0], *contours[0][1], {0.56, 0.1485, 0.5});
  EXPECT_TRUE(attitude.ok());
  return angle_between(normal_of(*attitude), scene.target.normal) / kDeg;
}

TEST(PaperMethod, AttitudeSweepsStayBelowHalfADegreeAndBelowOneCamera) {
  for (int tenth = 0; tenth <= 50; tenth += 5) {
    const double angle = tenth * 0.1 * kDeg;
    for (const Scene& scene : {scene_of(0.0, angle), scene_of(angle, 0.0), scene_of(angle, 5.0 * kDeg - angle)}) {
      const double error_deg = paper_error_deg(scene);
      EXPECT_LT(error_deg, 0.5);
      EXPECT_LT(error_deg, one_camera_error_deg(scene));
    }
  }
}

TEST(PaperMethod, RigSweepsStayBelowOneDegree) {
  const double one = 1.0 * kDeg;
  for (int mm = 2600; mm >= 1000; mm -= 100) EXPECT_LT(paper_error_deg(scene_of(one, one, 3.0, mm * 1e-3)), 1.0);
  for (int deg = 30; deg >= 0; deg -= 2) EXPECT_LT(paper_error_deg(scene_of(one, one, 3.0, 1.8, deg * kDeg)), 1.0);
  for (int mm = 3000; mm >= 1600; mm -= 100) EXPECT_LT(paper_error_deg(scene_of(one, one, mm * 1e-3)), 1.0);
}

TEST(PaperMethod, KeepsTheSignOfTheAttitude) {
  for (const double sign : {-1.0, 1.0}) {
    const Scene scene = scene_of(sign * 3.0 * kDeg, -sign * 2.0 * kDeg);
    const auto estimate = solve_ring2_by_paper(core_rig(scene.rig), clean_contours(scene));
    ASSERT_TRUE(estimate.ok());
    const Attitude attitude = attitude_of(estimate->normal);
    EXPECT_NEAR(attitude.theta_rad / kDeg, sign * 3.0, 0.5);
    EXPECT_NEAR(attitude.gamma_rad / kDeg, -sign * 2.0, 0.5);
  }
}

// A plane with A at (AD, CD) and B at (BE, CE), and the axis' true angle.
struct Triangle {
  PlaneTriangle triangle;
  double AD, BE, angle;
};

Triangle triangle_of(double AD, double CD, double angle, double d) {
  const double BE = AD + d * std::sin(angle);
  const double CE = CD - d * std::cos(angle);
  return {{std::atan(AD / CD), std::atan(BE / CE), CD, CE}, AD, BE, angle};
}

TEST(PaperMethod, EquationsAsPrintedHoldInAllThreeCases) {
  constexpr double d = 0.5;
  // The principal point beside G1 (1), between G1 and H1 (2), beyond H1 (3); the figure's x runs towards H1.
  const Triangle first = triangle_of(0.3, 3.0, 0.3, d);
  const Triangle second = triangle_of(-0.05, 3.0, 0.3, d);
  const Triangle third = triangle_of(-0.4, 3.0, 0.3, d);
  for (const Triangle& t : {first, second, third}) {
    const PlaneTriangle& s = t.triangle;
    EXPECT_NEAR(distance_by_paper(s), d, 1e-12);
    EXPECT_NEAR(axis_angle_by_paper(s, d), t.angle, 1e-12);
    // (8), (9) from O1 where A B meets the optical axis; signed, for O1 may lie between A and B.
    const double O1D1 = t.AD * (s.CD_m - s.CE_m) / (t.BE - t.AD);
    const double O1E1 = t.BE * (s.CD_m - s.CE_m) / (t.BE - t.AD);
    const double by_nine = std::copysign(std::hypot(O1E1, t.BE), t.BE) - std::copysign(std::hypot(O1D1, t.AD), t.AD);
    EXPECT_NEAR(by_nine, d, 1e-12);
    // (20), (21), (23): C1 O1 of the image plane is parallel to A B.
    const double theta = axis_angle_by_paper(s, d);
    const double CO = 1.0 / std::cos(theta);
    const double CG = 1.0 / std::cos(s.beta1_rad), CH = 1.0 / std::cos(s.beta2_rad);
    const double OG = std::tan(s.beta1_rad) + std::tan(theta), OH = std::tan(s.beta2_rad) + std::tan(theta);
    EXPECT_NEAR(2.0 * CO * CG * std::cos(theta + s.beta1_rad), CO * CO + CG * CG - OG * OG, 1e-12);
    EXPECT_NEAR(2.0 * CO * CH * std::cos(theta + s.beta2_rad), CO * CO + CH * CH - OH * OH, 1e-12);
    EXPECT_NEAR(std::acos(1.0 / CO), std::abs(theta), 1e-7);
  }
  // The cases' own forms, with the unsigned angles of the print.
  const auto AC = [](const Triangle& t) { return t.triangle.CD_m / std::cos(t.triangle.beta1_rad); };
  const double b1 = std::abs(first.triangle.beta1_rad), b2 = std::abs(first.triangle.beta2_rad);
  EXPECT_NEAR(std::asin(AC(first) / d * std::sin(b2 - b1)) - b2, 0.3, 1e-12);  // (10), (12)
  const double c1 = std::abs(second.triangle.beta1_rad), c2 = std::abs(second.triangle.beta2_rad);
  EXPECT_NEAR(std::asin(AC(second) / d * std::sin(c2 + c1)) - c2, 0.3, 1e-12);  // (13), (15)
  const double e1 = std::abs(third.triangle.beta1_rad), e2 = std::abs(third.triangle.beta2_rad);
  EXPECT_NEAR(std::asin(AC(third) / d * std::sin(e1 - e2)) + e2, 0.3, 1e-12);  // (16), (18)
}

TEST(PaperMethod, NeedsAllFourEllipses) {
  const Scene scene = scene_of(1.0 * kDeg, 1.0 * kDeg);
  ContourSet contours = clean_contours(scene);
  contours[1][1].reset();
  const auto estimate = solve_ring2_by_paper(core_rig(scene.rig), contours);
  ASSERT_FALSE(estimate.ok());
  EXPECT_EQ(estimate.error(), Ring2Failure::kTooFewEllipses);
}

}  // namespace
}  // namespace pharos::ring2
