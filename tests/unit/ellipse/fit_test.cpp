// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "pharos/ellipse/direct_fit.hpp"
#include "pharos/ellipse/refine_fit.hpp"

namespace pharos::ellipse {
namespace {

constexpr Ellipse kTilted{310.0, 205.0, 80.0, 42.0, 0.6};

std::vector<PointF> points_of(const Ellipse& e, int count, double from = 0.0, double to = 2.0 * std::numbers::pi) {
  std::vector<PointF> points;
  for (int k = 0; k < count; ++k) {
    const PointPx p = point_at(e, from + (to - from) * k / count);
    points.push_back({static_cast<float>(p.u), static_cast<float>(p.v)});
  }
  return points;
}

// Edges of a blurred disc appear inside by sigma^2 / 2r. The refinement corrects this, so that tests must apply it.
std::vector<PointF> seen_points_of(const Ellipse& e, int count, double sigma, std::mt19937_64& random) {
  constexpr double kVariance_px2 = 1.0 + 1.0 / 3.0 + 1.0 / 12.0 + 0.49;
  std::normal_distribution<double> noise(0.0, sigma);
  std::vector<PointF> points;
  for (int k = 0; k < count; ++k) {
    const double t = 2.0 * std::numbers::pi * k / count, c = std::cos(e.theta_rad), s = std::sin(e.theta_rad);
    const double slant = std::hypot(e.b_px * std::cos(t), e.a_px * std::sin(t));
    const double in = noise(random) - 0.5 * kVariance_px2 * e.a_px * e.b_px / (slant * slant * slant);
    const double x = e.a_px * std::cos(t) + in * e.b_px * std::cos(t) / slant;
    const double y = e.b_px * std::sin(t) + in * e.a_px * std::sin(t) / slant;
    points.push_back({static_cast<float>(e.cx_px + c * x - s * y), static_cast<float>(e.cy_px + s * x + c * y)});
  }
  return points;
}

void expect_near(const Ellipse& one, const Ellipse& other, double tolerance) {
  EXPECT_NEAR(one.cx_px, other.cx_px, tolerance);
  EXPECT_NEAR(one.cy_px, other.cy_px, tolerance);
  EXPECT_NEAR(one.a_px, other.a_px, tolerance);
  EXPECT_NEAR(one.b_px, other.b_px, tolerance);
}

TEST(Ellipse, PointAndAnomalyAreInverse) {
  for (double t = -3.0; t < 3.1; t += 0.5) {
    const PointPx p = point_at(kTilted, t);
    EXPECT_NEAR(anomaly_of(kTilted, p), t, 1e-12);
    EXPECT_NEAR(distance_px(kTilted, p), 0.0, 1e-9);
  }
}

TEST(Ellipse, DistanceIsSignedAndOfFirstOrder) {
  const Ellipse circle{10.0, 20.0, 30.0, 30.0, 0.0};
  EXPECT_NEAR(distance_px(circle, {10.0, 50.5}), 0.5, 0.01);
  EXPECT_NEAR(distance_px(circle, {39.5, 20.0}), -0.5, 0.01);
  EXPECT_LT(distance_px(circle, {10.0, 20.0}), -20.0);
  for (const PointPx p : {PointPx{10.0, 50.5}, {39.5, 20.0}, {300.0, 17.0}, {10.2, 20.1}, {10.0, 20.0}}) {
    const double px = distance_px(circle, p);
    EXPECT_NEAR(EllipseDistance(circle).squared_px2(p), px * px, 1e-9 * px * px);
  }
  EXPECT_NEAR(EllipseDistance(circle).far_px({10.0, 56.0}), 6.0, 1e-9);
  EXPECT_NEAR(EllipseDistance(circle).far_px({10.0, 44.0}), -6.0, 1e-9);
}

TEST(Ellipse, NormalFormHasLongAxisFirstAndHalfATurn) {
  const Ellipse e = normalised({0.0, 0.0, 2.0, 5.0, 0.0});
  EXPECT_EQ(e.a_px, 5.0);
  EXPECT_NEAR(e.theta_rad, std::numbers::pi / 2.0, 1e-15);  // the end that belongs to the range
  EXPECT_NEAR(normalised({0.0, 0.0, 5.0, 2.0, 3.0}).theta_rad, 3.0 - std::numbers::pi, 1e-15);
}

TEST(DirectFit, FindsTheEllipseOfExactPoints) {
  for (const double theta : {-1.5, -0.4, 0.0, 0.6, 1.57}) {
    Ellipse truth = kTilted;
    truth.theta_rad = theta;
    const auto fit = fit_direct(points_of(truth, 32));
    ASSERT_TRUE(fit);
    expect_near(*fit, truth, 1e-3);
    EXPECT_NEAR(std::remainder(fit->theta_rad - theta, std::numbers::pi), 0.0, 1e-4);
  }
}

// Algebraic error of a conic at unit scale about the points' mean, for 4 A C - B^2 = 1.
double constrained_error(const Ellipse& e, const std::vector<PointF>& points) {
  const auto count = static_cast<double>(points.size());
  double u = 0.0, v = 0.0, squares = 0.0, error = 0.0;
  for (const PointF& p : points) u += static_cast<double>(p.u) / count, v += static_cast<double>(p.v) / count;
  for (const PointF& p : points) {
    const double du = static_cast<double>(p.u) - u, dv = static_cast<double>(p.v) - v;
    squares += du * du + dv * dv;
  }
  const double scale = std::sqrt(squares / count), a = e.a_px / scale, b = e.b_px / scale;
  for (const PointF& p : points) {
    const double du = (static_cast<double>(p.u) - e.cx_px) / scale, dv = (static_cast<double>(p.v) - e.cy_px) / scale;
    const double x = std::cos(e.theta_rad) * du + std::sin(e.theta_rad) * dv;
    const double y = std::cos(e.theta_rad) * dv - std::sin(e.theta_rad) * du;
    const double f = 0.5 * a * b * (x * x / (a * a) + y * y / (b * b) - 1.0);
    error += f * f;
  }
  return error;
}

// Whatever moves the fit of noisy arcs makes the error that it minimises larger.
TEST(DirectFit, HasTheLeastConstrainedErrorOfNoisyArcs) {
  std::mt19937_64 random(7);
  std::normal_distribution<float> noise(0.0F, 0.3F);
  int fits = 0;
  for (int k = 0; k < 40; ++k) {
    std::vector<PointF> points = points_of(kTilted, 32, 0.15 * k, 0.15 * k + 1.2 + 0.1 * k);
    for (PointF& p : points) p = {p.u + noise(random), p.v + noise(random)};
    const auto fit = fit_direct(points);
    if (!fit) continue;
    ++fits;
    const double least = constrained_error(*fit, points);
    for (const double step : {-1e-3, 1e-3}) {
      Ellipse moved[] = {*fit, *fit, *fit, *fit, *fit};
      moved[0].cx_px += step * fit->a_px;
      moved[1].cy_px += step * fit->a_px;
      moved[2].a_px *= 1.0 + step;
      moved[3].b_px *= 1.0 + step;
      moved[4].theta_rad += step;
      for (const Ellipse& other : moved) EXPECT_GT(constrained_error(other, points), least * (1.0 - 1e-9));
    }
  }
  EXPECT_GT(fits, 35);
}

TEST(DirectFit, FarFromTheOriginAndSmallIsAsGood) {
  const Ellipse small{3000.5, 2000.25, 6.0, 5.0, 0.3};
  const auto fit = fit_direct(points_of(small, 16));
  ASSERT_TRUE(fit);
  expect_near(*fit, small, 0.01);
}

TEST(DirectFit, RefusesWhatIsNoEllipse) {
  std::vector<PointF> line, same(20, PointF{5.0F, 5.0F});
  for (int k = 0; k < 20; ++k) line.push_back({static_cast<float>(k), 2.0F * static_cast<float>(k)});
  EXPECT_FALSE(fit_direct(line));
  EXPECT_FALSE(fit_direct(same));
  EXPECT_FALSE(fit_direct(std::span<const PointF>(line).first(5)));
  EXPECT_FALSE(fit_direct({}));
}

TEST(RefineFit, OutliersDoNotMoveIt) {
  std::mt19937_64 random(1);
  std::vector<PointF> points = seen_points_of(kTilted, 150, 0.05, random);
  for (std::size_t k = 0; k < points.size(); k += 8) points[k].u += 3.0F;
  const auto fit = refine_fit({309.0, 206.0, 81.0, 41.0, 0.62}, points, 1.0);
  ASSERT_TRUE(fit);
  expect_near(fit->ellipse, kTilted, 0.05);
}

// Normalised squared errors over many draws: 5 on average if the covariance is right. The robust weights lose 5 %.
TEST(RefineFit, StatesAConsistentCovariance) {
  std::mt19937_64 random(7);
  double sum = 0.0;
  constexpr int kDraws = 200;
  for (int k = 0; k < kDraws; ++k) {
    const auto fit = refine_fit(kTilted, seen_points_of(kTilted, 120, 0.2, random), 1.0);
    ASSERT_TRUE(fit);
    const Ellipse& e = fit->ellipse;
    Vector5 error;
    error << e.cx_px - kTilted.cx_px, e.cy_px - kTilted.cy_px, e.a_px - kTilted.a_px, e.b_px - kTilted.b_px,
        std::remainder(e.theta_rad - kTilted.theta_rad, std::numbers::pi);
    sum += error.dot(fit->covariance.inverse() * error);
  }
  EXPECT_GT(sum / kDraws, 4.2);
  EXPECT_LT(sum / kDraws, 6.5);
}

TEST(RefineFit, ACircleHasNoDirection) {
  std::mt19937_64 random(3);
  const Ellipse circle{200.0, 200.0, 50.0, 50.0, 0.0};
  const auto fit = refine_fit(circle, seen_points_of(circle, 150, 0.1, random), 1.0);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->ellipse.a_px, 50.0, 0.05);
  EXPECT_TRUE(fit->covariance.allFinite());
  EXPECT_LE(fit->covariance(4, 4), std::numbers::pi * std::numbers::pi / 12.0 + 1e-12);
}

TEST(RefineFit, RefusesTooFewPoints) {
  EXPECT_FALSE(refine_fit(kTilted, points_of(kTilted, 5), 1.0));
  EXPECT_FALSE(refine_fit(kTilted, {}, 1.0));
}

}  // namespace
}  // namespace pharos::ellipse
