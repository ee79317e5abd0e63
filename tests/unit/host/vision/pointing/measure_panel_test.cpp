// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/measure_panel.hpp"

#include <gtest/gtest.h>

#include "host/vision/pointing/target_mask.hpp"
#include "pharos/base/units.hpp"
#include "support/painted_panel.hpp"

namespace pharos::pointing {
namespace {

using testing::PaintedPanel;

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))); }

PointingRefusal refusal_of(const host::GreyImage& image, const PinholeCamera& camera) {
  const auto panel = measure_panel(image.view(), camera);
  EXPECT_FALSE(panel.ok());
  return panel.error();
}

TEST(MeasurePanel, FindsTheAxisOfAPaintedPanelAndItsErrorIsWhatIsStated) {
  PaintedPanel scene;
  double normalised = 0.0;
  constexpr int kImages = 24;
  for (int k = 0; k < kImages; ++k) {
    scene.set_axis(0.27 * k, 0.5 - 0.04 * k);
    const auto panel = measure_panel(scene.image(static_cast<unsigned>(k)).view(), scene.camera);
    ASSERT_TRUE(panel.ok()) << k << " " << name_of(panel.error());
    const PointingResult answer = answer_of(*panel, scene.sight, Tone::kLinear);
    const double error = angle_between(answer.axis.axis, scene.axis_station);
    EXPECT_LT(error * kDegPerRad, 0.3) << k;
    EXPECT_LT(std::abs(answer.axis.plane.normal.dot(scene.axis_station)), 5.0 * answer.axis.sigma_plane_rad) << k;
    normalised += error * error / (answer.axis.sigma_rad() * answer.axis.sigma_rad()) / kImages;
    EXPECT_NEAR(panel->blur_px, scene.blur_px, 0.15);
    EXPECT_EQ(panel->long_planes.size(), 2u);
    EXPECT_EQ(panel->short_planes.size(), 2u);
    ASSERT_TRUE(answer.square_rad);
    EXPECT_LT(0.5 * kPi - *answer.square_rad, 4.0 * answer.sigma_square_rad + 0.2 * kRadPerDeg) << k;
    EXPECT_EQ(answer.flags & kFlagNotSquare, 0) << k;
  }
  EXPECT_NEAR(std::sqrt(normalised), 1.0, 0.4);
}

TEST(MeasurePanel, FromFarAwayOnlyThePlaneIsObservable) {
  PaintedPanel scene;
  scene.range_m = 500e3;
  scene.camera.fx_px = scene.camera.fy_px = 15e6;
  scene.set_axis(0.6, 0.5);
  const auto panel = measure_panel(scene.image().view(), scene.camera);
  ASSERT_TRUE(panel.ok());
  const PointingResult answer = answer_of(*panel, scene.sight, Tone::kLinear);
  EXPECT_NE(answer.flags & kFlagPlaneOnly, 0);
  EXPECT_GT(answer.axis.sigma_rad() * kDegPerRad, 40.0);
  EXPECT_LT(std::abs(answer.axis.plane.normal.dot(scene.axis_station)), 4.0 * answer.axis.sigma_plane_rad);
  EXPECT_LT(answer.axis.sigma_plane_rad * kDegPerRad, 0.02);
}

// A panel as deep as its own distance: its sides converge by a fifth of a radian and more.
PaintedPanel near_panel(double out_rad) {
  PaintedPanel scene;
  scene.camera.fx_px = scene.camera.fy_px = 450.0;
  scene.range_m = 12.0;
  scene.length_m = 8.0;
  scene.width_m = 3.0;
  scene.set_axis(0.4, out_rad);
  return scene;
}

TEST(MeasurePanel, SidesOfANearPanelConverge) {
  const PaintedPanel scene = near_panel(0.95);
  const auto panel = measure_panel(scene.image().view(), scene.camera);
  ASSERT_TRUE(panel.ok()) << name_of(panel.error());
  const Vector2 first = panel->long_edges[0].along(), second = panel->long_edges[1].along();
  EXPECT_LT(std::abs(first.dot(second)), std::cos(0.2));
  EXPECT_EQ(panel->short_planes.size(), 2u);  // the ends confirm it
  const PointingResult answer = answer_of(*panel, scene.sight, Tone::kLinear);
  EXPECT_FALSE(answer.second_axis.has_value());
  EXPECT_LT(angle_between(answer.axis.axis, scene.axis_station), 5.0 * answer.axis.sigma_rad());
  EXPECT_LT(angle_between(answer.axis.axis, scene.axis_station) * kDegPerRad, 0.3);
}

