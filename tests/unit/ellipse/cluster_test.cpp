// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/cluster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "pharos/ellipse/score.hpp"

namespace pharos::ellipse {
namespace {

DetectedEllipse found(double a, double b, double score) {
  DetectedEllipse e;
  e.ellipse = {100.0, 100.0, a, b, 0.3};
  e.score = score;
  return e;
}

// The ring of 1.1 m at 4 m: 84 px, 6 px wide. The usual clustering merges the two.
TEST(Cluster, ConcentricEllipsesAreSimilarAndStayTwo) {
  EXPECT_TRUE(similar(found(84.0, 80.0, 0.9).ellipse, found(78.0, 74.0, 0.9).ellipse));
  auto workspace = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
  add_to_clusters(found(84.0, 80.0, 0.9), *workspace);
  add_to_clusters(found(78.0, 74.0, 0.8), *workspace);
  EXPECT_EQ(workspace->found.size(), 2U);
}

TEST(Cluster, OfOneEllipseTheBestStays) {
  auto workspace = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
  add_to_clusters(found(84.0, 80.0, 0.8), *workspace);
  add_to_clusters(found(84.4, 79.8, 0.9), *workspace);
  add_to_clusters(found(83.8, 80.3, 0.7), *workspace);
  ASSERT_EQ(workspace->found.size(), 1U);
  EXPECT_EQ(workspace->found[0].score, 0.9);
}

TEST(Cluster, WhenFullTheWorstGoes) {
  auto workspace = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
  for (std::size_t k = 0; k <= kMaxEllipses; ++k) {
    DetectedEllipse e = found(20.0, 15.0, 0.5 + 0.001 * static_cast<double>(k));
    e.ellipse.cx_px = 60.0 * static_cast<double>(k);
    add_to_clusters(e, *workspace);
  }
  EXPECT_EQ(workspace->found.size(), kMaxEllipses);
  EXPECT_EQ(workspace->counters.ellipses_dropped, 1U);
  for (const DetectedEllipse& e : workspace->found) EXPECT_GT(e.score, 0.5);
}

TEST(Score, IsThePapersFormula) {
  const Ellipse e{0.0, 0.0, 50.0, 40.0, 0.0};
  Support support;
  support.count = 100;
  support.distance_sum_px = 20.0;  // S2 = 1 - 0.3 * 0.2
  support.length_fraction = 0.5;
  support.turn_fraction = 0.6;
  const Score score = score_of(e, support, {});
  EXPECT_EQ(score.shape, 1.0);
  EXPECT_NEAR(score.accuracy, 0.94, 1e-12);
  EXPECT_NEAR(score.fullness, 0.5 * 100.0 / perimeter_px(e) + 0.3, 1e-12);
  EXPECT_NEAR(score.value(), std::sqrt(score.accuracy * score.fullness), 1e-12);
}

TEST(Score, AFlatEllipseScoresNothing) {
  Support support;
  support.count = 100;
  support.length_fraction = support.turn_fraction = 1.0;
  EllipseSettings settings;
  settings.max_axis_ratio = 2.0;
  EXPECT_EQ(score_of({0.0, 0.0, 50.0, 24.0, 0.0}, support, settings).value(), 0.0);
  EXPECT_GT(score_of({0.0, 0.0, 50.0, 26.0, 0.0}, support, settings).value(), 0.0);
}

}  // namespace
}  // namespace pharos::ellipse
