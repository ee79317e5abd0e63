// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/unit/ring2/scenes.hpp"

namespace pharos::ring2 {
namespace {

// Unknowns as the truth has them: theta, gamma, centre, ring radius, distance, nozzle radius.
sim::RingAndNozzle target_of(const Vector8& x) {
  sim::RingAndNozzle target;
  target.normal = sim::facing_normal(x[0], x[1]);
  target.ring_centre_m = x.segment<3>(2);
  target.ring_radius_m = x[5];
  target.distance_m = x[6];
  target.nozzle_radius_m = x[7];
  return target;
}

// A point of the circle's image, by the simulator: nothing of the estimator.
Vector2 image_of(const sim::StereoCamera& camera, const Vector8& x, int feature, double angle) {
  const sim::RingAndNozzle target = target_of(x);
  const sim::SpaceCircle circle = feature == 0 ? target.ring() : target.nozzle();
  const Vector3 first = circle.normal.cross(Vector3::UnitY()).normalized();
  const Vector3 second = circle.normal.cross(first);
  return *sim::pixel_of(camera,
                        circle.centre_m + circle.radius_m * (std::cos(angle) * first + std::sin(angle) * second));
}

// Squared bound of the normal's angle from one edge point a pixel of contour, by differences.
double squared_bound(const sim::StereoRig& rig, const Vector8& truth, double sigma_px) {
  constexpr int kPlaces = 48;
  constexpr double kStep = 1e-6;
  Matrix8 information = Matrix8::Zero();
  for (const sim::StereoCamera& camera : rig) {
    for (int i = 0; i < 2 * kPlaces; ++i) {
      const int feature = i % 2;
      const double angle = 2.0 * std::numbers::pi * (i / 2) / kPlaces;
      const Vector2 tangent =
          (image_of(camera, truth, feature, angle + kStep) - image_of(camera, truth, feature, angle - kStep)) /
          (2.0 * kStep);
      const Vector2 normal = Vector2(tangent.y(), -tangent.x()).normalized();
      Vector8 slope;
      for (int k = 0; k < 8; ++k) {
        const Vector8 step = kStep * Vector8::Unit(k);
        slope[k] = normal.dot(image_of(camera, truth + step, feature, angle) -
                              image_of(camera, truth - step, feature, angle)) /
                   (2.0 * kStep);
      }
      const double points = tangent.norm() * 2.0 * std::numbers::pi / kPlaces;
      information += points / (sigma_px * sigma_px) * slope * slope.transpose();
    }
  }
  const Matrix8 covariance = information.inverse();
  const double facing = std::cos(truth[1]);
  return facing * facing * covariance(0, 0) + covariance(1, 1);
}

struct Campaign {
  double rms_deg = 0.0;
  double bound_deg = 0.0;
  double nees = 0.0;  // per degree of freedom
  int answered = 0;
};

// Random attitudes to 25 degrees about both axes at 3 m.
Campaign campaign(double sigma_px, int count) {
  Campaign result;
  double square = 0.0;
  double bound = 0.0;
  for (int k = 0; k < count; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    sim::RandomStream random(seed, "attitude");
    const double theta = random.uniform(-25.0, 25.0) * kDeg;
    const double gamma = random.uniform(-25.0, 25.0) * kDeg;
    const Scene scene = scene_of(theta, gamma);
    const auto estimate = solve_ring2(core_rig(scene.rig), noisy_contours(scene, sigma_px, seed));
    if (!estimate) continue;
    ++result.answered;
    const sim::RingAndNozzle& truth = scene.target;
    const double angle = angle_between(estimate->normal, truth.normal);
    square += angle * angle;
    const Vector3 tilt = estimate->normal.cross(truth.normal);
    Vector8 error;
    error << tilt.dot(estimate->tilt_axes[0]), tilt.dot(estimate->tilt_axes[1]),
        truth.ring_centre_m - estimate->ring_centre_m, truth.ring_radius_m - estimate->ring_radius_m,
        truth.distance_m - estimate->distance_m, truth.nozzle_radius_m - estimate->nozzle_radius_m;
    result.nees += error.dot(estimate->covariance.inverse() * error) / 8.0;
    Vector8 x;
    x << theta, gamma, truth.ring_centre_m, truth.ring_radius_m, truth.distance_m, truth.nozzle_radius_m;
    bound += squared_bound(scene.rig, x, sigma_px);
  }
  result.rms_deg = std::sqrt(square / result.answered) / kDeg;
  result.bound_deg = std::sqrt(bound / result.answered) / kDeg;
  result.nees /= result.answered;
  return result;
}

void expect_efficient(const Campaign& campaign, int count, double rms_deg) {
  std::printf("RMS %.5f deg, bound %.5f deg, ratio %.3f, NEES %.3f\n", campaign.rms_deg, campaign.bound_deg,
              campaign.rms_deg / campaign.bound_deg, campaign.nees);
  EXPECT_EQ(campaign.answered, count);
  EXPECT_LT(campaign.rms_deg, rms_deg);
  EXPECT_NEAR(campaign.rms_deg / campaign.bound_deg, 1.0, 0.05);
  EXPECT_GT(campaign.nees, 0.95);
  EXPECT_LT(campaign.nees, 1.05);
}

// 800 problems of 8 unknowns: NEES and the RMS of two tilts then scatter by 1.8 %.
TEST(Ring2Noise, ATenthOfAPixelReachesTheBound) { expect_efficient(campaign(0.1, 800), 800, 0.008); }
TEST(Ring2Noise, HalfAPixelReachesTheBound) { expect_efficient(campaign(0.5, 800), 800, 0.04); }

}  // namespace
}  // namespace pharos::ring2