// Two edges that converge by perspective, but with ends that are not square to them: no panel in space.
TEST(MeasurePanelRefuses, EdgesThatAreNoRectangleInSpace) {
  PaintedPanel scene = near_panel(0.95);
  host::GreyImage image = scene.image();
  // The lower right of a slanted cut becomes sky: one end is askew.
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      const double off = 0.9 * (u - 255.5) - 0.43 * (v - 255.5) - 20.0;
      auto& pixel = image.pixels[static_cast<std::size_t>(v) * 512 + static_cast<std::size_t>(u)];
      const double fraction = 0.5 * std::erfc(off / (1.2 * std::sqrt(2.0)));
      pixel = static_cast<std::uint16_t>(600.0 + fraction * std::max(0.0, pixel - 600.0));
    }
  }
  EXPECT_EQ(refusal_of(image, scene.camera), PointingRefusal::kNoPanel);
}

// A face of a body: beyond one of its sides is another face, in the dark but not as dark as the sky.
// The face beside it is as bright as `light` of its contrast, and `deep_px` deep.
PointingRefusal refusal_beside_a_face(double light, double deep_px) {
  const PaintedPanel scene = near_panel(0.95);
  host::GreyImage image = scene.image();
  const Vector2 across(-std::sin(0.4), std::cos(0.4));
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      auto& pixel = image.pixels[static_cast<std::size_t>(v) * 512 + static_cast<std::size_t>(u)];
      const double off = across.dot(Vector2(u - 255.5, v - 255.5));
      if (off > 0.0 && off < deep_px) pixel = static_cast<std::uint16_t>(pixel + light * (24600.0 - pixel));
    }
  }
  return refusal_of(image, scene.camera);
}

TEST(MeasurePanelRefuses, AFaceWithAnotherOneBesideIt) {
  EXPECT_EQ(refusal_beside_a_face(0.04, 160.0), PointingRefusal::kNoPanel);
}

// What optics scatter beside an edge may be as bright, but behind both edges alike.
TEST(MeasurePanelRefuses, AFaceWithAFarDarkerOneBesideIt) {
  EXPECT_EQ(refusal_beside_a_face(0.01, 160.0), PointingRefusal::kNoPanel);
}

// Brighter of both at each pixel.
host::GreyImage over(host::GreyImage image, const host::GreyImage& other) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = std::max(image.pixels[i], other.pixels[i]);
  return image;
}

void paint_disc(const Vector2& centre, double radius_px, host::GreyImage& image) {
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      const double inside = radius_px - (Vector2(u, v) - centre).norm();
      auto& pixel = image.pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width_px) +
                                 static_cast<std::size_t>(u)];
      const double light = 600.0 + 30000.0 * 0.5 * std::erfc(-inside / (1.2 * std::sqrt(2.0)));
      pixel = std::max(pixel, static_cast<std::uint16_t>(light));
    }
  }
}

// Where one end of the panel is hidden nothing confirms it; the body beside it is a rectangle with two ends.
TEST(MeasurePanel, ABodysOutlineDoesNotAnswerForAPanelThatNothingConfirms) {
  PaintedPanel panel = near_panel(0.95);
  panel.shift_m = {-1.2, -1.2};
  PaintedPanel body = near_panel(0.0);
  body.set_axis(0.4 + 0.5 * kPi, 0.7);
  body.length_m = 3.9;
  body.width_m = 1.8;
  body.shift_m = {2.6, 4.2};
  const auto alone = measure_panel(body.image().view(), body.camera);
  ASSERT_TRUE(alone.ok()) << name_of(alone.error());
  host::GreyImage image = over(panel.image(), body.image());
  const auto whole = measure_panel(image.view(), panel.camera);
  ASSERT_TRUE(whole.ok());
  const PointingResult with_ends = answer_of(*whole, panel.sight, Tone::kLinear);
  EXPECT_FALSE(with_ends.second_axis.has_value());
  EXPECT_LT(angle_between(with_ends.axis.axis, panel.axis_station) * kDegPerRad, 0.5);
  // A round shape before one end.
  ASSERT_EQ(whole->short_edges.size(), 2u);
  const Segment& end = whole->short_edges[0];
  paint_disc(end.middle(), 0.6 * end.length(), image);
  const auto hidden = measure_panel(image.view(), panel.camera);
  if (hidden.ok()) {
    EXPECT_TRUE(answer_of(*hidden, panel.sight, Tone::kLinear).second_axis.has_value());
  }
}

