// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/detect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/ellipse/ring_frames.hpp"

namespace pharos::ellipse {
namespace {

using test::Disc;
using test::Imaging;
using test::PaintedCamera;
using test::PaintedScene;
using test::TrueEllipse;

constexpr int kWidth = 320, kHeight = 240;
const PaintedCamera kCamera{kWidth, kHeight, 304.0};

struct Ring {
  Disc outer{{0.0, 0.0, 4.0}, {0.0, std::sin(0.4), -std::cos(0.4)}, 0.55};
  Disc inner{{0.0, 0.0, 4.0}, {0.0, std::sin(0.4), -std::cos(0.4)}, 0.48};
};

std::vector<std::uint16_t> picture(const PaintedScene& scene, double noise = 1.0) {
  std::mt19937_64 random(5);
  Imaging imaging;
  imaging.full_well_e /= noise * noise;
  imaging.read_noise_e /= noise;
  return scene.image(imaging, random);
}

PaintedScene ring_scene(const Ring& ring = {}) {
  PaintedScene scene(kCamera, 0.05);
  scene.add({ring.outer, 0.7});
  scene.add({ring.inner, 0.2});
  return scene;
}

bool has(const std::vector<TrueEllipse>& found, const TrueEllipse& truth, double tolerance = 0.1) {
  return std::any_of(found.begin(), found.end(), [&](const TrueEllipse& e) {
    return std::abs(e.cx_px - truth.cx_px) < tolerance && std::abs(e.cy_px - truth.cy_px) < tolerance &&
           std::abs(e.a_px - truth.a_px) < tolerance && std::abs(e.b_px - truth.b_px) < tolerance;
  });
}

TEST(DetectEllipses, FindsInnerAndOuterEllipseOfARing) {
  Bench bench;
  const auto found = bench.detect(picture(ring_scene()), kWidth, kHeight);
  EXPECT_EQ(found.size(), 2U);
  EXPECT_TRUE(has(found, Ring{}.outer.outline(kCamera)));
  EXPECT_TRUE(has(found, Ring{}.inner.outline(kCamera)));
  for (const DetectedEllipse& e : bench.workspace->found) {
    EXPECT_EQ(e.bright_inside, e.ellipse.a_px > 39.0);
    EXPECT_GT(e.score, 0.95);
    EXPECT_GT(e.coverage, 0.95);
    EXPECT_TRUE(e.covariance.allFinite());
    EXPECT_LT(std::sqrt(e.covariance(2, 2)), 0.1);
  }
}

TEST(DetectEllipses, FindsThemWithAThirdHidden) {
  for (const double at : {0.0, 1.1, 2.3, 3.7, 5.0}) {
    PaintedScene scene = ring_scene();
    test::Polygon wedge{{{kCamera.cx_px(), kCamera.cy_px()}}};
    for (int k = -2; k <= 2; ++k) {
      const double angle = at + k * 3.14159265 / 6.0;
      wedge.corners_px.push_back({kCamera.cx_px() + 80.0 * std::cos(angle), kCamera.cy_px() + 80.0 * std::sin(angle)});
    }
    scene.add({wedge, 0.4});
    Bench bench;
    const auto found = bench.detect(picture(scene), kWidth, kHeight);
    EXPECT_TRUE(has(found, Ring{}.outer.outline(kCamera), 0.3)) << at;
    EXPECT_TRUE(has(found, Ring{}.inner.outline(kCamera), 0.3)) << at;
  }
}

TEST(DetectEllipses, FindsARingThatLeavesTheImage) {
  Ring ring;
  ring.outer.centre_m[0] = ring.inner.centre_m[0] = 1.8;  // a third of the outline is outside
  Bench bench;
  const auto found = bench.detect(picture(ring_scene(ring)), kWidth, kHeight);
  EXPECT_TRUE(has(found, ring.outer.outline(kCamera), 0.3));
  EXPECT_TRUE(has(found, ring.inner.outline(kCamera), 0.3));
}

TEST(DetectEllipses, ScaleAndOffsetOfGreyDoNotMatter) {
  const std::vector<std::uint16_t> bright = picture(ring_scene());
  std::vector<std::uint16_t> faint;
  for (const std::uint16_t value : bright) faint.push_back(static_cast<std::uint16_t>(200 + value / 64));
  Bench bench;
  const auto found = bench.detect(faint, kWidth, kHeight);
  EXPECT_TRUE(has(found, Ring{}.outer.outline(kCamera)));
  EXPECT_TRUE(has(found, Ring{}.inner.outline(kCamera)));
}

TEST(DetectEllipses, ATurnedImageHasTurnedEllipses) {
  const std::vector<std::uint16_t> pixels = picture(ring_scene());
  std::vector<std::uint16_t> turned(pixels.size());  // (u, v) -> (height - 1 - v, u)
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      turned[static_cast<std::size_t>(u * kHeight + kHeight - 1 - v)] =
          pixels[static_cast<std::size_t>(v * kWidth + u)];
    }
  }
  Bench bench;
  const auto found = bench.detect(turned, kHeight, kWidth);
  TrueEllipse truth = Ring{}.outer.outline(kCamera);
  std::swap(truth.cx_px, truth.cy_px);
  truth.cx_px = kHeight - 1 - truth.cx_px;
  EXPECT_TRUE(has(found, truth));
}

