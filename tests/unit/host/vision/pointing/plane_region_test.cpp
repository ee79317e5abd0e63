// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/plane_region.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pharos::pointing {
namespace {

constexpr int kPictureWidth_px = 400, kPictureHeight_px = 200;
constexpr double kSky = 600.0, kFace = 3000.0;
constexpr int kFaceTop_px = 60, kFaceBottom_px = 140, kGapFrom_px = 180, kGapTo_px = 230;

// A face from x = 40 to 360 with another level in its gap.
struct Picture {
  std::vector<std::uint16_t> pixels =
      std::vector<std::uint16_t>(kPictureWidth_px * kPictureHeight_px, std::uint16_t{600});
  explicit Picture(double gap_level) {
    for (int v = kFaceTop_px; v < kFaceBottom_px; ++v) {
      for (int u = 40; u < 360; ++u) {
        const bool is_gap = u >= kGapFrom_px && u < kGapTo_px;
        pixels[static_cast<std::size_t>(v * kPictureWidth_px + u)] =
            static_cast<std::uint16_t>(kSky + (is_gap ? gap_level : kFace));
      }
    }
  }
  bool goes_on() const {
    TargetMask target;
    target.sky = kSky;
    const Segment side{{40.0, kFaceTop_px}, {kGapFrom_px, kFaceTop_px}},
        gap{{kGapFrom_px, kFaceTop_px}, {kGapTo_px, kFaceTop_px}};
    const Segment opposite{{kGapFrom_px, kFaceBottom_px}, {40.0, kFaceBottom_px}};
    const EdgePair pair{side, opposite, {{40.0, 100.0}, {kGapFrom_px, 100.0}}, kFaceBottom_px - kFaceTop_px};
    return goes_on_along({pixels.data(), kPictureWidth_px, kPictureHeight_px}, target, pair, side, gap);
  }
};

// Wings stand out behind a body's face, which interrupts its outline and not the face (seed 701916 of the campaign, 90
// deg off at a stated 0.15).
TEST(PlaneRegion, GoesOnBesideAGapOfItsOutline) {
  EXPECT_TRUE(Picture(kFace).goes_on());
  EXPECT_TRUE(Picture(0.85 * kFace).goes_on()) << "foil";
}

TEST(PlaneRegion, EndsBeforeTheSkyAndBeforeABody) {
  EXPECT_FALSE(Picture(0.0).goes_on());
  EXPECT_FALSE(Picture(0.6 * kFace).goes_on());
  EXPECT_FALSE(Picture(1.6 * kFace).goes_on());
}

}  // namespace
}  // namespace pharos::pointing
