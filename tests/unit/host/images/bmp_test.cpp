// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/host/images/image_bytes.hpp"

namespace pharos::host {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// A BMP from its parts.
struct Bmp {
  std::uint32_t header_size = 40;  // 12: OS/2 1.x
  std::int32_t width = 3, height = 2;
  std::uint32_t bits = 24, compression = 0, colours_used = 0;
  std::vector<std::uint32_t> masks;  // red, green, blue, opacity
  Bytes palette, rows;

  Bytes bytes() const {
    Bytes out = bytes_of("BM");
    const std::size_t masks_behind = header_size == 40 ? 4 * masks.size() : 0;
    const std::size_t data = 14 + header_size + masks_behind + palette.size();
    put(out, static_cast<std::uint32_t>(data + rows.size()), 4);
    put(out, 0, 4);
    put(out, static_cast<std::uint32_t>(data), 4);
    put(out, header_size, 4);
    const int wide = header_size == 12 ? 2 : 4;
    put(out, static_cast<std::uint32_t>(width), wide);
    put(out, static_cast<std::uint32_t>(height), wide);
    put(out, 1, 2);
    put(out, bits, 2);
    if (header_size > 12) {
      put(out, compression, 4);
      put(out, 0, 12);  // size of the rows, pixels a metre
      put(out, colours_used, 4);
      put(out, 0, 4);
      for (const std::uint32_t mask : masks) put(out, mask, 4);
      if (out.size() < data - palette.size()) out.resize(data - palette.size());
    }
    out.insert(out.end(), palette.begin(), palette.end());
    out.insert(out.end(), rows.begin(), rows.end());
    return out;
  }
};

// Two rows of three pixels, bottom row first, blue green red; each row padded to 12 bytes.
Bmp colour_bmp() {
  Bmp bmp;
  bmp.rows = {40, 41, 42, 50, 51, 52, 60, 61, 62, 0, 0, 0, 10, 11, 12, 20, 21, 22, 30, 31, 32, 0, 0, 0};
  return bmp;
}

std::vector<int> eight_bits(const Picture& picture) {
  std::vector<int> values;
  for (const std::uint16_t value : picture.values) values.push_back(value % 257 == 0 ? value / 257 : -1);
  return values;
}

const auto kColourValues = ElementsAre(12, 11, 10, 22, 21, 20, 32, 31, 30, 42, 41, 40, 52, 51, 50, 62, 61, 60);

TEST(Bmp, TwentyFourBitsStandUpwards) {
  const Picture picture = decode_picture(colour_bmp().bytes(), "b");
  EXPECT_EQ(picture.width_px, 3);
  EXPECT_EQ(picture.height_px, 2);
  EXPECT_EQ(picture.channels, 3);
  EXPECT_EQ(picture.bits, 8);
  EXPECT_THAT(eight_bits(picture), kColourValues);
}

TEST(Bmp, AHeightBelowZeroStandsDownwards) {
  Bmp bmp = colour_bmp();
  bmp.height = -2;
  EXPECT_THAT(eight_bits(decode_picture(bmp.bytes(), "b")),
              ElementsAre(42, 41, 40, 52, 51, 50, 62, 61, 60, 12, 11, 10, 22, 21, 20, 32, 31, 30));
}

TEST(Bmp, EveryKnownHeaderGivesTheSamePixels) {
  for (const std::uint32_t size : {12U, 40U, 52U, 56U, 64U, 108U, 124U}) {
    Bmp bmp = colour_bmp();
    bmp.header_size = size;
    EXPECT_THAT(eight_bits(decode_picture(bmp.bytes(), "b")), kColourValues) << size;
  }
}

TEST(Bmp, TheLastRowMayLackItsPadding) {
  Bmp bmp = colour_bmp();
  bmp.rows.resize(bmp.rows.size() - 3);
  EXPECT_THAT(eight_bits(decode_picture(bmp.bytes(), "b")), kColourValues);
  bmp.rows.pop_back();
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("less data"));
}

TEST(Bmp, AGreyPaletteIsGreyAndAColouredOneColour) {
  Bmp bmp;
  bmp.bits = 8;
  bmp.colours_used = 3;
  bmp.palette = {5, 5, 5, 0, 9, 9, 9, 0, 200, 200, 200, 0};
  bmp.rows = {0, 1, 2, 0, 2, 1, 0, 0};
  const Picture grey = decode_picture(bmp.bytes(), "b");
  EXPECT_EQ(grey.channels, 1);
  EXPECT_THAT(eight_bits(grey), ElementsAre(200, 9, 5, 5, 9, 200));
  bmp.palette[0] = 7;
  const Picture colour = decode_picture(bmp.bytes(), "b");
  EXPECT_EQ(colour.channels, 3);
  EXPECT_EQ(colour.values[6 + 2], 7 * 257) << "blue of entry 0";
}

