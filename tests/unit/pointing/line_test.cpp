// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "panel_sight.hpp"
#include "pharos/pointing/line_fit.hpp"

namespace pharos::pointing {
namespace {

std::vector<EdgePoint> straight(std::mt19937_64& random, double noise_px, int count = 400) {
  std::normal_distribution<double> noise(0.0, noise_px);
  const Vector2 from(100.0, 200.0), along = Vector2(3.0, 1.0).normalized(), across(-along.y(), along.x());
  std::vector<EdgePoint> points;
  for (int k = 0; k < count; ++k) points.push_back({from + k * along + noise(random) * across, 1.0});
  return points;
}

TEST(FitLine, StatesTheTruthOfItsErrors) {
  // Normalised squared error of the plane's normal, two degrees of freedom: mean 2 over many lines.
  const PinholeCamera camera{1024, 1024, 6000.0, 6000.0, 511.5, 511.5, {}};
  std::mt19937_64 random(1), none(1);
  const auto truth = plane_of_line(fit_line(straight(none, 0.0))->line, camera);
  double mean = 0.0;
  constexpr int kLines = 400;
  for (int k = 0; k < kLines; ++k) {
    const auto fit = fit_line(straight(random, 0.2));
    ASSERT_TRUE(fit.ok());
    const AxisPlane plane = plane_of_line(fit->line, camera);
    const Vector3 error = (plane.normal.dot(truth.normal) < 0.0 ? Vector3(-plane.normal) : plane.normal) - truth.normal;
    const Vector3 along = truth.normal.cross(Vector3(Vector3::UnitZ())).normalized(), up = truth.normal.cross(along);
    Matrix2 covariance;
    covariance << along.dot(plane.covariance * along), along.dot(plane.covariance * up),
        along.dot(plane.covariance * up), up.dot(plane.covariance * up);
    const Vector2 e(along.dot(error), up.dot(error));
    mean += e.dot(covariance.inverse() * e) / kLines;
  }
  EXPECT_NEAR(mean, 2.0, 0.4);
}

TEST(FitLine, NeighboursThatErrAlikeMakeTheCovarianceLarger) {
  std::mt19937_64 random(2);
  std::vector<EdgePoint> points = straight(random, 0.2, 4000);
  const auto alone = fit_line(points);
  // Every error held for five points.
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2 along = Vector2(3.0, 1.0).normalized(), across(-along.y(), along.x());
    const Vector2 ideal = Vector2(100.0, 200.0) + static_cast<double>(i) * along;
    const std::size_t held = i - i % 5;
    const Vector2 held_ideal = Vector2(100.0, 200.0) + static_cast<double>(held) * along;
    points[i].place_px = ideal + across.dot(points[held].place_px - held_ideal) * across;
  }
  const auto held = fit_line(points);
  ASSERT_TRUE(alone.ok() && held.ok());
  EXPECT_LT(alone->variance_inflation, 1.6);
  EXPECT_NEAR(held->variance_inflation, 5.0, 1.5);
}

// Errors that repeat with the phase at which an edge crosses the grid of pixels average out over a period.
TEST(FitLine, NeighboursThatAlternateMakeTheCovarianceSmaller) {
  std::mt19937_64 random(5);
  std::vector<EdgePoint> points = straight(random, 0.01, 800);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].place_px.y() += i % 2 == 0 ? 0.04 : -0.04;
  const auto fit = fit_line(points);
  ASSERT_TRUE(fit.ok());
  EXPECT_EQ(fit->variance_inflation, 0.5);
}

TEST(FitLine, ErrorsOfTheEndsWidenTheOffsetsThere) {
  std::mt19937_64 random(4);
  const auto fit = fit_line(straight(random, 0.01));
  ASSERT_TRUE(fit.ok());
  constexpr double kEnd_px = 0.05;
  const ImageLine line = with_end_errors(*fit, kEnd_px);
  const auto added = [&](const Vector2& place) {
    const Vector3 p = place.homogeneous();
    return p.dot((line.covariance - fit->line.covariance) * p);
  };
  const Vector2 middle = 0.5 * (fit->begin_px + fit->end_px);
  EXPECT_NEAR(added(fit->begin_px), kEnd_px * kEnd_px, 1e-9);
  EXPECT_NEAR(added(fit->end_px), kEnd_px * kEnd_px, 1e-9);
  EXPECT_NEAR(added(middle), 0.5 * kEnd_px * kEnd_px, 1e-9);
}

TEST(FitLine, LeavesOutliersOut) {
  std::mt19937_64 random(3);
  std::vector<EdgePoint> points = straight(random, 0.05);
  for (std::size_t i = 0; i < points.size(); i += 10) points[i].place_px.y() += 3.0;
  const auto fit = fit_line(points);
  ASSERT_TRUE(fit.ok());
  EXPECT_EQ(fit->points, 360u);
  EXPECT_LT(fit->rms_px, 0.06);
}

TEST(FitLine, RefusesWhatIsNoLine) {
  std::vector<EdgePoint> few(kMinEdgePoints - 1), one_place(50, EdgePoint{{5.0, 5.0}, 1.0});
  EXPECT_EQ(fit_line(few).error(), LineFailure::kTooFewPoints);
  EXPECT_EQ(fit_line(one_place).error(), LineFailure::kNotALine);
}

TEST(UndoDistortion, ACurvedEdgeIsStraightAgain) {
  PanelSight panel;
  panel.camera = {1024, 1024, 900.0, 900.0, 511.5, 511.5, {-0.2, 0.05, 0.001, -0.001, 0.0}};
  panel.range_m = 15.0;
  panel.noise_px = 0.0;
  panel.set_axis(0.4, 0.3);
  std::mt19937_64 random(4);
  std::vector<EdgePoint> points = panel.edge(1.0, random);
  EXPECT_GT(fit_line(points)->rms_px, 0.3);
  ASSERT_TRUE(undo_distortion(points, panel.camera));
  const auto fit = fit_line(points);
  ASSERT_TRUE(fit.ok());
  EXPECT_LT(fit->rms_px, 1e-6);
  const AxisPlane plane = rotated(plane_of_line(fit->line, panel.camera), camera_to_station(panel.sight));
  EXPECT_LT(std::abs(plane.normal.dot(panel.axis_station)), 1e-9);
}

TEST(PlaneOfLine, CovarianceIsThatOfCentralDifferences) {
  const PinholeCamera camera{1024, 768, 5000.0, 5100.0, 500.0, 390.0, {}};
  ImageLine line;
  line.coefficients << 0.6, 0.8, -700.0;
  Matrix3 root;
  root << 2e-5, 0.0, 0.0, -1e-5, 1e-5, 0.0, 3e-3, 1e-3, 2e-2;
  line.covariance = root * root.transpose();
  Matrix3 expected = Matrix3::Zero();
  for (int k = 0; k < 3; ++k) {
    ImageLine more = line, less = line;
    more.coefficients += root.col(k);
    less.coefficients -= root.col(k);
    const Vector3 slope = 0.5 * (plane_of_line(more, camera).normal - plane_of_line(less, camera).normal);
    expected += slope * slope.transpose();
  }
  EXPECT_LT((plane_of_line(line, camera).covariance - expected).norm(), 1e-6 * expected.norm());
}

}  // namespace
}  // namespace pharos::pointing
