// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/contour_glance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "pharos/ellipse/detect.hpp"

namespace pharos::ellipse {
namespace {

constexpr std::int32_t kGlanceWidth = 200, kGlanceHeight = 160;
constexpr Ellipse kDisc{100.0, 80.0, 50.0, 30.0, 0.4};

// A bright disc, dark again where u > `hidden_from_px`; its contours traced, so that the smoothed image is there.
class GlanceAtADisc {
 public:
  explicit GlanceAtADisc(double hidden_from_px = 1e9) : planes_(kPlanes * kGlanceWidth * kGlanceHeight) {
    std::vector<std::uint16_t> pixels;
    const EllipseDistance distance(kDisc);
    for (std::int32_t v = 0; v < kGlanceHeight; ++v) {
      for (std::int32_t u = 0; u < kGlanceWidth; ++u) {
        const double outside = distance.px({static_cast<double>(u), static_cast<double>(v)});
        const double seen = u > hidden_from_px ? 0.0 : 0.5 * std::erfc(outside);
        pixels.push_back(static_cast<std::uint16_t>(8000.0 + 30000.0 * seen));
      }
    }
    workspace_->planes = planes_;
    Contours contours;
    trace_contours({pixels.data(), kGlanceWidth, kGlanceHeight}, *workspace_, contours);
  }
  double along(const Ellipse& ellipse, bool bright_inside = true) const {
    return glance_along(ellipse, bright_inside, *workspace_);
  }

 private:
  std::vector<std::uint16_t> planes_;
  std::unique_ptr<EllipseWorkspace> workspace_ = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
};

TEST(ContourGlance, SeesAllOfAWholeContourAndOfAFirstFit) {
  const GlanceAtADisc disc;
  EXPECT_GT(disc.along(kDisc), 0.99);
  EXPECT_GT(disc.along({101.0, 79.5, 51.0, 30.5, 0.41}), 0.9);
}

TEST(ContourGlance, SeesNothingWhereTheStepIsTheOtherOneOrTheContourIsElsewhere) {
  const GlanceAtADisc disc;
  EXPECT_EQ(disc.along(kDisc, false), 0.0);
  EXPECT_LT(disc.along({100.0, 80.0, 25.0, 15.0, 0.4}), 0.1);
  EXPECT_LT(disc.along({140.0, 80.0, 50.0, 30.0, 0.4}), 0.36);
}

TEST(ContourGlance, SeesThePartThatIsNotHidden) {
  const GlanceAtADisc disc(100.0);
  EXPECT_NEAR(disc.along(kDisc), 0.5, 0.08);
}

TEST(ContourGlance, LeavesOutWhatIsOutsideTheImage) {
  const GlanceAtADisc disc;
  EXPECT_EQ(disc.along({-300.0, 80.0, 50.0, 30.0, 0.4}), 0.0);
  const auto no_image = std::make_unique<EllipseWorkspace>(std::span<std::uint16_t>());
  EXPECT_EQ(glance_along(kDisc, true, *no_image), 1.0);
}

}  // namespace
}  // namespace pharos::ellipse