// Two panels of one axis with a gap between them, `length_m` each, from the middle of the first one on.
host::GreyImage wing_image(PaintedPanel panel, double length_m, double gap_m) {
  panel.length_m = length_m;
  const host::GreyImage first = panel.image();
  const Vector3 step_m =
      (length_m + gap_m) * (pointing::camera_to_station(panel.sight).transpose() * panel.axis_station);
  panel.shift_m += step_m.head<2>();
  panel.range_m += step_m.z();
  return over(first, panel.image());
}

// Pieces of a body's two sides beside its wings are in line as a wing's panels are. A panel that is longer than either
// of them makes the answer ambiguous; a shorter one is a part of the body.
TEST(MeasurePanel, ALongerPanelCompetesWithAWing) {
  PaintedPanel wing = near_panel(0.0);
  wing.set_axis(0.1, 0.55);
  wing.width_m = 1.4;
  wing.shift_m = {-3.5, 2.6};
  PaintedPanel lone = near_panel(0.0);
  lone.set_axis(0.1 + 0.5 * kPi, 0.6);
  lone.width_m = 1.5;
  lone.shift_m = {0.0, -1.8};
  const host::GreyImage two = wing_image(wing, 3.0, 0.9);
  const auto without = measure_panel(two.view(), wing.camera);
  ASSERT_TRUE(without.ok()) << name_of(without.error());
  EXPECT_EQ(without->panels, 2);
  const auto answer_beside = [&](double length_m) {
    lone.length_m = length_m;
    const auto panel = measure_panel(over(two, lone.image()).view(), wing.camera);
    EXPECT_TRUE(panel.ok());
    return answer_of(*panel, wing.sight, Tone::kLinear);
  };
  const PointingResult beside_longer = answer_beside(4.2);
  ASSERT_TRUE(beside_longer.second_axis.has_value());
  EXPECT_LT(angle_between(beside_longer.axis.axis, wing.axis_station) * kDegPerRad, 0.5);
  EXPECT_LT(angle_between(*beside_longer.second_axis, lone.axis_station) * kDegPerRad, 0.5);
  const PointingResult beside_shorter = answer_beside(2.6);
  EXPECT_FALSE(beside_shorter.second_axis.has_value());
}

// A panel that its body hides at one end: a round shape before it.
host::GreyImage with_a_hidden_end(const PaintedPanel& panel, host::GreyImage image) {
  const auto whole = measure_panel(image.view(), panel.camera);
  EXPECT_TRUE(whole.ok());
  if (whole) paint_disc(whole->short_edges[0].middle(), 0.53 * whole->short_edges[0].length(), image);
  return image;
}

TEST(MeasurePanel, APlaneRegionWithOneEndIsAPanel) {
  const PaintedPanel panel = near_panel(0.95);
  const auto hidden = measure_panel(with_a_hidden_end(panel, panel.image()).view(), panel.camera);
  ASSERT_TRUE(hidden.ok()) << name_of(hidden.error());
  EXPECT_EQ(hidden->short_planes.size(), 1u);
  const PointingResult answer = answer_of(*hidden, panel.sight, Tone::kLinear);
  EXPECT_FALSE(answer.second_axis.has_value());
  EXPECT_LT(angle_between(answer.axis.axis, panel.axis_station), 5.0 * answer.axis.sigma_rad());
}

