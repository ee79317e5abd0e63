// SPDX-License-Identifier: Apache-2.0
// Sides and ends as they are measured, without an image: points of lines in space with noise.
#include "host/vision/pointing/panel_hypothesis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pharos::pointing {
namespace {

const PinholeCamera kFaceCamera{1600, 1200, 1600.0, 1600.0, 799.5, 599.5, {}};

class Drawing {
 public:
  // With the target on the positive side of its direction; `off_px` across it.
  Side side(const Vector2& from, const Vector2& to, double noise_px, double off_px = 0.0) {
    Side side;
    side.extent = {from, to};
    side.blur_px = 1.0;
    side.contrast = 10000.0;
    std::normal_distribution<double> noise(off_px, noise_px);
    for (double at = 4.0; at < side.extent.length() - 4.0; at += 1.0)
      side.points.push_back({from + at * side.extent.along() + noise(random_) * side.extent.across(), 1.0});
    const auto fit = fit_line(side.points);
    EXPECT_TRUE(fit.ok());
    if (fit) side.fit = *fit;
    return side;
  }

 private:
  std::mt19937_64 random_{1};
};

EdgePair pair_between(const Segment& first, const Segment& second) {
  const Segment middle{0.5 * (first.begin + second.end), 0.5 * (first.end + second.begin)};
  return {first, second, middle, (second.middle() - first.middle()).norm()};
}

Vector2 pixel_of(const Vector3& place) {
  return {kFaceCamera.fx_px * place.x() / place.z() + kFaceCamera.cx_px,
          kFaceCamera.fy_px * place.y() / place.z() + kFaceCamera.cy_px};
}

// A face three times as wide as its sides are long, these steeply into the image.
struct Face {
  static constexpr double kTilt_rad = 1.1;
  static Vector2 at(double x_m, double y_m) {
    return pixel_of({x_m, y_m * std::cos(kTilt_rad), 12.0 + y_m * std::sin(kTilt_rad)});
  }
  MeasuredPair measured() {
    MeasuredPair face;
    face.sides.first = drawing.side(at(3.0, -1.0), at(3.0, 1.0), 0.03);
    face.sides.second = drawing.side(at(-3.0, 1.0), at(-3.0, -1.0), 0.03);
    face.pair = pair_between(face.sides.first.extent, face.sides.second.extent);
    return face;
  }
  Drawing drawing;
};

TEST(LonePanel, HasItsLongSidesWhereItsEndsInTheImageAre) {
  Face face;
  MeasuredPair measured = face.measured();
  measured.sides.ends = {face.drawing.side(Face::at(3.0, 1.0), Face::at(-3.0, 1.0), 0.03),
                         face.drawing.side(Face::at(-3.0, -1.0), Face::at(3.0, -1.0), 0.03)};
  const auto lone = lone_panel(measured, kFaceCamera);
  ASSERT_TRUE(lone);
  EXPECT_GT(std::abs(lone->measurement.long_edges[0].along().x()), 0.99);
}

// A panel before a face leaves two pieces of one of its ends, one at either corner: no two sides of anything, though
// both are square to the others (seed 703865 of the campaign: a plane of a stated 0.04 deg, 6.9 deg off).
TEST(LonePanel, HasNoLongSidesByTwoPiecesOfOneEnd) {
  Face face;
  MeasuredPair measured = face.measured();
  measured.sides.corner_ends = {face.drawing.side(Face::at(-3.0, -1.0), Face::at(-1.2, -1.0), 0.03),
                                face.drawing.side(Face::at(1.2, -1.0), Face::at(3.0, -1.0), 0.03)};
  EXPECT_FALSE(lone_panel(measured, kFaceCamera));
}

// Lines between cells scatter the points of one side's piece, where they meet it, and shift it. By the scatter of both
// together its shift was chance, and the line through both was turned (seed 702981 of the campaign, 2.0 deg off at a
// stated 0.39).
std::size_t lines_of_wing(double off_px) {
  Drawing drawing;
  PanelSides one, other;
  one.first = drawing.side({200.0, 500.0}, {450.0, 500.0}, 0.05);
  one.second = drawing.side({450.0, 570.0}, {200.0, 570.0}, 0.05);
  other.first = drawing.side({550.0, 500.0}, {800.0, 500.0}, 0.13, off_px);
  other.second = drawing.side({800.0, 570.0}, {550.0, 570.0}, 0.05);
  return measurement_of({one, other}, kFaceCamera).long_planes.size();
}

TEST(Wing, HasOneLineASideWhereEachPiecesOwnScatterExplainsIt) {
  EXPECT_EQ(lines_of_wing(0.0), 2u);
  EXPECT_EQ(lines_of_wing(0.1), 3u);
}

}  // namespace
}  // namespace pharos::pointing