TEST(Bmp, APaletteOfOs2HasThreeBytesAnEntry) {
  Bmp bmp;
  bmp.header_size = 12;
  bmp.bits = 8;
  bmp.palette = {1, 1, 1, 2, 2, 2};
  bmp.rows = {0, 1, 0, 0, 1, 1, 1, 0};
  EXPECT_THAT(eight_bits(decode_picture(bmp.bytes(), "b")), ElementsAre(2, 2, 2, 1, 2, 1));
}

TEST(Bmp, AnIndexBeyondThePaletteIsDamage) {
  Bmp bmp;
  bmp.bits = 8;
  bmp.colours_used = 2;
  bmp.palette = {5, 5, 5, 0, 9, 9, 9, 0};
  bmp.rows = {0, 1, 2, 0, 0, 1, 0, 0};
  EXPECT_THAT(error_message_of(bmp.bytes()), AllOf(HasSubstr("damaged BMP"), HasSubstr("palette")));
}

Bmp wide_bmp() {
  Bmp bmp;
  bmp.width = 1;
  bmp.height = 2;
  bmp.bits = 32;
  bmp.rows = {40, 41, 42, 0, 10, 11, 12, 0};
  return bmp;
}

TEST(Bmp, ThirtyTwoBitsWithoutAMaskHaveNoOpacity) {
  EXPECT_THAT(eight_bits(decode_picture(wide_bmp().bytes(), "b")), ElementsAre(12, 11, 10, 42, 41, 40));
}

TEST(Bmp, MasksSayWhereTheColoursLie) {
  Bmp bmp = wide_bmp();
  bmp.compression = 3;
  bmp.masks = {0xFF00, 0xFF0000, 0xFF000000};
  EXPECT_THAT(eight_bits(decode_picture(bmp.bytes(), "b")), ElementsAre(11, 12, 0, 41, 42, 0));
  bmp.masks = {0x7C00, 0x3E0, 0x1F};
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("save it as PNG"));
}

TEST(Bmp, OpacityIsDroppedWhereUnusedOrFullAndRefusedElse) {
  Bmp bmp = wide_bmp();
  bmp.header_size = 124;
  bmp.compression = 3;
  bmp.masks = {0xFF0000, 0xFF00, 0xFF, 0xFF000000};
  EXPECT_THAT(eight_bits(decode_picture(bmp.bytes(), "b")), ElementsAre(12, 11, 10, 42, 41, 40)) << "0 everywhere";
  bmp.rows[3] = bmp.rows[7] = 255;
  EXPECT_THAT(eight_bits(decode_picture(bmp.bytes(), "b")), ElementsAre(12, 11, 10, 42, 41, 40));
  bmp.rows[3] = 254;
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("transparency"));
}

TEST(Bmp, OtherKindsAreRefusedWithARemedy) {
  for (const std::uint32_t bits : {1U, 4U, 16U}) {
    Bmp bmp = colour_bmp();
    bmp.bits = bits;
    EXPECT_THAT(error_message_of(bmp.bytes()), AllOf(HasSubstr(std::to_string(bits) + " bits"), HasSubstr("PNG")));
  }
  Bmp packed = colour_bmp();
  packed.bits = 8;
  packed.compression = 1;
  EXPECT_THAT(error_message_of(packed.bytes()), HasSubstr("compression 1"));
}

TEST(Bmp, HostileHeadersAreRefused) {
  Bmp bmp = colour_bmp();
  bmp.width = std::numeric_limits<std::int32_t>::max();
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("claims"));
  bmp.width = -3;
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("below zero"));
  bmp = colour_bmp();
  bmp.height = std::numeric_limits<std::int32_t>::min();
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("claims"));
  bmp.height = 0;
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("no pixels"));
  bmp = colour_bmp();
  bmp.header_size = 41;
  EXPECT_THAT(error_message_of(bmp.bytes()), HasSubstr("header of 41 bytes"));
  Bytes within = colour_bmp().bytes();
  within[10] = 20;
  EXPECT_THAT(error_message_of(within), HasSubstr("within its header"));
  within[13] = 0xFF;
  EXPECT_THAT(error_message_of(within), HasSubstr("less data"));
}

TEST(Bmp, EveryTruncationIsRefused) {
  const Bytes whole = colour_bmp().bytes();
  for (std::size_t size = 0; size + 3 < whole.size(); ++size) {
    EXPECT_NE(error_message_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), "none")
        << size;
  }
}

}  // namespace
}  // namespace pharos::host