// Two faces of a body, whose light differs by less than what tells one of its sides from the other.
TEST(MeasurePanelRefuses, TwoFacesWithOneEnd) {
  const PaintedPanel body = near_panel(0.95);
  host::GreyImage image = body.image();
  const Vector2 across(-std::sin(0.4), std::cos(0.4));
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      auto& pixel = image.pixels[static_cast<std::size_t>(v) * 512 + static_cast<std::size_t>(u)];
      if (across.dot(Vector2(u - 255.5, v - 255.5)) > 0.0 && pixel > 1800)
        pixel = static_cast<std::uint16_t>(600.0 + 1.3 * (pixel - 600.0));
    }
  }
  EXPECT_EQ(refusal_of(with_a_hidden_end(body, image), body.camera), PointingRefusal::kNoPanel);
}

// Long and thin, without ends that could be measured: an axis to some degrees that nothing confirms.
TEST(MeasurePanelRefuses, ABoom) {
  PaintedPanel boom = near_panel(0.5);
  boom.range_m = 250.0;
  boom.camera.fx_px = boom.camera.fy_px = 450.0 * 250.0 / 12.0;
  boom.width_m = 0.25;
  boom.noise = 2500.0;
  EXPECT_EQ(refusal_of(boom.image(), boom.camera), PointingRefusal::kNoPanel);
}

// A dark frame bends the rise; the level beyond the edge is the sky's all the same.
// So narrow that perspective tells nothing of its axis: that it is long and straight confirms it as little.
TEST(MeasurePanelRefuses, ABoomBesideABody) {
  PaintedPanel boom;
  boom.range_m = 20e3;
  boom.camera.fx_px = boom.camera.fy_px = 600e3;
  boom.width_m = 0.25;  // 7.5 px
  boom.length_m = 6.7;
  boom.set_axis(0.4, 0.1);
  host::GreyImage image = boom.image();
  EXPECT_TRUE(measure_panel(image.view(), boom.camera).ok());  // alone it may be a panel far away
  paint_disc({390.0, 330.0}, 60.0, image);
  EXPECT_EQ(refusal_of(image, boom.camera), PointingRefusal::kNoPanel);
}

TEST(MeasurePanel, AFramedPanelHasSkyBeyondItsSides) {
  PaintedPanel framed = near_panel(0.95);
  framed.rim_m = 0.12;
  framed.rim_light = 0.25;
  EXPECT_TRUE(measure_panel(framed.image().view(), framed.camera).ok());
}

TEST(MeasurePanelRefuses, APanelThatIsSeenAlongItsAxis) {
  PaintedPanel scene = near_panel(1.45);  // 7 deg off the line of sight
  scene.camera.fx_px = scene.camera.fy_px = 800.0;
  scene.length_m = 12.0;
  EXPECT_EQ(refusal_of(scene.image(), scene.camera), PointingRefusal::kAlongSight);
}

TEST(MeasurePanel, StarsEvenBrighterOnesChangeNothing) {
  PaintedPanel scene;
  scene.set_axis(0.4, 0.2);
  host::GreyImage image = scene.image();
  const auto before = measure_panel(image.view(), scene.camera);
  for (int k = 0; k < 30; ++k) testing::add_star(image, 20.0 + 15.0 * k, k % 2 == 0 ? 30.0 : 470.0, 60000.0);
  const auto after = measure_panel(image.view(), scene.camera);
  ASSERT_TRUE(before.ok() && after.ok());
  EXPECT_LT(angle_between(answer_of(*before, scene.sight, Tone::kLinear).axis.axis,
                          answer_of(*after, scene.sight, Tone::kLinear).axis.axis),
            0.02 * kRadPerDeg);
}

TEST(MeasurePanel, UndoesTheLens) {
  PaintedPanel scene;
  scene.set_axis(0.4, 0.3);
  host::GreyImage image = scene.image();
  // The same image with a lens file that has distortion: another line, another axis; without the distortion the true
  // one.
  PinholeCamera bent = scene.camera;
  bent.distortion = {-3.0, 0.0, 0.0, 0.0, 0.0};
  const auto straight = measure_panel(image.view(), scene.camera), curved = measure_panel(image.view(), bent);
  ASSERT_TRUE(straight.ok() && curved.ok());
  EXPECT_GT(angle_between(answer_of(*straight, scene.sight, Tone::kLinear).axis.axis,
                          answer_of(*curved, scene.sight, Tone::kLinear).axis.axis),
            0.1 * kRadPerDeg);
}

