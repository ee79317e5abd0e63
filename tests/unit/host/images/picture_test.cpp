// SPDX-License-Identifier: Apache-2.0
#include "host/images/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "host/images/grey_image.hpp"
#include "tests/unit/host/images/image_bytes.hpp"

namespace pharos::host {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Picture, ColourComesBackAsItWas) {
  const std::string path = (std::filesystem::temp_directory_path() / "pharos_picture_test.png").string();
  for (const int bits : {8, 16}) {
    Picture picture{7, 5, 3, bits, {}};
    for (int k = 0; k < 7 * 5 * 3; ++k)
      picture.values.push_back(static_cast<std::uint16_t>(k * (bits == 8 ? 257 : 611)));
    write_picture(path, picture);
    const Picture again = read_picture(path);
    EXPECT_EQ(again.channels, 3);
    EXPECT_EQ(again.bits, bits);
    EXPECT_EQ(again.values, picture.values);
  }
  std::filesystem::remove(path);
}

TEST(Picture, PaletteBecomesColour) {
  const Picture picture = decode_picture(corpus("palette.png"), "p");
  ASSERT_EQ(picture.channels, 3);
  EXPECT_THAT(std::vector<std::uint16_t>(picture.values.begin(), picture.values.begin() + 6),
              testing::ElementsAre(0, 257, 514, 771, 1028, 1285));
}

TEST(Picture, TransparencyIsRefusedWithARemedy) {
  EXPECT_THAT(error_message_of(corpus("palette_transparent.png")),
              AllOf(HasSubstr("transparency"), HasSubstr("-alpha")));
  EXPECT_THAT(error_message_of(corpus("alpha.png")), HasSubstr("transparency"));
}

TEST(Picture, PpmIsColour) {
  const Picture picture = decode_picture(corpus("colour.ppm"), "p");
  ASSERT_EQ(picture.values.size(), 12U);
  EXPECT_EQ(picture.channels, 3);
  EXPECT_EQ(picture.values[11], 11 * 257);
}

// A linear slope: value 8 u + 3 v + 20 for each further channel.
TEST(Jpeg, GreyColourAndProgressiveAreRead) {
  for (const char* name : {"grey.jpg", "colour.jpg", "progressive.jpg"}) {
    const Picture picture = decode_picture(corpus(name), name);
    ASSERT_EQ(picture.width_px, 21) << name;
    ASSERT_EQ(picture.height_px, 13);
    EXPECT_EQ(picture.bits, 8);
    EXPECT_EQ(picture.channels, std::string(name) == "grey.jpg" ? 1 : 3);
    for (std::size_t k = 0; k < picture.pixels(); ++k) {
      const std::size_t row = k / 21;
      for (std::size_t c = 0; c < static_cast<std::size_t>(picture.channels); ++c) {
        const double wanted =
            8.0 * static_cast<double>(k % 21) + 3.0 * static_cast<double>(row) + 20.0 * static_cast<double>(c);
        ASSERT_NEAR(picture.values[k * static_cast<std::size_t>(picture.channels) + c] / 257.0, wanted, 20.0) << name;
      }
    }
  }
}

TEST(Jpeg, EveryTruncationIsRefused) {
  for (const char* name : {"colour.jpg", "progressive.jpg"}) {
    const Bytes whole = corpus(name);
    ASSERT_GT(whole.size(), 300U);
    for (std::size_t size = 0; size + 2 < whole.size(); size += 5) {
      EXPECT_NE(error_message_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), "none")
          << name << ' ' << size;
    }
  }
}

TEST(Jpeg, WhatIsNotOursIsReportedWithARemedy) {
  EXPECT_THAT(error_message_of(corpus("cmyk.jpg")), HasSubstr("4 colours"));
  EXPECT_THAT(error_message_of(corpus("cut.jpg")), AllOf(HasSubstr("damaged JPEG"), HasSubstr("again")));
}

TEST(Jpeg, AClaimThatItsBytesCannotHoldIsRefused) {
  Bytes bytes = corpus("grey.jpg");
  for (std::size_t k = 0; k + 8 < bytes.size(); ++k) {
    if (bytes[k] != 0xFF || bytes[k + 1] != 0xC0) continue;  // start of frame: height and width follow
    bytes[k + 5] = bytes[k + 7] = 0x13;
    break;
  }
  EXPECT_THAT(error_message_of(bytes), HasSubstr("less data"));
}

// BT.601 of the stored values, rounded; reported only where colour was lost.
TEST(GreyImage, OfColourIsItsLuma) {
  const Bytes colours = bytes_of(std::string("P6\n3 1\n65535\n\xFF\xFF\0\0\0\0\0\0\xFF\xFF\0\0\0\0\0\0\xFF\xFF", 31));
  const GreyImage image = decode_grey_image(colours, "c");
  EXPECT_TRUE(image.from_colour);
  EXPECT_EQ(image.bits, 16);
  EXPECT_THAT(image.pixels, testing::ElementsAre(19595, 38469, 7471));
  EXPECT_TRUE(decode_grey_image(corpus("colour.jpg"), "c").from_colour);
  const GreyImage grey = decode_grey_image(bytes_of("P6\n1 1\n255\nAAA"), "g");
  EXPECT_FALSE(grey.from_colour) << "three equal values are grey";
  EXPECT_THAT(grey.pixels, testing::ElementsAre('A' * 257));
  EXPECT_FALSE(decode_grey_image(corpus("grey.jpg"), "g").from_colour);
}

TEST(Picture, WhatIsNoImageNamesTheFormatsThatAre) {
  EXPECT_THAT(error_message_of(bytes_of("GIF89a")), AllOf(HasSubstr("no PNG, TIFF, JPEG, BMP"), HasSubstr("convert")));
}

}  // namespace
}  // namespace pharos::host