TEST(DetectEllipses, SquaresAndLinesAreNone) {
  PaintedScene scene(kCamera, 0.1);
  scene.add({test::Polygon{{{60.0, 50.0}, {200.0, 70.0}, {190.0, 200.0}, {70.0, 180.0}}}, 0.6});
  scene.add({test::Polygon{{{230.0, 20.0}, {240.0, 20.0}, {300.0, 230.0}, {290.0, 230.0}}}, 0.5});
  Bench bench;
  EXPECT_TRUE(bench.detect(picture(scene), kWidth, kHeight).empty());
}

TEST(DetectEllipses, TheShapeThresholdRefusesFlatOnes) {
  Ring ring;
  ring.outer.normal = ring.inner.normal = {0.0, std::sin(1.13), -std::cos(1.13)};  // 65 deg
  ring.inner.radius_m = 0.3;  // so flat, the edges of a narrow ring would run into one another
  Bench bench;
  const auto pixels = picture(ring_scene(ring));
  EXPECT_TRUE(has(bench.detect(pixels, kWidth, kHeight), ring.outer.outline(kCamera), 0.3));
  EllipseSettings paper;
  paper.max_axis_ratio = 2.0;
  EXPECT_TRUE(bench.detect(pixels, kWidth, kHeight, paper).empty());
}

TEST(DetectEllipses, ImagesWithoutEdgesHaveNone) {
  Bench bench;
  std::mt19937_64 random(1);
  std::vector<std::uint16_t> noise;
  for (int k = 0; k < kWidth * kHeight; ++k) noise.push_back(static_cast<std::uint16_t>(random() & 0xFFFF));
  const std::vector<std::uint16_t> dark(noise.size(), 0), white(noise.size(), 65535);
  EXPECT_TRUE(bench.detect(dark, kWidth, kHeight).empty());
  EXPECT_TRUE(bench.detect(white, kWidth, kHeight).empty());
  for (const TrueEllipse& e : bench.detect(noise, kWidth, kHeight)) EXPECT_LT(e.b_px, 15.0);
}

TEST(DetectEllipses, WhatTheWorkspaceCannotHoldHasNone) {
  Bench small(100);
  EXPECT_TRUE(small.detect(picture(ring_scene()), kWidth, kHeight).empty());
  const std::vector<std::uint16_t> tiny(49, 7);
  EXPECT_TRUE(small.detect(tiny, 7, 7).empty());
  EXPECT_TRUE(small.detect(tiny, 1, 1).empty());
  EXPECT_TRUE(detect_ellipses({}, {}, *small.workspace).empty());
}

TEST(DetectEllipses, FramesWithFoilDotsAndNozzle) {
  const test::RingScore score = score_on({}, 6, 11);
  EXPECT_EQ(score.matched, score.wanted);
  EXPECT_EQ(score.wrong, 0);
  EXPECT_LT(middle_of(score.axis_errors_px), 0.05);
}

// The same image twice gives the same result: no state remains from the previous image.
TEST(DetectEllipses, TheWorkspaceCarriesNothingOver) {
  Bench used, fresh;
  const std::vector<std::uint16_t> pixels = picture(ring_scene());
  std::mt19937_64 random(2);
  std::vector<std::uint16_t> noise(pixels.size());
  for (std::uint16_t& value : noise) value = static_cast<std::uint16_t>(random() & 0xFFF);
  used.detect(noise, kWidth, kHeight);
  const auto again = used.detect(pixels, kWidth, kHeight), first = fresh.detect(pixels, kWidth, kHeight);
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(again[k].cx_px, first[k].cx_px);
    EXPECT_EQ(again[k].a_px, first[k].a_px);
  }
}

}  // namespace
}  // namespace pharos::ellipse