TEST(MeasurePanelRefuses, WhatHasNoAnswerByItsName) {
  PaintedPanel scene;
  scene.set_axis(0.4, 0.2);
  PaintedPanel dark = scene;
  dark.light = 0.0;
  EXPECT_EQ(refusal_of(dark.image(), scene.camera), PointingRefusal::kBlack);
  host::GreyImage uniform = dark.image();
  std::fill(uniform.pixels.begin(), uniform.pixels.end(), std::uint16_t{0});
  EXPECT_EQ(refusal_of(uniform, scene.camera), PointingRefusal::kBlack);
  std::fill(uniform.pixels.begin(), uniform.pixels.end(), std::uint16_t{65535});
  EXPECT_EQ(refusal_of(uniform, scene.camera), PointingRefusal::kSaturated);
  PaintedPanel bright = scene;
  bright.light = 200000.0;
  EXPECT_EQ(refusal_of(bright.image(), scene.camera), PointingRefusal::kSaturated);
  host::GreyImage stars = dark.image();
  testing::add_star(stars, 100.0, 100.0, 40000.0, 0.8);
  EXPECT_EQ(refusal_of(stars, scene.camera), PointingRefusal::kStarsOnly);
  PaintedPanel cut = scene;
  cut.shift_m = {6.0, 2.5};
  EXPECT_EQ(refusal_of(cut.image(), scene.camera), PointingRefusal::kCutByBorder);
  PaintedPanel square = scene;
  square.length_m = square.width_m = 4.0;
  EXPECT_EQ(refusal_of(square.image(), scene.camera), PointingRefusal::kNoPanel);
  PinholeCamera other = scene.camera;
  other.width_px = 640;
  EXPECT_EQ(refusal_of(scene.image(), other), PointingRefusal::kWrongSize);
}

TEST(MeasurePanelRefuses, ADimTargetWithoutAPanelAmongBrighterStars) {
  PaintedPanel scene;
  scene.light = 0.0;
  host::GreyImage image = scene.image();
  testing::add_star(image, 256.0, 256.0, 6000.0, 20.0);  // a patch of 13 x 13 px
  EXPECT_EQ(refusal_of(image, scene.camera), PointingRefusal::kNoPanel);
  for (int k = 0; k < 8; ++k) testing::add_star(image, 60.0 + 50.0 * k, k % 2 == 0 ? 40.0 : 460.0, 60000.0);
  EXPECT_EQ(refusal_of(image, scene.camera), PointingRefusal::kStarsBrighter);
}

TEST(MeasurePanelRefuses, AnEdgeBeyondWhatTheLensModelReaches) {
  PaintedPanel scene;
  scene.set_axis(0.4, 0.2);
  // This lens model is not invertible beyond a radius well inside of the panel's ends.
  PinholeCamera folded = scene.camera;
  folded.distortion = {-400.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(refusal_of(scene.image(), folded), PointingRefusal::kOutsideLens);
}

TEST(MeasurePanelRefuses, ATargetWithOneEdgeOnly) {
  PaintedPanel scene;
  scene.set_axis(0.4, 0.0);
  host::GreyImage image = scene.image();
  // Half of the panel fades into the sky: one long edge remains.
  const Matrix3 R = pointing::camera_to_station(scene.sight);
  const Vector3 axis = R.transpose() * scene.axis_station;
  const Vector2 across(-axis.y(), axis.x());
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      const double off = across.dot(Vector2(u - 255.5, v - 255.5));
      auto& pixel = image.pixels[static_cast<std::size_t>(v) * 512 + static_cast<std::size_t>(u)];
      const double fraction = std::clamp(1.0 - (off + 28.0) / 56.0, 0.0, 1.0);
      pixel = static_cast<std::uint16_t>(600.0 + fraction * std::max(0.0, pixel - 600.0));
    }
  }
  EXPECT_EQ(refusal_of(image, scene.camera), PointingRefusal::kOneEdge);
}

TEST(Otsu, DividesTwoHeaps) {
  std::vector<std::uint32_t> histogram(256);
  histogram[10] = 1000;
  histogram[12] = 900;
  histogram[200] = 50;
  histogram[205] = 60;
  const int threshold = otsu(histogram);
  EXPECT_GE(threshold, 12);
  EXPECT_LT(threshold, 200);
}

}  // namespace
}  // namespace pharos::pointing
