// SPDX-License-Identifier: Apache-2.0
#include "host/preview/preview_picture.hpp"

#include <gtest/gtest.h>

#include <random>

#include "host/images/picture.hpp"

namespace pharos::host {
namespace {

/// A ramp from left to right.
AnnotatedImage ramp(std::int32_t width, std::int32_t height) {
  AnnotatedImage image;
  image.width_px = width;
  image.height_px = height;
  for (std::int32_t v = 0; v < height; ++v) {
    for (std::int32_t u = 0; u < width; ++u) image.pixels.push_back(static_cast<std::uint16_t>(60000 * u / width));
  }
  return image;
}

Picture decoded(const std::vector<std::uint8_t>& jpeg) { return decode_picture(jpeg, "preview"); }

double value(const Picture& picture, std::int32_t u, std::int32_t v, int channel) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(picture.width_px) + static_cast<std::size_t>(u));
  return picture.values[at + static_cast<std::size_t>(channel)] / 257.0;
}

TEST(PreviewPicture, IsAnImageOf640ColumnsAtMostInItsOwnShape) {
  const Picture same = decoded(preview_jpeg(ramp(640, 480)));
  EXPECT_EQ(same.width_px, 640);
  EXPECT_EQ(same.height_px, 480);
  const Picture smaller = decoded(preview_jpeg(ramp(1281, 961)));
  EXPECT_EQ(smaller.width_px, 427) << "a third";
  EXPECT_EQ(smaller.height_px, 320);
  for (const int channel : {0, 1, 2}) {
    EXPECT_NEAR(value(smaller, 100, 160, channel), 200.0 * 100 / 427, 4.0) << "the ramp, up to a Canvas' white";
    EXPECT_NEAR(value(smaller, 400, 20, channel), 200.0 * 400 / 427, 4.0);
  }
}

// What no camera sends, and the worst for a JPEG: each pixel a random one.
TEST(PreviewPicture, NoiseFitsIntoItsBytes) {
  std::mt19937 random(1);
  for (const std::int32_t width : {640, 2048}) {
    AnnotatedImage image = ramp(width, width * 3 / 4);
    for (std::uint16_t& pixel : image.pixels) pixel = static_cast<std::uint16_t>(random());
    const std::vector<std::uint8_t> jpeg = preview_jpeg(image);
    ASSERT_FALSE(jpeg.empty());
    EXPECT_LE(jpeg.size(), kMaxPreviewBytes);
    const Picture picture = decoded(jpeg);
    EXPECT_NEAR(3.0 * picture.width_px, 4.0 * picture.height_px, 4.0);
  }
}

// The image is black but for one white pixel, that the stretch of a Canvas does not see.
TEST(PreviewPicture, ADotLiesWhereItsPixelsAre) {
  AnnotatedImage image = ramp(1280, 960);
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint16_t{0});
  image.drawing.dot({800.5, 399.0}, colours::kRed, 6.0);
  const Picture picture = decoded(preview_jpeg(image));
  double weight = 0.0, u_sum = 0.0, v_sum = 0.0;
  for (std::int32_t v = 0; v < picture.height_px; ++v) {
    for (std::int32_t u = 0; u < picture.width_px; ++u) {
      const double red = value(picture, u, v, 0) - value(picture, u, v, 2);
      if (red < 60.0) continue;
      weight += red;
      u_sum += red * u;
      v_sum += red * v;
    }
  }
  ASSERT_GT(weight, 0.0);
  EXPECT_NEAR(u_sum / weight, (800.5 + 0.5) / 2.0 - 0.5, 0.3);
  EXPECT_NEAR(v_sum / weight, (399.0 + 0.5) / 2.0 - 0.5, 0.3);
}

TEST(PreviewPicture, OfNothingIsNothing) { EXPECT_TRUE(preview_jpeg({}).empty()); }

TEST(PreviewPicture, EightBitsAreWhiteWhere16Are) {
  const std::vector<std::uint8_t> bytes = {0, 255, 128, 1, 2, 3};
  const AnnotatedImage image = annotated_image(ImageView<const std::uint8_t>(bytes.data(), 2, 2, 3), {}, "left");
  EXPECT_EQ(image.pixels, (std::vector<std::uint16_t>{0, 65535, 257, 514}));
  EXPECT_EQ(image.view, "left");
}

}  // namespace
}  // namespace pharos::host
