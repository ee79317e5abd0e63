// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "panel_sight.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/rotation.hpp"
#include "pharos/pointing/axis_estimate.hpp"

namespace pharos::pointing {
namespace {

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

struct Campaign {
  double median_deg = 0.0, plane_median_deg = 0.0, normalised_rms = 0.0, plane_normalised_rms = 0.0;
  double mean_sigma_deg = 0.0, worst_plane_sigmas = 0.0;
};

Campaign run(double range_m, double focal_px, double out_of_image_rad, int images, unsigned seed) {
  PanelSight panel;
  panel.range_m = range_m;
  panel.camera.fx_px = panel.camera.fy_px = focal_px;
  std::mt19937_64 random(seed);
  std::vector<double> errors, plane_errors;
  Campaign result;
  for (int k = 0; k < images; ++k) {
    panel.set_axis(0.7 + 0.01 * k, out_of_image_rad);
    const AxisPlanes planes = panel.planes(random);
    const auto estimate = estimate_axis({planes.data(), planes.size()});
    EXPECT_TRUE(estimate.ok());
    const double error = angle_between(estimate->axis, panel.axis_station);
    const double plane_error = std::abs(std::asin(estimate->plane.normal.dot(panel.axis_station)));
    errors.push_back(error * kDegPerRad);
    plane_errors.push_back(plane_error * kDegPerRad);
    result.normalised_rms += error * error / estimate->covariance.trace() / images;
    result.plane_normalised_rms += plane_error * plane_error / std::pow(estimate->sigma_plane_rad, 2) / images;
    result.worst_plane_sigmas = std::max(result.worst_plane_sigmas, plane_error / estimate->sigma_plane_rad);
    result.mean_sigma_deg += estimate->sigma_rad() * kDegPerRad / images;
  }
  std::sort(errors.begin(), errors.end());
  std::sort(plane_errors.begin(), plane_errors.end());
  result.median_deg = errors[errors.size() / 2];
  result.plane_median_deg = plane_errors[plane_errors.size() / 2];
  result.normalised_rms = std::sqrt(result.normalised_rms);
  result.plane_normalised_rms = std::sqrt(result.plane_normalised_rms);
  return result;
}

TEST(EstimateAxis, TwoPlanesGiveTheirCrossProductAndItsCovariance) {
  std::mt19937_64 random(5);
  PanelSight panel;
  panel.set_axis(0.3, 0.5);
  const AxisPlanes planes = panel.planes(random);
  const auto estimate = estimate_axis({planes.data(), 2});
  ASSERT_TRUE(estimate.ok());
  EXPECT_LT(angle_between(estimate->axis, planes[0].normal.cross(planes[1].normal)), 1e-8);
  const IntersectionJacobian J = intersection_jacobian(planes[0].normal, planes[1].normal);
  const Matrix3 expected = J.by_first * planes[0].covariance * J.by_first.transpose() +
                           J.by_second * planes[1].covariance * J.by_second.transpose();
  EXPECT_LT((estimate->covariance - expected).norm(), 1e-3 * expected.norm());
  EXPECT_EQ(estimate->degrees_of_freedom, 0);
  EXPECT_LT(estimate->chi2, 1e-6);
}

TEST(EstimateAxis, JacobianIsThatOfCentralDifferences) {
  const Vector3 a = Vector3(1.0, 0.2, -0.3).normalized(), b = Vector3(0.1, 1.0, 0.4).normalized();
  const IntersectionJacobian J = intersection_jacobian(a, b);
  for (int k = 0; k < 3; ++k) {
    const Vector3 h = 1e-6 * Vector3::Unit(k);
    const Vector3 by_first = ((a + h).cross(b).normalized() - (a - h).cross(b).normalized()) / 2e-6;
    const Vector3 by_second = (a.cross(b + h).normalized() - a.cross(b - h).normalized()) / 2e-6;
    EXPECT_LT((by_first - J.by_first.col(k)).norm(), 1e-8);
    EXPECT_LT((by_second - J.by_second.col(k)).norm(), 1e-8);
  }
}

TEST(EstimateAxis, AtAHundredMetresOneImageGivesTheAxis) {
  const Campaign near = run(100.0, 6000.0, 40 * kRadPerDeg, 300, 11);
  EXPECT_LT(near.median_deg, 0.15);
  EXPECT_LT(near.plane_median_deg, 0.02);
  EXPECT_NEAR(near.normalised_rms, 1.0, 0.15);
  EXPECT_NEAR(near.plane_normalised_rms, 1.0, 0.15);
}

TEST(EstimateAxis, FromFarAwayTheSigmaGrowsToThatOfAnyDirectionInThePlane) {
  // The panel 600 px long at every range.
  double before = 0.0;
  for (const double range_m : {100.0, 300.0, 1e3, 5e3, 5e5}) {
    const Campaign far = run(range_m, 60.0 * range_m, 40 * kRadPerDeg, 300, 12);
    EXPECT_GT(far.mean_sigma_deg, before) << range_m;
    EXPECT_LT(far.normalised_rms, 1.25) << range_m << " m";
    EXPECT_GT(far.normalised_rms, 0.6) << range_m << " m";
    EXPECT_LT(far.worst_plane_sigmas, 4.0) << range_m << " m";
    EXPECT_NEAR(far.plane_normalised_rms, 1.0, 0.3) << range_m << " m";
    before = far.mean_sigma_deg;
  }
  EXPECT_NEAR(before, 52.0, 3.0);
}

TEST(EstimateAxis, SeveralEdgesOfOneDirectionAreBetterThanTwo) {
  std::mt19937_64 random(13);
  PanelSight panel;
  panel.set_axis(0.3, 0.5);
  AxisPlanes planes = panel.planes(random);
  const auto two = estimate_axis({planes.data(), planes.size()});
  for (const AxisPlane& plane : panel.planes(random)) planes.push_back(plane);
  const auto four = estimate_axis({planes.data(), planes.size()});
  ASSERT_TRUE(two.ok() && four.ok());
  EXPECT_NEAR(four->sigma_rad() / two->sigma_rad(), std::sqrt(0.5), 0.1);
  EXPECT_EQ(four->degrees_of_freedom, 2);
}

TEST(EstimateAxis, TurnsWithTheFrame) {
  std::mt19937_64 random(14);
  PanelSight panel;
  panel.range_m = 1000.0;
  panel.camera.fx_px = panel.camera.fy_px = 60e3;
  panel.set_axis(1.1, 0.4);
  const AxisPlanes planes = panel.planes(random);
  const Matrix3 R = rotation_exp({0.4, -1.0, 2.0});
  const AxisPlanes turned = [&] {
    AxisPlanes result;
    for (const AxisPlane& plane : planes) result.push_back(rotated(plane, R));
    return result;
  }();
  const auto here = estimate_axis({planes.data(), planes.size()});
  const auto there = estimate_axis({turned.data(), turned.size()});
  EXPECT_LT(angle_between(R * here->axis, there->axis), 1e-6);
  EXPECT_NEAR(there->sigma_rad(), here->sigma_rad(), 1e-6);
}

TEST(EstimateAxis, RefusesOnePlaneAndNumbersThatAreNone) {
  AxisPlane plane{Vector3::UnitX(), 1e-8 * Matrix3::Identity()};
  EXPECT_EQ(estimate_axis({&plane, 1}).error(), AxisFailure::kTooFewPlanes);
  std::array<AxisPlane, 2> planes{plane, plane};
  planes[1].normal.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(estimate_axis(planes).error(), AxisFailure::kNotFinite);
}

TEST(EstimateAxis, TheSamePlaneTwiceGivesNothingAlongIt) {
  Matrix3 covariance = 1e-8 * Matrix3::Identity();
  covariance(0, 0) = 0.0;
  const std::array<AxisPlane, 2> planes{AxisPlane{Vector3::UnitX(), covariance},
                                        AxisPlane{Vector3::UnitX(), covariance}};
  const auto estimate = estimate_axis(planes);
  ASSERT_TRUE(estimate.ok());
  EXPECT_NEAR(estimate->sigma_along_rad, kPi / std::sqrt(12.0), 1e-3);
  EXPECT_NEAR(estimate->axis.x(), 0.0, 1e-6);
  EXPECT_TRUE(estimate->covariance.allFinite());
}

}  // namespace
}  // namespace pharos::pointing
